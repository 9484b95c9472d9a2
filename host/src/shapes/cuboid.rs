//! A box.

use super::grid::{GridVertex, add_grid};
use crate::mesh::Mesh;
use glam::{Vec3, vec2};

/// Normal, and direction of the first texture axis, of each face.
const FACES: [[Vec3; 2]; 6] = [
    [Vec3::X, Vec3::NEG_Z],
    [Vec3::NEG_X, Vec3::Z],
    [Vec3::Y, Vec3::X],
    [Vec3::NEG_Y, Vec3::X],
    [Vec3::Z, Vec3::X],
    [Vec3::NEG_Z, Vec3::NEG_X],
];

/// A box about the origin with these edges: 12 triangles. Each face has its own vertices and shows the whole texture,
/// upright on the four sides.
pub fn cuboid(size: Vec3) -> Mesh {
    let mut mesh = Mesh::default();
    for [normal, u] in FACES {
        let v = normal.cross(u);
        add_grid(&mut mesh, [1, 1], |column, row| {
            let corner = normal + u * (2.0 * column as f32 - 1.0) + v * (2.0 * row as f32 - 1.0);
            GridVertex {
                position: corner * size / 2.0,
                normal,
                coordinates: vec2(column as f32, row as f32),
            }
        });
    }
    mesh
}
