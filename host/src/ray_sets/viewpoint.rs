//! From where a set of rays is sent out.

use glam::{DVec3, UVec2};

/// A pinhole camera and a point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// What tables call it.
    pub name: &'static str,
    /// Where rays start, scene units.
    pub eye: DVec3,
    /// Unit vectors.
    pub forward: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    /// Tangent of half the vertical field of view.
    pub tangent: f64,
    /// The light, scene units.
    pub light: DVec3,
}

impl Viewpoint {
    /// A camera with y up. `forward` need not be of unit length; the field of view is vertical, degrees.
    pub fn new(name: &'static str, eye: DVec3, forward: DVec3, field_of_view: f64, light: DVec3) -> Self {
        let forward = forward.normalize();
        let right = forward.cross(DVec3::Y).normalize();
        Viewpoint {
            name,
            eye,
            forward,
            right,
            up: right.cross(forward),
            tangent: (field_of_view.to_radians() / 2.0).tan(),
            light,
        }
    }

    /// Where the middle of a pixel lies as seen from the eye, in any length.
    pub fn direction(&self, pixel: UVec2, size: UVec2) -> DVec3 {
        let (pixel, size) = (pixel.as_dvec2(), size.as_dvec2());
        let x = ((pixel.x + 0.5) / size.x * 2.0 - 1.0) * (self.tangent * size.x / size.y);
        let y = (1.0 - (pixel.y + 0.5) / size.y * 2.0) * self.tangent;
        self.forward + self.right * x + self.up * y
    }
}
