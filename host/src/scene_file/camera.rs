//! From where the picture is taken.

use super::fault::{Fault, Reason};
use super::number::{Degrees, Elevation, FieldOfView, Length};
use super::place::Place;
use super::vector::Vector;
use crate::model::Focus;
use crate::projection::Projection;
use crate::view::View;
use glam::{DVec3, Vec3};
use serde::Deserialize;

/// `[camera]`: where the camera is and what it looks at. Its place is given as `position`, or as the angles `azimuth` and
/// `elevation` and the `distance` from what it looks at.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Camera {
    /// Where it is, scene units.
    pub position: Option<Vector>,
    /// The point that it looks at and circles, scene units. Default: the middle of the box around all triangles.
    pub look_at: Option<Vector>,
    /// Where it stands instead, degrees: 0 in front, counterclockwise seen from above. Default: 0.
    pub azimuth: Option<Degrees>,
    /// How high it stands, degrees above the horizon, -90 to 90. Default: 15.
    pub elevation: Option<Elevation>,
    /// How far it is from what it looks at, scene units. Default: 2.8 radii of the sphere around all triangles.
    pub distance: Option<Length>,
    /// Vertical field of view, degrees, 1 to 170. Default: 40.
    pub fov: Option<FieldOfView>,
    /// "perspective" or "orthographic". Default: "perspective".
    pub projection: Option<Projection>,
    /// What an orthographic picture shows from its lower edge to the upper one, scene units. Default: what a picture in
    /// perspective shows at the distance of what is looked at.
    pub height: Option<Length>,
}

impl Camera {
    /// Points the view, and says what it is about where the file says more than a direction: the sphere around what is
    /// looked at that just fits. `whole` is a sphere around everything.
    pub fn apply(&self, view: &mut View, whole: Focus) -> Result<Option<Focus>, Fault> {
        let place = Place::of("camera");
        self.check(&place)?;
        if let Some(fov) = self.fov {
            view.field_of_view = fov.0;
        }
        view.projection = self.projection.unwrap_or(view.projection);
        let focus = self.point(&place, view, whole)?;
        let Some(height) = self.height else { return Ok(focus) };
        if let Some(focus) = focus {
            return Ok(Some(view.show_height(focus, height.0)));
        }
        view.ortho_height = Some(height.0 / whole.radius);
        Ok(None)
    }

    /// Makes sure that no field contradicts another.
    pub(crate) fn check(&self, place: &Place) -> Result<(), Fault> {
        for (key, is_there) in [
            ("azimuth", self.azimuth.is_some()),
            ("elevation", self.elevation.is_some()),
            ("distance", self.distance.is_some()),
        ] {
            if is_there && self.position.is_some() {
                return Err(Fault::new(&place.key(key), Reason::Excludes("position")));
            }
        }
        if self.height.is_some() && self.projection.unwrap_or_default() == Projection::Perspective {
            return Err(Fault::new(&place.key("height"), Reason::Inapplicable("perspective")));
        }
        Ok(())
    }

    /// From what is looked at to the position, if there is one.
    pub(crate) fn offset_from(&self, place: &Place, look_at: DVec3) -> Result<Option<Vec3>, Fault> {
        let Some(position) = self.position else { return Ok(None) };
        let offset = (position.0 - look_at).as_vec3();
        if offset == Vec3::ZERO {
            return Err(Fault::new(&place.key("position"), Reason::NoDirection));
        }
        Ok(Some(offset))
    }

    /// Places the camera, and says what it circles where the file says that.
    fn point(&self, place: &Place, view: &mut View, whole: Focus) -> Result<Option<Focus>, Fault> {
        if let Some(azimuth) = self.azimuth {
            view.camera.azimuth = azimuth.0 as f32;
        }
        if let Some(elevation) = self.elevation {
            view.camera.elevation = elevation.0;
        }
        let center = self.look_at.map_or(whole.center, |point| point.0.as_vec3());
        if let Some(offset) = self.offset_from(place, center.as_dvec3())? {
            return Ok(Some(view.look(center, offset)));
        }
        let distance = match self.distance {
            Some(distance) => distance.0,
            None if self.look_at.is_none() => return Ok(None),
            None => view.camera.distance * whole.radius,
        };
        Ok(Some(view.look_from(center, distance)))
    }
}
