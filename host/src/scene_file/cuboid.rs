//! Boxes.

use super::assembly::Assembly;
use super::fault::{Fault, Reason};
use super::number::{Each, Length};
use super::place::Place;
use super::vector::Vector;
use crate::shapes;
use crate::transform::Transform;
use glam::{DVec3, Vec3};
use serde::Deserialize;

/// `[[box]]`: a box of 12 triangles, given by its centre and size, or by two opposite corners.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Cuboid {
    /// Its centre, scene units. Default: [0, 0, 0].
    pub center: Option<Vector>,
    /// Its edges along x, y and z, scene units, or one number for a cube. Default: 1.
    pub size: Option<Each<Length, 3>>,
    /// Instead: the corner with the smallest coordinates, scene units.
    pub low: Option<Vector>,
    /// Instead: the corner with the largest coordinates, scene units.
    pub high: Option<Vector>,
    /// Degrees that it turns about its centre, about the x, then the y, then the z axis. Default: [0, 0, 0].
    pub rotate: Vector,
    /// Name of its material. Default: clay.
    pub material: Option<String>,
}

impl Cuboid {
    /// Adds it to the scene.
    pub fn add_to(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<(), Fault> {
        let material = assembly
            .palette
            .id(self.material.as_deref(), false, &place.key("material"))?;
        let (center, size) = self.center_and_size(place)?;
        let transform = Transform::new(DVec3::ONE, self.rotate.0, center);
        assembly.add(place, shapes::cuboid(size), &transform, material)
    }

    fn center_and_size(&self, place: &Place) -> Result<(DVec3, Vec3), Fault> {
        let (low, high) = match (self.low, self.high) {
            (None, None) => {
                let size = self
                    .size
                    .map_or(Vec3::ONE, |size| Vec3::from_array(size.0.map(|edge| edge.0)));
                return Ok((self.center.unwrap_or_default().0, size));
            }
            (Some(_), None) => return Err(Fault::new(place, Reason::Lacks("its other corner, high"))),
            (None, Some(_)) => return Err(Fault::new(place, Reason::Lacks("its other corner, low"))),
            (Some(low), Some(high)) => (low.0, high.0),
        };
        for (key, is_there) in [("center", self.center.is_some()), ("size", self.size.is_some())] {
            if is_there {
                return Err(Fault::new(&place.key(key), Reason::Excludes("low and high")));
            }
        }
        let size = (high - low).as_vec3();
        if size.min_element() <= 0.0 {
            return Err(Fault::new(&place.key("low"), Reason::NotBelow));
        }
        Ok(((low + high) / 2.0, size))
    }
}
