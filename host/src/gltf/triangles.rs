//! The triangles of all nodes, in one mesh.

use super::fault::{Fault, Place};
use super::material::Placement;
use super::primitive::Part;
use crate::asset::Asset;
use crate::mesh::Mesh;
use crate::shift::settle;
use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};

/// A mesh in the making, where it is in the scene.
pub(super) struct Triangles {
    /// At most so many triangles, and so many vertices.
    most: usize,
    positions: Vec<DVec3>,
    normals: Vec<Vec3>,
    colors: Vec<[u8; 4]>,
    coordinates: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
    material_ids: Vec<u32>,
}

impl Triangles {
    /// None yet.
    pub(super) fn new(most: usize) -> Self {
        Triangles {
            most: most.min(u32::MAX as usize),
            positions: Vec::new(),
            normals: Vec::new(),
            colors: Vec::new(),
            coordinates: Vec::new(),
            triangles: Vec::new(),
            material_ids: Vec::new(),
        }
    }

    /// Adds a primitive, which stands at `place` in the file, of one material.
    pub(super) fn add(
        &mut self,
        part: Part,
        transform: &DMat4,
        material: u32,
        placement: &Placement,
        place: &Place,
    ) -> Result<(), Fault> {
        let first = self.positions.len();
        let count = first + part.positions.len();
        if count > self.most || self.triangles.len() + part.triangles.len() > self.most {
            return Err(Fault::TooMany {
                place: place.clone(),
                most: self.most,
            });
        }
        self.positions.extend(
            part.positions
                .iter()
                .map(|at| transform.transform_point3(at.as_dvec3())),
        );
        if part.normals.is_empty() {
            // The format wants flat triangles then.
            self.normals.resize(count, Vec3::ZERO);
        } else {
            // Normals stay perpendicular to what they are normals of. The cofactors are the inverse's transpose but for the
            // determinant, whose sign matters, and they are there where nothing can be inverted.
            let DMat3 { x_axis, y_axis, z_axis } = DMat3::from_mat4(*transform);
            let cofactors = DMat3::from_cols(y_axis.cross(z_axis), z_axis.cross(x_axis), x_axis.cross(y_axis));
            let turn = transform.determinant().signum();
            self.normals.extend(part.normals.iter().map(|normal| {
                let normal = cofactors * normal.as_dvec3() * turn;
                normal.try_normalize().unwrap_or_default().as_vec3()
            }));
        }
        if !part.colors.is_empty() || !self.colors.is_empty() {
            self.colors.resize(first, [255; 4]);
            self.colors.extend(&part.colors);
            self.colors.resize(count, [255; 4]);
        }
        let coordinates = placement.set.and_then(|set| part.coordinates.get(set));
        let coordinates = coordinates.filter(|coordinates| !coordinates.is_empty());
        if coordinates.is_some() || !self.coordinates.is_empty() {
            self.coordinates.resize(first, Vec2::ZERO);
            let moved = coordinates.into_iter().flatten().map(|at| placement.coordinate(*at));
            self.coordinates.extend(moved);
            self.coordinates.resize(count, Vec2::ZERO);
        }
        // A mirror image keeps its front outside.
        let is_mirrored = transform.determinant() < 0.0;
        self.triangles.extend(part.triangles.iter().map(|&[a, b, c]| {
            let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
            corners.map(|corner| first as u32 + corner)
        }));
        self.material_ids.resize(self.triangles.len(), material);
        Ok(())
    }

    /// The mesh, near the origin.
    pub(super) fn into_asset(self) -> Result<Asset, Fault> {
        if self.triangles.is_empty() {
            return Err(Fault::NoTriangles);
        }
        let (positions, shift) = settle(&self.positions, &self.triangles).map_err(|_| Fault::TooFar)?;
        Ok(Asset {
            mesh: Mesh {
                positions,
                triangles: self.triangles,
                normals: self.normals,
                colors: self.colors,
                coordinates: self.coordinates,
                shift,
            },
            material_ids: self.material_ids,
            ..Asset::default()
        })
    }
}
