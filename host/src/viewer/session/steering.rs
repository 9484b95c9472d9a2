//! Moving camera and light.

use super::Session;
use glam::Vec3;
use oktant_shared::orbit::Orbit;

/// Degrees that a drag of one pixel turns, at scale factor 1.
const DEGREES_PER_PIXEL: f32 = 0.3;
/// What a notch of the wheel multiplies the distance by.
const CLOSER: f32 = 0.9;
/// Least and greatest distance, radii of what is looked at.
pub const DISTANCES: [f32; 2] = [0.01, 1000.0];
/// Farthest target, radii of what is looked at.
const FARTHEST_TARGET: f32 = 1000.0;

impl Session {
    /// Turns the camera by a drag of so many pixels.
    pub(super) fn turn(&mut self, right: f32, down: f32) {
        let step = self.degrees_per_pixel();
        let camera = &mut self.view.camera;
        // What is in front follows the pointer, so the camera goes the other way.
        camera.azimuth = wrapped(camera.azimuth - right * step);
        camera.elevation = (camera.elevation + down * step).clamp(-90.0, 90.0);
    }

    /// Turns the light by a drag of so many pixels.
    pub(super) fn turn_light(&mut self, right: f32, down: f32) {
        let step = self.degrees_per_pixel();
        let light = &mut self.view.light;
        light.azimuth = wrapped(light.azimuth + right * step);
        light.elevation = (light.elevation - down * step).clamp(-90.0, 90.0);
    }

    /// Comes closer by so many notches of the wheel.
    pub(super) fn zoom(&mut self, notches: f32) {
        let camera = &mut self.view.camera;
        camera.distance = (camera.distance * CLOSER.powf(notches)).clamp(DISTANCES[0], DISTANCES[1]);
    }

    /// Moves the target so that a point at its depth follows the pointer.
    pub(super) fn pan(&mut self, right: f32, down: f32) {
        let camera = self.view.camera;
        let orbit = Orbit {
            center: Vec3::ZERO,
            radius: camera.distance,
            azimuth: camera.azimuth,
            elevation: camera.elevation,
            up: self.view.up,
        };
        let [to_right, upwards] = orbit.right_and_up();
        let half_height = camera.distance * (self.view.field_of_view.to_radians() / 2.0).tan();
        let per_pixel = 2.0 * half_height / self.size[1].max(1) as f32;
        let target = self.view.target - to_right * (right * per_pixel) + upwards * (down * per_pixel);
        self.view.target = target.clamp_length_max(FARTHEST_TARGET);
    }

    /// Looks at the centre from where the sphere around what is looked at just fits.
    pub(super) fn frame(&mut self) {
        let half_height = (self.view.field_of_view.to_radians() / 2.0).tan();
        let aspect = self.size[0].max(1) as f32 / self.size[1].max(1) as f32;
        let narrower = (half_height * aspect.min(1.0)).atan();
        self.view.target = Vec3::ZERO;
        self.view.camera.distance = (1.0 / narrower.sin()).clamp(DISTANCES[0], DISTANCES[1]);
    }

    fn degrees_per_pixel(&self) -> f32 {
        DEGREES_PER_PIXEL / self.scale as f32
    }
}

/// The same angle, at least -180 and less than 180 degrees.
pub fn wrapped(degrees: f32) -> f32 {
    if (-180.0..180.0).contains(&degrees) {
        degrees
    } else {
        (degrees + 180.0).rem_euclid(360.0) - 180.0
    }
}
