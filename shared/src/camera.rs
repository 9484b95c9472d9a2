//! The camera: a pinhole, or a plane that looks straight ahead.

use crate::orbit::Orbit;
use crate::ray::Ray;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// A camera as the kernel reads it.
///
/// In perspective all rays begin in the pinhole and part; in an orthographic picture they are parallel, and begin in the
/// plane through the eye that is at right angles to them: what lies behind it is not seen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Camera {
    /// The pinhole, or the middle of the plane, scene units.
    pub eye: Vec3,
    /// Width of the picture, pixels.
    pub width: u32,
    /// From the centre of the picture to the middle of its right edge, at distance 1 from the eye; scene units in an
    /// orthographic picture.
    pub right: Vec3,
    /// Height of the picture, pixels.
    pub height: u32,
    /// From the centre of the picture to the middle of its upper edge, at distance 1 from the eye; scene units in an
    /// orthographic picture.
    pub up: Vec3,
    /// From the middle between the eyes to each of them, scene units; 0 for one eye.
    pub eye_shift: f32,
    /// Unit vector from the eye to the centre of the picture.
    pub forward: Vec3,
    /// Depth at which the eyes' pictures coincide, scene units.
    pub convergence: f32,
    /// 0 in perspective, 1 in an orthographic picture: how much of the way across the picture lies between the rays' origins;
    /// the rest lies between their directions.
    pub parallel: f32,
    /// Fills the row; fields of their own because an array in a uniform buffer needs 16 bytes an element.
    pub reserved_a: f32,
    /// Fills the row.
    pub reserved_b: f32,
    /// Fills the row.
    pub reserved_c: f32,
}

const _: () = assert!(size_of::<Camera>() == 80);

impl Camera {
    /// A camera at a point of an orbit that looks at the orbit's centre, with the vertical field of view in degrees and
    /// the picture's size in pixels.
    pub fn on_orbit(orbit: &Orbit, field_of_view: f32, width: u32, height: u32) -> Self {
        Self::of_half_height(orbit, (field_of_view.to_radians() / 2.0).tan(), width, height)
    }

    /// The same without perspective: it sees so many scene units from the lower edge of the picture to the upper one.
    pub fn orthographic_on_orbit(orbit: &Orbit, seen_height: f32, width: u32, height: u32) -> Self {
        Camera {
            parallel: 1.0,
            ..Self::of_half_height(orbit, seen_height / 2.0, width, height)
        }
    }

    fn of_half_height(orbit: &Orbit, half_height: f32, width: u32, height: u32) -> Self {
        let [right, up] = orbit.right_and_up();
        let half_width = half_height * width as f32 / height as f32;
        Camera {
            eye: orbit.position(),
            width,
            right: right * half_width,
            height,
            up: up * half_height,
            eye_shift: 0.0,
            forward: -orbit.direction(),
            convergence: orbit.radius,
            parallel: 0.0,
            reserved_a: 0.0,
            reserved_b: 0.0,
            reserved_c: 0.0,
        }
    }

