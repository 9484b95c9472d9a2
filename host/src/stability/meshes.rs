//! Meshes on which methods fail.

use crate::mesh::Mesh;
use crate::shapes;
use glam::Vec3;

/// A mesh of triangles that are given by their corners.
pub fn of_corners(triangles: &[[[f32; 3]; 3]]) -> Mesh {
    Mesh {
        positions: triangles.iter().flatten().copied().map(Vec3::from_array).collect(),
        triangles: (0..triangles.len() as u32)
            .map(|id| [3 * id, 3 * id + 1, 3 * id + 2])
            .collect(),
        ..Mesh::default()
    }
}

/// A closed sphere of about 2,000 triangles.
pub fn sphere(radius: f32, center: Vec3) -> Mesh {
    let unit = shapes::sphere(1.0, 2_000);
    Mesh {
        positions: unit
            .positions
            .iter()
            .map(|position| *position * radius + center)
            .collect(),
        triangles: unit.triangles,
        ..Mesh::default()
    }
}

/// The cube from 0 to 1, its faces cut into 8 by 8 squares: all coordinates are exact.
pub fn cube() -> Mesh {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [0.0, 1.0] {
            triangles.extend(face(axis, side, [0.0, 1.0]));
        }
    }
    of_corners(&triangles)
}

/// A mesh in another size and place.
pub fn moved(mesh: Mesh, scale: f32, offset: Vec3) -> Mesh {
    Mesh {
        positions: mesh
            .positions
            .iter()
            .map(|position| *position * scale + offset)
            .collect(),
        ..mesh
    }
}

/// The square from -1 to 1 at z = 0, cut in the same way.
pub fn flat() -> Mesh {
    of_corners(&face(2, 0.0, [-1.0, 1.0]))
}

/// Triangles side by side in the plane z = 0, facing upwards, each with a normal of its own.
pub fn tilted(normals: &[Vec3]) -> Mesh {
    Mesh {
        normals: normals.iter().flat_map(|normal| [*normal; 3]).collect(),
        ..of_corners(
            &normals
                .iter()
                .enumerate()
                .map(|(at, _)| in_plane(at))
                .collect::<Vec<_>>(),
        )
    }
}

/// So many pairs of triangles back to back in the plane z = 0, with common corners.
pub fn of_pairs(count: usize) -> Mesh {
    let mesh = of_corners(&(0..count).map(in_plane).collect::<Vec<_>>());
    let both = |[a, b, c]: &[u32; 3]| [[*a, *b, *c], [*a, *c, *b]];
    Mesh {
        triangles: mesh.triangles.iter().flat_map(both).collect(),
        positions: mesh.positions,
        ..Mesh::default()
    }
}

/// One of many triangles in the plane z = 0.
fn in_plane(at: usize) -> [[f32; 3]; 3] {
    let (x, y) = (2.0 * (at % 300) as f32, 2.0 * (at / 300) as f32);
    [[x, y, 0.0], [x + 1.0, y, 0.0], [x, y + 1.0, 0.0]]
}

/// A square across an axis.
fn face(axis: usize, side: f32, [low, high]: [f32; 2]) -> Vec<[[f32; 3]; 3]> {
    const SQUARES: u32 = 8;
    let along = |i: u32| low + (high - low) * i as f32 / SQUARES as f32;
    let at = |i: u32, j: u32| {
        let mut corner = [side; 3];
        corner[(axis + 1) % 3] = along(i);
        corner[(axis + 2) % 3] = along(j);
        corner
    };
    (0..SQUARES)
        .flat_map(|i| (0..SQUARES).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}
