//! Meshes made by code: surfaces whose shape is known, and shapes that traversals find hard.

mod closing;
mod room;
mod solids;

use std::collections::HashMap;
use std::f32::consts::{PI, TAU};

use glam::Vec3;
use oktant::mesh::Mesh;

pub use closing::{is_closed, with_holes_fanned};
pub use room::room;
pub use solids::{ball, block, hexahedron, quad, turned_inside_out};

/// A mesh of bare triangles.
fn bare(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        positions,
        triangles,
        ..Mesh::default()
    }
}

/// Lowest and highest coordinates of the vertices that triangles use; both zero for a mesh without triangles.
pub fn bounds(mesh: &Mesh) -> (Vec3, Vec3) {
    let mut used = mesh
        .triangles
        .iter()
        .flatten()
        .map(|&vertex| mesh.positions[vertex as usize]);
    let Some(first) = used.next() else {
        return (Vec3::ZERO, Vec3::ZERO);
    };
    used.fold((first, first), |(low, high), point| (low.min(point), high.max(point)))
}

/// The unit sphere made of an icosahedron whose triangles are cut in four `subdivisions` times:
/// `20 * 4^subdivisions` triangles. Closed.
pub fn icosphere(subdivisions: u32) -> Mesh {
    let golden = (1.0 + 5.0_f32.sqrt()) / 2.0;
    let mut positions: Vec<Vec3> = [(0, 1, 2), (1, 2, 0), (2, 0, 1)]
        .into_iter()
        .flat_map(|(zero, short, long)| {
            [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(short_sign, long_sign)| {
                let mut corner = [0.0; 3];
                corner[zero] = 0.0;
                corner[short] = short_sign;
                corner[long] = long_sign * golden;
                Vec3::from_array(corner).normalize()
            })
        })
        .collect();
    let mut triangles = icosahedron_faces(&positions);
    for _ in 0..subdivisions {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    bare(positions, triangles)
}

/// Any three corners of an icosahedron that are one edge length apart are a face.
fn icosahedron_faces(corners: &[Vec3]) -> Vec<[u32; 3]> {
    let edge = 1.0 / (TAU / 5.0).sin();
    let adjacent = |a: usize, b: usize| (corners[a].distance(corners[b]) - edge).abs() < 0.01;
    let mut faces = Vec::new();
    for a in 0..corners.len() {
        for b in a + 1..corners.len() {
            for c in b + 1..corners.len() {
                if adjacent(a, b) && adjacent(b, c) && adjacent(c, a) {
                    let outward = (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(corners[a]) > 0.0;
                    let (b, c) = if outward { (b, c) } else { (c, b) };
                    faces.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    faces
}

/// The unit sphere cut along `slices` meridians and into `stacks` bands from pole to pole (z): long thin triangles at
/// the poles, which are one vertex each. Closed; `2 * slices * (stacks - 1)` triangles.
pub fn uv_sphere(slices: u32, stacks: u32) -> Mesh {
    let mut positions = vec![Vec3::Z];
    for stack in 1..stacks {
        let (radius, height) = (PI * stack as f32 / stacks as f32).sin_cos();
        positions.extend((0..slices).map(|slice| {
            let (y, x) = (TAU * slice as f32 / slices as f32).sin_cos();
            Vec3::new(radius * x, radius * y, height)
        }));
    }
    positions.push(Vec3::NEG_Z);
    let south = positions.len() as u32 - 1;
    let at = |stack: u32, slice: u32| 1 + (stack - 1) * slices + slice % slices;
    let mut triangles = Vec::new();
    for slice in 0..slices {
        triangles.push([0, at(1, slice), at(1, slice + 1)]);
        for stack in 1..stacks - 1 {
            let (a, b) = (at(stack, slice), at(stack + 1, slice));
            let (c, d) = (at(stack + 1, slice + 1), at(stack, slice + 1));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([at(stacks - 1, slice), south, at(stacks - 1, slice + 1)]);
    }
    bare(positions, triangles)
}

/// A ring round the z axis: a tube of radius `minor` along a circle of radius `major`, cut into `slices` along the
/// circle and `sides` round the tube. Closed; `2 * slices * sides` triangles.
pub fn torus(major: f32, minor: f32, slices: u32, sides: u32) -> Mesh {
    let positions = (0..slices)
        .flat_map(|slice| {
            let (sin, cos) = (TAU * slice as f32 / slices as f32).sin_cos();
            (0..sides).map(move |side| {
                let (height, outward) = (TAU * side as f32 / sides as f32).sin_cos();
                let radius = major + minor * outward;
                Vec3::new(radius * cos, radius * sin, minor * height)
            })
        })
        .collect();
    let at = |slice: u32, side: u32| (slice % slices) * sides + side % sides;
    let triangles = (0..slices)
        .flat_map(|slice| (0..sides).map(move |side| (slice, side)))
        .flat_map(|(slice, side)| {
            let (a, b) = (at(slice, side), at(slice + 1, side));
            let (c, d) = (at(slice + 1, side + 1), at(slice, side + 1));
            [[a, b, c], [a, c, d]]
        })
        .collect();
    bare(positions, triangles)
}

/// 64 triangles round one vertex, which no octree can part.
pub fn fan_64() -> Mesh {
    const BLADES: u32 = 64;
    let hub = Vec3::new(0.1, 0.2, 0.3);
    let mut positions = vec![hub];
    positions.extend((0..BLADES).map(|blade| {
        let angle = TAU * blade as f32 / BLADES as f32;
        // A pleated cone: neighbours lie in different planes.
        let height = if blade % 2 == 0 { 0.25 } else { 0.4 };
        hub + Vec3::new(0.7 * angle.cos(), 0.7 * angle.sin(), height)
    }));
    let triangles = (0..BLADES)
        .map(|blade| [0, 1 + blade, 1 + (blade + 1) % BLADES])
        .collect();
    bare(positions, triangles)
}

/// The square from -1 to 1 in the plane z = 0, of zero thickness: `n` by `n` cells of two triangles each. Where `n` is
/// a power of two, all coordinates are exact and lie on the planes of an octree round it.
pub fn flat_grid(n: u32) -> Mesh {
    let step = 2.0 / n as f32;
    let positions = (0..=n)
        .flat_map(|row| (0..=n).map(move |column| Vec3::new(column as f32 * step - 1.0, row as f32 * step - 1.0, 0.0)))
        .collect();
    let triangles = (0..n)
        .flat_map(|row| (0..n).map(move |column| row * (n + 1) + column))
        .flat_map(|corner| {
            let (right, above) = (corner + 1, corner + n + 1);
            [[corner, right, above + 1], [corner, above + 1, above]]
        })
        .collect();
    bare(positions, triangles)
}

/// `count` unconnected triangles with corners at random in cubes of edge 0.3 at random in the unit cube.
pub fn soup(count: u32, seed: u64) -> Mesh {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut point = move || Vec3::from_array([(); 3].map(|()| random.f32()));
    let positions = (0..count)
        .flat_map(|_| {
            let centre = point();
            [(); 3].map(|()| centre + 0.3 * (point() - 0.5))
        })
        .collect();
    let triangles = (0..count).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect();
    bare(positions, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn smallest_area(mesh: &Mesh) -> f32 {
        mesh.triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
                0.5 * (b - a).cross(c - a).length()
            })
            .fold(f32::INFINITY, f32::min)
    }

    /// Six times the signed volume under every triangle: positive where faces are counter-clockwise from outside.
    fn volume(mesh: &Mesh) -> f32 {
        let under = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        mesh.triangles.iter().map(under).sum()
    }

    #[test]
    fn closed_surfaces_are_closed_outward_and_of_the_right_volume() {
        let ball = 4.0 / 3.0 * PI;
        for (mesh, triangles, expected) in [
            (icosphere(0), 20, 2.536_15),
            (icosphere(4), 5_120, ball),
            (uv_sphere(96, 48), 2 * 96 * 47, ball),
            (torus(1.0, 0.4, 96, 48), 2 * 96 * 48, 2.0 * PI * PI * 0.16),
        ] {
            assert_eq!(mesh.triangles.len(), triangles);
            assert!(is_closed(&mesh));
            assert!(smallest_area(&mesh) > 0.0);
            assert!(
                (volume(&mesh) / expected - 1.0).abs() < 0.01,
                "{} {expected}",
                volume(&mesh)
            );
        }
    }

    #[test]
    fn open_surfaces_are_what_they_say() {
        let fan = fan_64();
        assert_eq!(fan.triangles.len(), 64);
        assert!(fan.triangles.iter().all(|triangle| triangle[0] == 0));
        assert!(!is_closed(&fan));
        let grid = flat_grid(8);
        assert_eq!(grid.triangles.len(), 128);
        assert_eq!(bounds(&grid), (Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0)));
        let soup = soup(2_000, 7);
        assert_eq!(soup.triangles.len(), 2_000);
        assert_eq!(soup, super::soup(2_000, 7));
        assert_ne!(soup, super::soup(2_000, 8));
        for mesh in [fan, grid, soup] {
            assert!(smallest_area(&mesh) > 0.0);
        }
    }
}
