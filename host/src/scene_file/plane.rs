//! Planes without end.

use super::assembly::Assembly;
use super::fault::Fault;
use super::place::Place;
use super::vector::{Direction, Vector};
use oktant_shared::plane;
use serde::Deserialize;

/// `[[plane]]`: a plane without end; no triangles. Its texture coordinates count in scene units.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Plane {
    /// A point of it, scene units. Default: [0, 0, 0].
    pub point: Vector,
    /// The direction in which its front looks. Default: upwards.
    pub normal: Option<Direction>,
    /// Name of its material. Default: clay.
    pub material: Option<String>,
}

impl Plane {
    /// The plane as the kernel reads it.
    pub fn build(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<plane::Plane, Fault> {
        let material = assembly
            .palette
            .id(self.material.as_deref(), false, &place.key("material"))?;
        let normal = self.normal.map(|normal| normal.0.normalize().as_vec3());
        let normal = normal.unwrap_or(assembly.up.axes()[1]);
        Ok(plane::Plane::new(self.point.0.as_vec3(), normal, material))
    }
}
