//! The pinhole camera.

use crate::orbit::Orbit;
use crate::ray::Ray;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// A pinhole camera as the kernel reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Camera {
    /// The pinhole, scene units.
    pub eye: Vec3,
    /// Width of the picture, pixels.
    pub width: u32,
    /// From the centre of the picture to the middle of its right edge, at distance 1 from the eye.
    pub right: Vec3,
    /// Height of the picture, pixels.
    pub height: u32,
    /// From the centre of the picture to the middle of its upper edge, at distance 1 from the eye.
    pub up: Vec3,
    /// Fills the row.
    pub reserved_a: u32,
    /// Unit vector from the eye to the centre of the picture.
    pub forward: Vec3,
    /// Fills the row.
    pub reserved_b: u32,
}

const _: () = assert!(size_of::<Camera>() == 64);

impl Camera {
    /// A camera at a point of an orbit that looks at the orbit's centre, with the vertical field of view in degrees and
    /// the picture's size in pixels.
    pub fn on_orbit(orbit: &Orbit, field_of_view: f32, width: u32, height: u32) -> Self {
        let [right, up] = orbit.right_and_up();
        let half_height = (field_of_view.to_radians() / 2.0).tan();
        let half_width = half_height * width as f32 / height as f32;
        Camera {
            eye: orbit.position(),
            width,
            right: right * half_width,
            height,
            up: up * half_height,
            reserved_a: 0,
            forward: -orbit.direction(),
            reserved_b: 0,
        }
    }

    /// The ray through a point of the picture, in pixels from its upper left corner. Its direction has the length 1
    /// along the line of sight, so that `t` is the depth.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        let across = x / self.width as f32 * 2.0 - 1.0;
        let upwards = 1.0 - y / self.height as f32 * 2.0;
        Ray::new(self.eye, self.forward + self.right * across + self.up * upwards)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::Up;

    #[test]
    fn the_middle_and_the_edges_of_the_picture() {
        let orbit = Orbit {
            center: Vec3::ONE,
            radius: 3.0,
            azimuth: 30.0,
            elevation: 20.0,
            up: Up::Y,
        };
        let camera = Camera::on_orbit(&orbit, 40.0, 1280, 968);
        let angle = |x, y| {
            let direction = camera.ray(x, y).direction.normalize();
            direction.dot(camera.forward).acos().to_degrees()
        };
        assert!(camera.ray(640.0, 484.0).at(3.0).distance(Vec3::ONE) < 1e-5);
        assert!((angle(640.0, 0.0) - 20.0).abs() < 1e-3);
        assert!((angle(640.0, 968.0) - 20.0).abs() < 1e-3);
        let half_width = (20.0_f32.to_radians().tan() * 1280.0 / 968.0).atan().to_degrees();
        assert!((angle(1280.0, 484.0) - half_width).abs() < 1e-3);
        assert!(camera.ray(1280.0, 484.0).direction.dot(camera.right) > 0.0);
        assert!(camera.ray(640.0, 0.0).direction.dot(camera.up) > 0.0);
    }
}
