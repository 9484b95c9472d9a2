//! A level checkerboard.

use super::grid::{GridVertex, add_grid};
use crate::mesh::Mesh;
use glam::{Vec2, Vec3, vec2, vec3};

/// A level rectangle about the origin whose front looks up, of `columns` times `rows` squares, two triangles each; and
/// for each triangle whether its square is one of the second colour. The square at the left end of the back edge is not.
/// Texture coordinates are 0 to 1 over the whole board.
pub fn checkerboard(size: Vec2, [columns, rows]: [u32; 2]) -> (Mesh, Vec<bool>) {
    let mut mesh = Mesh::default();
    add_grid(&mut mesh, [columns, rows], |column, row| {
        let at = vec2(column as f32 / columns as f32, row as f32 / rows as f32);
        GridVertex {
            position: vec3((at.x - 0.5) * size.x, 0.0, (0.5 - at.y) * size.y),
            normal: Vec3::Y,
            coordinates: at,
        }
    });
    let is_second = (0..rows)
        .rev()
        .flat_map(|row| (0..columns).flat_map(move |column| [(column + row) % 2 == 1; 2]));
    (mesh, is_second.collect())
}
