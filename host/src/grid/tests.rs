use super::*;
use crate::mesh_source::MeshSource;
use crate::progress::silent;
use oktant_shared::octree::Node;

/// Numbers from 0 to 1, the same ones every time.
fn numbers() -> impl FnMut() -> f32 {
    let mut state = 1_u32;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 24) as f32
    }
}

fn soup(triangles: usize, size: f32, offset: Vec3) -> Mesh {
    let mut next = numbers();
    let mut point = |size: f32| Vec3::from([(); 3].map(|()| (next() - 0.5) * size));
    let mut mesh = Mesh::default();
    for i in 0..triangles as u32 {
        let center = point(2.0) + offset;
        mesh.positions.extend([(); 3].map(|()| center + point(size)));
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh
}

fn flat(triangles: usize) -> Mesh {
    let mut mesh = soup(triangles, 0.1, Vec3::ZERO);
    for position in &mut mesh.positions {
        position.y = 0.25;
    }
    mesh
}

fn build(mesh: &Mesh, options: &GridOptions) -> Grid {
    Grid::build(mesh, options, &silent).unwrap()
}

/// The cell of a point, by f64.
fn cell_at(grid: &Grid, point: Vec3) -> Node {
    let raster = &grid.raster;
    let place = ((point.as_dvec3() - raster.low.as_dvec3()) / f64::from(raster.cell)).floor();
    let place = place.as_uvec3();
    assert!(place.cmplt(raster.cells).all(), "{point} lies in the grid");
    grid.cells[(place.x + raster.cells.x * (place.y + raster.cells.y * place.z)) as usize]
}

/// Every point of a triangle is in a cell that lists it, and of a cell's triangles few have nothing in it.
#[test]
fn cells_list_what_is_in_them() {
    let meshes = [
        soup(2_000, 0.2, Vec3::ZERO),
        soup(300, 2.0, Vec3::ZERO),
        soup(2_000, 0.2, Vec3::new(1e3, -2e3, 3e3)),
        flat(500),
        MeshSource::Bunny.load(&silent).unwrap(),
    ];
    let mut next = numbers();
    for mesh in meshes {
        let grid = build(&mesh, &GridOptions::default());
        for (slot, id) in (0..).zip(&grid.ids) {
            let [a, b, c] = mesh.triangles[*id as usize].map(|vertex| mesh.positions[vertex as usize]);
            for round in 0..20 {
                let (mut u, mut v) = (next(), next());
                if u + v > 1.0 {
                    (u, v) = (1.0 - u, 1.0 - v);
                }
                let point = [a, b, c, a + (b - a) * u + (c - a) * v][round.min(3)];
                let cell = cell_at(&grid, point);
                let list = &grid.references[cell.first as usize..(cell.first + cell.count) as usize];
                assert!(
                    list.is_sorted() && list.binary_search(&slot).is_ok(),
                    "triangle {id} at {point}"
                );
            }
        }
    }
}

#[test]
fn small_triangles_are_in_few_cells() {
    // Far smaller than a cell, most lie in one.
    let grid = build(
        &soup(1_000, 0.01, Vec3::ZERO),
        &GridOptions {
            density: 1.0,
            budget: 32,
        },
    );
    assert!(grid.references.len() < 1_300, "{}", grid.references.len());
}

#[test]
fn the_resolution_follows_the_triangles_and_the_budget() {
    let mesh = soup(10_000, 0.02, Vec3::ZERO);
    for density in [0.5, 4.0, 8.0] {
        let grid = build(&mesh, &GridOptions { density, budget: 32 });
        let expected = density * 10_000.0;
        let ratio = grid.cells.len() as f32 / expected;
        assert!((0.7..1.5).contains(&ratio), "{} cells for {expected}", grid.cells.len());
        assert_eq!(grid.cells.len(), grid.raster.total());
    }
    // Triangles as wide as everything would be in a good part of all cells.
    let wide = soup(2_000, 4.0, Vec3::ZERO);
    for budget in [1, 4, 32] {
        let grid = build(&wide, &GridOptions { density: 8.0, budget });
        assert!(grid.references.len() <= 2_000 * budget as usize);
        assert_eq!(grid.ids.len(), 2_000);
    }
    assert_eq!(
        build(
            &wide,
            &GridOptions {
                density: 8.0,
                budget: 1
            }
        )
        .cells
        .len(),
        1
    );
}

#[test]
fn planes_of_cells_are_exact() {
    for offset in [Vec3::ZERO, Vec3::new(30.0, -20.0, 10.0)] {
        let raster = build(&soup(20_000, 0.02, offset), &GridOptions::default()).raster;
        for axis in 0..3 {
            for i in 0..=raster.cells[axis] {
                let exact = f64::from(raster.low[axis]) + f64::from(raster.cell) * f64::from(i);
                assert_eq!(f64::from(raster.low[axis] + raster.cell * i as f32), exact);
            }
        }
    }
}

#[test]
fn any_number_of_threads_builds_the_same() {
    let mesh = soup(30_000, 0.1, Vec3::ZERO);
    let built = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| build(&mesh, &GridOptions::default()))
    };
    assert_eq!(built(1), built(3));
}

#[test]
fn one_triangle_and_none() {
    let grid = build(&soup(1, 1.0, Vec3::ZERO), &GridOptions::default());
    assert_eq!(grid.ids, [0]);
    assert!(!grid.references.is_empty());
    let none = Grid::build(&Mesh::default(), &GridOptions::default(), &silent);
    assert!(matches!(none, Err(BuildError::NoArea)));
}
