//! Checkerboards.

use super::assembly::Assembly;
use super::fault::Fault;
use super::number::{Each, Length, Squares};
use super::place::Place;
use super::vector::Vector;
use crate::shapes;
use glam::Vec2;
use serde::Deserialize;

/// `[[checkerboard]]`: a level board of two materials, two triangles a square.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Checkerboard {
    /// Its centre, scene units. Default: [0, 0, 0].
    pub center: Vector,
    /// Its edges to the right and to the front, scene units, or one number for both. Default: 10.
    pub size: Option<Each<Length, 2>>,
    /// How many squares lie along its edges, 1 to 1000, or one number for both. Default: 10.
    pub squares: Option<Each<Squares, 2>>,
    /// Names of the two materials, the first that of the square at the left end of the back edge; mandatory.
    pub materials: Option<[String; 2]>,
    /// Degrees that it turns about its axes: x to the right, then y upwards, then z to the front. Default: [0, 0, 0].
    pub rotate: Vector,
}

impl Checkerboard {
    /// Adds it to the scene.
    pub fn add_to(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<(), Fault> {
        let Some(materials) = &self.materials else {
            let reason = super::fault::Reason::Lacks("the names of its two materials, materials");
            return Err(Fault::new(place, reason));
        };
        let place_of_materials = place.key("materials");
        let mut ids = [0; 2];
        for (i, name) in materials.iter().enumerate() {
            ids[i] = assembly.palette.id(Some(name), false, &place_of_materials.index(i))?;
        }
        let size = self
            .size
            .map_or(Vec2::splat(10.0), |size| Vec2::from_array(size.0.map(|edge| edge.0)));
        let squares = self.squares.map_or([10; 2], |squares| squares.0.map(|count| count.0));
        let (mesh, is_second) = shapes::checkerboard(size, squares);
        let by_triangle: Vec<_> = is_second.into_iter().map(|second| ids[usize::from(second)]).collect();
        let transform = assembly.placed(self.rotate.0, self.center.0);
        assembly.add_mixed(place, mesh, &transform, &by_triangle)
    }
}
