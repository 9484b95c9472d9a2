//! A surface over a grid.

use crate::mesh::Mesh;
use glam::{Vec2, Vec3};

/// A vertex of a grid.
pub struct GridVertex {
    /// Where it is.
    pub position: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Texture coordinates.
    pub coordinates: Vec2,
}

/// Adds `columns` times `rows` cells, two triangles each, to a mesh; `vertex` gets the column and row of a corner. Where
/// the rows go up from the columns' direction by a quarter turn counterclockwise, the front faces the viewer. Triangles
/// whose corners coincide are left out, as at the poles of a sphere.
pub fn add_grid(mesh: &mut Mesh, [columns, rows]: [u32; 2], vertex: impl Fn(u32, u32) -> GridVertex) {
    let first = mesh.positions.len() as u32;
    for row in 0..=rows {
        for column in 0..=columns {
            let vertex = vertex(column, row);
            mesh.positions.push(vertex.position);
            mesh.normals.push(vertex.normal);
            mesh.coordinates.push(vertex.coordinates);
        }
    }
    let at = |column: u32, row: u32| first + row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let corners = [
                at(column, row),
                at(column + 1, row),
                at(column + 1, row + 1),
                at(column, row + 1),
            ];
            for triangle in [
                [corners[0], corners[1], corners[2]],
                [corners[0], corners[2], corners[3]],
            ] {
                let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
                if a != b && b != c && c != a {
                    mesh.triangles.push(triangle);
                }
            }
        }
    }
}
