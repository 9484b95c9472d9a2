//! Parallelograms.

use super::assembly::Assembly;
use super::fault::{Fault, Reason};
use super::place::Place;
use super::vector::{Direction, Vector};
use crate::shapes;
use crate::transform::Transform;
use glam::Vec3;
use serde::Deserialize;

/// `[[quad]]`: a parallelogram of 2 triangles.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quad {
    /// A corner, scene units. Default: [0, 0, 0].
    #[serde(default)]
    pub corner: Vector,
    /// One edge from the corner, scene units; mandatory.
    pub edge_u: Direction,
    /// The other edge from the corner, scene units; mandatory. The front is on the side of `edge_u x edge_v`.
    pub edge_v: Direction,
    /// Name of its material. Default: clay.
    pub material: Option<String>,
}

impl Quad {
    /// Adds it to the scene.
    pub fn add_to(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<(), Fault> {
        let material = assembly
            .palette
            .id(self.material.as_deref(), false, &place.key("material"))?;
        let mesh = shapes::quad(Vec3::ZERO, self.edge_u.0.as_vec3(), self.edge_v.0.as_vec3());
        if mesh.normals[0] == Vec3::ZERO {
            return Err(Fault::new(place, Reason::NoArea));
        }
        let transform = Transform {
            translation: self.corner.0,
            ..Transform::IDENTITY
        };
        assembly.add(place, mesh, &transform, material)
    }
}
