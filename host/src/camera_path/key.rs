//! Key frames, as they stand in a file.

use crate::scene_file::number::{Degrees, Elevation, FieldOfView, Radii, Stops, Time};
use crate::scene_file::vector::Vector;
use crate::view::View;
use serde::Deserialize;

/// A file of key frames.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Description {
    /// In the order of their times.
    pub key: Vec<Key>,
}

/// `[[key]]`: what a view is at a time. What is left out is as it is without the path.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Key {
    /// When; only how it lies between the first and the last time matters.
    pub time: Time,
    /// Where the camera stands, degrees: 0 in front, counterclockwise seen from above.
    pub azimuth: Option<Degrees>,
    /// How high it stands, degrees above the horizon, -90 to 90.
    pub elevation: Option<Elevation>,
    /// How far it is from what it looks at, in radii.
    pub distance: Option<Radii>,
    /// Vertical field of view, degrees, 1 to 170.
    pub fov: Option<FieldOfView>,
    /// What an orthographic picture shows from its lower edge to the upper one, in radii.
    pub ortho_height: Option<Radii>,
    /// What it looks at and circles, as an offset in radii along the scene's axes.
    pub target: Option<Vector>,
    /// Where the first light stands, degrees.
    pub light_azimuth: Option<Degrees>,
    /// How high it stands, degrees above the horizon, -90 to 90.
    pub light_elevation: Option<Elevation>,
    /// How far it is, in radii.
    pub light_distance: Option<Radii>,
    /// Brightness in stops, each of which doubles the light, -30 to 30.
    pub exposure: Option<Stops>,
}

impl Key {
    /// A view with what the key says changed.
    pub fn applied(&self, view: &View) -> View {
        fn set<T: Copy>(value: &mut T, given: Option<T>) {
            *value = given.unwrap_or(*value);
        }
        let mut view = *view;
        set(&mut view.camera.azimuth, self.azimuth.map(|degrees| degrees.0 as f32));
        set(&mut view.camera.elevation, self.elevation.map(|degrees| degrees.0));
        set(&mut view.camera.distance, self.distance.map(|radii| radii.0));
        set(&mut view.field_of_view, self.fov.map(|degrees| degrees.0));
        view.ortho_height = self.ortho_height.map(|radii| radii.0).or(view.ortho_height);
        set(&mut view.target, self.target.map(|offset| offset.0.as_vec3()));
        set(
            &mut view.light.azimuth,
            self.light_azimuth.map(|degrees| degrees.0 as f32),
        );
        set(&mut view.light.elevation, self.light_elevation.map(|degrees| degrees.0));
        set(&mut view.light.distance, self.light_distance.map(|radii| radii.0));
        set(&mut view.tone.exposure, self.exposure.map(|stops| stops.0));
        view
    }
}
