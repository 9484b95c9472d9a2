//! Spheres.

use super::assembly::Assembly;
use super::fault::Fault;
use super::number::{Length, Triangles};
use super::place::Place;
use super::vector::Vector;
use crate::shapes;
use serde::Deserialize;

/// `[[sphere]]`: a sphere of triangles whose vertices lie on it, with its normals.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sphere {
    /// Its centre, scene units. Default: [0, 0, 0].
    pub center: Vector,
    /// Its radius, scene units. Default: 1.
    pub radius: Option<Length>,
    /// Name of its material. Default: clay.
    pub material: Option<String>,
    /// At most so many triangles, 8 to 1000000; there are 4 n (n - 1), for the largest n that fits. Default: 1520.
    pub triangles: Option<Triangles>,
    /// Degrees that its texture turns about the sphere's axes: x to the right, then y upwards, then z to the front.
    /// Default: [0, 0, 0].
    pub rotate: Vector,
}

impl Sphere {
    /// Adds it to the scene.
    pub fn add_to(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<(), Fault> {
        let material = assembly
            .palette
            .id(self.material.as_deref(), false, &place.key("material"))?;
        let radius = self.radius.map_or(1.0, |radius| radius.0);
        let mesh = shapes::sphere(radius, self.triangles.map_or(1520, |triangles| triangles.0));
        let transform = assembly.placed(self.rotate.0, self.center.0);
        assembly.add(place, mesh, &transform, material)
    }
}
