//! Moving camera and light.

use super::Session;
use super::flight::FARTHEST_TARGET;
use glam::Vec3;

/// Degrees that a drag of one pixel turns, at scale factor 1.
const DEGREES_PER_PIXEL: f32 = 0.3;
/// What a notch of the wheel multiplies the distance by.
const CLOSER: f32 = 0.9;
/// Least and greatest distance, radii of what is looked at.
pub const DISTANCES: [f32; 2] = [0.01, 1000.0];

impl Session {
    /// Turns the camera by a drag of so many pixels.
    pub(super) fn turn(&mut self, right: f32, down: f32) {
        let step = self.degrees_per_pixel();
        let camera = self.view.camera;
        // What is in front follows the pointer, so the camera goes the other way; in flight the camera follows it.
        let azimuth = wrapped(camera.azimuth - right * step);
        let elevation = (camera.elevation + down * step).clamp(-90.0, 90.0);
        if self.flight.is_on {
            self.look_around(azimuth, elevation);
        } else {
            (self.view.camera.azimuth, self.view.camera.elevation) = (azimuth, elevation);
        }
    }

    /// Turns the light by a drag of so many pixels.
    pub(super) fn turn_light(&mut self, right: f32, down: f32) {
        let step = self.degrees_per_pixel();
        let light = &mut self.view.light;
        light.azimuth = wrapped(light.azimuth + right * step);
        light.elevation = (light.elevation - down * step).clamp(-90.0, 90.0);
    }

    /// Comes closer by so many notches of the wheel; where rays are parallel, and nearness changes nothing, shows less.
    pub(super) fn zoom(&mut self, notches: f32) {
        let closer = |length: f32| (length * CLOSER.powf(notches)).clamp(DISTANCES[0], DISTANCES[1]);
        if self.view.is_orthographic() {
            self.view.ortho_height = Some(closer(self.view.seen_height()));
        } else {
            self.view.camera.distance = closer(self.view.camera.distance);
        }
    }

    /// Moves the target so that a point at its depth follows the pointer.
    pub(super) fn pan(&mut self, right: f32, down: f32) {
        let [to_right, upwards] = self.unit_orbit().right_and_up();
        let per_pixel = self.view.seen_height() / self.size[1].max(1) as f32;
        let target = self.view.target - to_right * (right * per_pixel) + upwards * (down * per_pixel);
        self.view.target = target.clamp_length_max(FARTHEST_TARGET);
    }

    /// Looks at the centre from where the sphere around what is looked at just fits.
    pub(super) fn frame(&mut self) {
        let narrowing = (self.size[0].max(1) as f32 / self.size[1].max(1) as f32).min(1.0);
        let narrower = (self.view.half_height() * narrowing).atan();
        self.flight.is_on = false;
        self.view.target = Vec3::ZERO;
        // Also where that does not change what is large: nothing of it is then behind the camera.
        self.view.camera.distance = (1.0 / narrower.sin()).clamp(DISTANCES[0], DISTANCES[1]);
        if self.view.is_orthographic() {
            self.view.ortho_height = Some(2.0 / narrowing);
        }
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
