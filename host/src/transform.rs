//! Moving, turning and scaling meshes.

use crate::mesh::Mesh;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// Squares of coordinates up to this fit into 32 bits.
const FARTHEST: f32 = 1e15;

/// A linear map, then a translation. In f64, so that meshes far from the origin can be brought near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Invertible.
    pub linear: DMat3,
    /// Scene units.
    pub translation: DVec3,
}

impl Transform {
    /// Changes nothing.
    pub const IDENTITY: Transform = Transform {
        linear: DMat3::IDENTITY,
        translation: DVec3::ZERO,
    };

    /// Scales along the axes, turns about the x, then the y, then the z axis (degrees, counterclockwise seen from the
    /// axis's end), and moves.
    pub fn new(scale: DVec3, degrees: DVec3, translation: DVec3) -> Self {
        let [x, y, z] = degrees.to_array().map(f64::to_radians);
        Transform {
            linear: DMat3::from_rotation_z(z)
                * DMat3::from_rotation_y(y)
                * DMat3::from_rotation_x(x)
                * DMat3::from_diagonal(scale),
            translation,
        }
    }

    /// The mesh moved there. A mirror image keeps its front outside: its triangles run the other way round. None where a
    /// coordinate would be beyond 1e15.
    ///
    /// [`Mesh::shift`] is undone first, so the mesh is moved from where its file has it.
    pub fn apply(&self, mut mesh: Mesh) -> Option<Mesh> {
        let shift = mesh.shift;
        mesh.positions.par_iter_mut().for_each(|position| {
            *position = (self.linear * (position.as_dvec3() + shift) + self.translation).as_vec3();
        });
        mesh.shift = DVec3::ZERO;
        if !mesh
            .positions
            .par_iter()
            .all(|position| position.abs().max_element() <= FARTHEST)
        {
            return None;
        }
        // Normals stay perpendicular to what they are normals of.
        let normals = self.linear.inverse().transpose();
        mesh.normals.par_iter_mut().for_each(|normal| {
            *normal = (normals * normal.as_dvec3())
                .try_normalize()
                .unwrap_or_default()
                .as_vec3();
        });
        if self.linear.determinant() < 0.0 {
            mesh.triangles.par_iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Some(mesh)
    }
}
