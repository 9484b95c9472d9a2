//! A parallelogram.

use super::grid::{GridVertex, add_grid};
use crate::mesh::Mesh;
use glam::{Vec3, vec2};

/// The parallelogram with a corner and the two edges that leave it: 2 triangles, whose front is on the side of
/// `edge_u x edge_v`. Texture coordinates are 0 to 1 along the edges.
pub fn quad(corner: Vec3, edge_u: Vec3, edge_v: Vec3) -> Mesh {
    let normal = edge_u.as_dvec3().cross(edge_v.as_dvec3());
    let normal = normal.try_normalize().unwrap_or_default().as_vec3();
    let mut mesh = Mesh::default();
    add_grid(&mut mesh, [1, 1], |column, row| GridVertex {
        position: corner + edge_u * column as f32 + edge_v * row as f32,
        normal,
        coordinates: vec2(column as f32, row as f32),
    });
    mesh
}
