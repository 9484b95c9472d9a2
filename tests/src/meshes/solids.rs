//! Solids of flat faces, and balls with normals.

use super::{bare, uv_sphere};
use glam::{Vec2, Vec3, vec2, vec3};
use oktant::mesh::Mesh;

/// A parallelogram from a corner along two edges, seen from the side of `u x v`; texture coordinates count in `u` and
/// `v` from 0 to 1.
pub fn quad(corner: Vec3, u: Vec3, v: Vec3) -> Mesh {
    Mesh {
        coordinates: vec![Vec2::ZERO, vec2(1.0, 0.0), Vec2::ONE, vec2(0.0, 1.0)],
        ..bare(
            vec![corner, corner + u, corner + u + v, corner + v],
            vec![[0, 1, 2], [0, 2, 3]],
        )
    }
}

/// A box along the axes.
pub fn block(low: Vec3, high: Vec3) -> Mesh {
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
        vec3(pick(0), pick(1), pick(2))
    };
    hexahedron(std::array::from_fn(corner))
}

/// A solid with six flat faces: corner `i` lies on the side of larger x where bit 0 of `i` is set, of larger y where
/// bit 1 is, of larger z where bit 2 is.
pub fn hexahedron(corners: [Vec3; 8]) -> Mesh {
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    bare(corners.to_vec(), triangles.collect())
}

/// A sphere of [`uv_sphere`] with the normals of a round one.
pub fn ball(center: Vec3, radius: f32, slices: u32, stacks: u32) -> Mesh {
    let unit = uv_sphere(slices, stacks);
    Mesh {
        positions: unit.positions.iter().map(|point| center + *point * radius).collect(),
        normals: unit.positions,
        triangles: unit.triangles,
        ..Mesh::default()
    }
}

/// The surface seen from the other side: of a solid, that of a hollow of its shape.
pub fn turned_inside_out(mut mesh: Mesh) -> Mesh {
    for triangle in &mut mesh.triangles {
        triangle.swap(1, 2);
    }
    for normal in &mut mesh.normals {
        *normal = -*normal;
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::is_closed;

    #[test]
    fn a_block_is_closed_and_faces_outwards() {
        let mesh = block(vec3(-1.0, -2.0, -3.0), vec3(3.0, 2.0, 1.0));
        assert!(is_closed(&mesh));
        let middle = vec3(1.0, 0.0, -1.0);
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
            assert!((b - a).cross(c - a).dot(a - middle) > 0.0);
        }
    }
}
