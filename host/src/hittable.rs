//! The triangles of a mesh that rays can hit.

use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::octree::distinct;
use glam::Vec3;
use rayon::prelude::*;

/// The triangles that have an area and do not lie exactly on another one.
pub(crate) struct Hittable {
    /// The corners of all triangles of the mesh, by id.
    pub corners: Vec<[Vec3; 3]>,
    /// The ids of those that can be hit, ascending.
    pub ids: Vec<u32>,
    /// Smallest coordinates of their corners, scene units.
    pub low: Vec3,
    /// Largest coordinates of their corners, scene units.
    pub high: Vec3,
    /// Triangles left out because they have no area.
    pub degenerate: u32,
    /// Triangles left out because they lie exactly on one with a lower id.
    pub duplicates: u32,
}

impl Hittable {
    /// Those of a mesh.
    ///
    /// # Errors
    /// [`BuildError::NoArea`] where there are none.
    pub(crate) fn of(mesh: &Mesh) -> Result<Self, BuildError> {
        let corners: Vec<[Vec3; 3]> = mesh
            .triangles
            .par_iter()
            .map(|triangle| triangle.map(|index| mesh.positions[index as usize]))
            .collect();
        let distinct = distinct(mesh, &corners);
        let (low, high) = distinct
            .ids
            .par_iter()
            .map(|id| {
                let [a, b, c] = corners[*id as usize];
                (a.min(b).min(c), a.max(b).max(c))
            })
            .reduce_with(|a, b| (a.0.min(b.0), a.1.max(b.1)))
            .ok_or(BuildError::NoArea)?;
        Ok(Hittable {
            corners,
            ids: distinct.ids,
            low,
            high,
            degenerate: distinct.degenerate,
            duplicates: distinct.duplicates,
        })
    }
}