    /// The ray through a point of the picture, in pixels from its upper left corner, from the left eye (-1), the right
    /// one (1) or the middle between them (0). Its direction has the length 1 along the line of sight, so that `t` is
    /// the depth.
    ///
    /// Both eyes look straight ahead, and their pictures are shifted rather than the eyes turned, so that no point is
    /// higher in one picture than in the other (L. F. Hodges, "Time-multiplexed stereoscopic computer graphics", IEEE
    /// CG&A 12(2), 1992). A point at depth `z` is seen by the right eye `eye_shift * (1 / convergence - 1 / z)` to the
    /// right of where the middle sees it, in units of the picture plane at distance 1, and by the left eye as far to the
    /// left. An orthographic picture is for one eye: seen from apart, parallel rays see the same.
    #[inline]
    pub fn ray(&self, x: f32, y: f32, eye: f32) -> Ray {
        let across = x / self.width as f32 * 2.0 - 1.0;
        let upwards = 1.0 - y / self.height as f32 * 2.0;
        // In perspective the factor is 1, and what is added to the eye is 0: neither changes a bit.
        let parting = 1.0 - self.parallel;
        let direction = self.forward + self.right * (across * parting) + self.up * (upwards * parting);
        if eye == 0.0 {
            let offset = self.right * (across * self.parallel) + self.up * (upwards * self.parallel);
            return Ray::new(self.eye + offset, direction);
        }
        let aside = self.right.normalize() * (self.eye_shift * eye);
        Ray::new(self.eye + aside, direction - aside / self.convergence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::Up;

    fn orbit() -> Orbit {
        Orbit {
            center: Vec3::ONE,
            radius: 3.0,
            azimuth: 30.0,
            elevation: 20.0,
            up: Up::Y,
        }
    }

    #[test]
    fn the_middle_and_the_edges_of_the_picture() {
        let orbit = orbit();
        let camera = Camera::on_orbit(&orbit, 40.0, 1280, 968);
        let angle = |x, y| {
            let direction = camera.ray(x, y, 0.0).direction.normalize();
            direction.dot(camera.forward).acos().to_degrees()
        };
        assert!(camera.ray(640.0, 484.0, 0.0).at(3.0).distance(Vec3::ONE) < 1e-5);
        assert!((angle(640.0, 0.0) - 20.0).abs() < 1e-3);
        assert!((angle(640.0, 968.0) - 20.0).abs() < 1e-3);
        let half_width = (20.0_f32.to_radians().tan() * 1280.0 / 968.0).atan().to_degrees();
        assert!((angle(1280.0, 484.0) - half_width).abs() < 1e-3);
        assert!(camera.ray(1280.0, 484.0, 0.0).direction.dot(camera.right) > 0.0);
        assert!(camera.ray(640.0, 0.0, 0.0).direction.dot(camera.up) > 0.0);
    }

    #[test]
    fn parallel_rays_begin_in_a_plane_and_meet_the_edges() {
        let orbit = orbit();
        let camera = Camera::orthographic_on_orbit(&orbit, 4.0, 1280, 968);
        let [right, up] = orbit.right_and_up();
        assert!(camera.ray(640.0, 484.0, 0.0).at(3.0).distance(Vec3::ONE) < 1e-5);
        for (x, y) in [(0.0, 0.0), (640.0, 484.0), (1280.0, 0.0), (33.5, 900.25)] {
            let ray = camera.ray(x, y, 0.0);
            assert_eq!(ray.direction, camera.forward, "{x}, {y}");
            let offset = ray.origin - orbit.position();
            assert!(offset.dot(camera.forward).abs() < 1e-5, "{x}, {y}");
            // A pixel is as wide as it is high, and all of them are 4 units high.
            assert!((offset.dot(right) - (x - 640.0) * 4.0 / 968.0).abs() < 1e-5, "{x}, {y}");
            assert!((offset.dot(up) - (484.0 - y) * 4.0 / 968.0).abs() < 1e-5, "{x}, {y}");
        }
    }

    #[test]
    fn perspective_is_what_it_was_to_the_bit() {
        let orbit = Orbit {
            center: Vec3::new(0.1, -0.2, 0.3),
            radius: 2.8,
            azimuth: -33.3,
            elevation: 15.0,
            up: Up::Y,
        };
        let camera = Camera::on_orbit(&orbit, 40.0, 640, 484);
        for i in 0..1000 {
            let (x, y) = (i as f32 * 0.64, i as f32 * 0.483);
            let ray = camera.ray(x, y, 0.0);
            let across = x / 640.0 * 2.0 - 1.0;
            let upwards = 1.0 - y / 484.0 * 2.0;
            let direction = camera.forward + camera.right * across + camera.up * upwards;
            assert_eq!((ray.origin, ray.direction), (orbit.position(), direction));
        }
    }

    #[test]
    fn eyes_agree_at_the_depth_of_convergence_and_part_behind_it() {
        let orbit = Orbit {
            center: Vec3::ZERO,
            radius: 4.0,
            azimuth: -20.0,
            elevation: 35.0,
            up: Up::Z,
        };
        let camera = Camera {
            eye_shift: 0.03,
            convergence: 3.0,
            ..Camera::on_orbit(&orbit, 50.0, 640, 480)
        };
        for (x, y) in [(320.0, 240.0), (12.5, 400.5), (600.0, 3.0)] {
            let at = |eye, depth| camera.ray(x, y, eye).at(depth);
            assert!(at(-1.0, 3.0).distance(at(1.0, 3.0)) < 1e-6);
            let right = camera.right.normalize();
            assert!(at(1.0, 0.0).distance(camera.eye + right * 0.03) < 1e-6);
            // Twice as far they are crossed by as much.
            assert!((at(1.0, 6.0) - at(-1.0, 6.0)).distance(right * -0.06) < 1e-5);
        }
    }
}
