//! Surfaces of revolution.

use super::assembly::Assembly;
use super::fault::{Fault, Reason};
use super::number::{Coordinate, Slices};
use super::place::Place;
use super::vector::Vector;
use crate::shapes;
use glam::{Vec2, vec2};
use serde::Deserialize;

/// `[[lathe]]`: what a lathe or a potter's wheel makes: an outline that turns about the up axis. Between two points of the
/// outline there are `2 * slices` triangles, or `slices` where one of them lies on the axis.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lathe {
    /// The outline, as `[radius, height]` of its points, scene units, two and more; mandatory. Where it runs upwards, the
    /// front looks outwards. It encloses a volume if it starts and ends on the axis, or where it started.
    pub profile: Vec<[Coordinate; 2]>,
    /// Where the axis meets the height 0, scene units. Default: [0, 0, 0].
    pub center: Vector,
    /// Parts of the circle, 3 to 1000. Default: 48.
    pub slices: Option<Slices>,
    /// Degrees that it turns about its axes: x to the right, then y upwards, then z to the front. Default: [0, 0, 0].
    pub rotate: Vector,
    /// Name of its material. Default: clay.
    pub material: Option<String>,
}

/// Edges of the outline are round where it turns by less, in degrees.
const CREASE: f64 = 40.0;

impl Lathe {
    /// Adds it to the scene.
    pub fn add_to(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<(), Fault> {
        let material = assembly
            .palette
            .id(self.material.as_deref(), false, &place.key("material"))?;
        let profile = self.profile(&place.key("profile"))?;
        let mesh = shapes::lathe(&shapes::Lathe {
            profile: &profile,
            slices: self.slices.map_or(48, |slices| slices.0),
            crease: CREASE,
        });
        let transform = assembly.placed(self.rotate.0, self.center.0);
        assembly.add(place, mesh, &transform, material)
    }

    fn profile(&self, place: &Place) -> Result<Vec<Vec2>, Fault> {
        let points: Vec<Vec2> = self
            .profile
            .iter()
            .map(|[radius, height]| vec2(radius.0 as f32, height.0 as f32))
            .collect();
        if points.len() < 2 {
            return Err(Fault::new(place, Reason::Lacks("two or more points [radius, height]")));
        }
        for (i, point) in points.iter().enumerate() {
            if point.x < 0.0 {
                return Err(Fault::new(&place.index(i), Reason::NegativeRadius));
            }
            if i > 0 && *point == points[i - 1] {
                return Err(Fault::new(&place.index(i), Reason::SamePoint));
            }
        }
        Ok(points)
    }
}
