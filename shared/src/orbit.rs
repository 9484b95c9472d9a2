//! A place on a sphere around a centre.

use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// Which way is up in a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// Up is +Y, the front looks to +Z.
    #[default]
    Y,
    /// Up is +Z, the front looks to -Y.
    Z,
}

impl Up {
    /// The axes to the right, up and to the front (towards the viewer at azimuth 0); right-handed, unit length.
    pub fn axes(self) -> [Vec3; 3] {
        match self {
            Up::Y => [Vec3::X, Vec3::Y, Vec3::Z],
            Up::Z => [Vec3::X, Vec3::Z, Vec3::NEG_Y],
        }
    }
}

/// A point that moves on a sphere: the camera's or the light's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// The sphere's centre, scene units.
    pub center: Vec3,
    /// The sphere's radius, scene units.
    pub radius: f32,
    /// Degrees about the up axis, counterclockwise seen from above; 0 is in front.
    pub azimuth: f32,
    /// Degrees above the horizon, -90 to 90.
    pub elevation: f32,
    /// Which way is up.
    pub up: Up,
}

impl Orbit {
    /// The unit vector from the centre to the point.
    pub fn direction(&self) -> Vec3 {
        let [right, up, front] = self.up.axes();
        let azimuth = self.azimuth.to_radians();
        let elevation = self.elevation.to_radians();
        (right * azimuth.sin() + front * azimuth.cos()) * elevation.cos() + up * elevation.sin()
    }

    /// The point, scene units.
    pub fn position(&self) -> Vec3 {
        self.center + self.direction() * self.radius
    }

    /// The unit vectors to the right and upwards of somebody at the point who looks at the centre, level with the
    /// horizon; defined at the poles too.
    pub fn right_and_up(&self) -> [Vec3; 2] {
        let [right, _, front] = self.up.axes();
        let azimuth = self.azimuth.to_radians();
        let right = right * azimuth.cos() - front * azimuth.sin();
        [right, self.direction().cross(right)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    fn orbit(azimuth: f32, elevation: f32, up: Up) -> Orbit {
        Orbit {
            center: vec3(1.0, 2.0, 3.0),
            radius: 2.0,
            azimuth,
            elevation,
            up,
        }
    }

    #[test]
    fn the_named_directions() {
        let at = |azimuth, elevation, up| orbit(azimuth, elevation, up).position() - vec3(1.0, 2.0, 3.0);
        let cases = [
            (at(0.0, 0.0, Up::Y), vec3(0.0, 0.0, 2.0)),
            (at(90.0, 0.0, Up::Y), vec3(2.0, 0.0, 0.0)),
            (at(0.0, 90.0, Up::Y), vec3(0.0, 2.0, 0.0)),
            (at(0.0, 0.0, Up::Z), vec3(0.0, -2.0, 0.0)),
            (at(90.0, 0.0, Up::Z), vec3(2.0, 0.0, 0.0)),
            (at(0.0, 90.0, Up::Z), vec3(0.0, 0.0, 2.0)),
        ];
        for (i, (is, wanted)) in cases.into_iter().enumerate() {
            assert!(is.distance(wanted) < 1e-6, "case {i}: {is}");
        }
    }

    #[test]
    fn the_frame_is_orthonormal_and_right_handed() {
        for up in [Up::Y, Up::Z] {
            for (azimuth, elevation) in [(0.0, 0.0), (33.0, 20.0), (250.0, -80.0), (10.0, 90.0), (10.0, -90.0)] {
                let orbit = orbit(azimuth, elevation, up);
                let [right, above] = orbit.right_and_up();
                let back = orbit.direction();
                assert!((right.cross(above) - back).length() < 1e-6);
                assert!((right.length() - 1.0).abs() < 1e-6 && (above.length() - 1.0).abs() < 1e-6);
                assert!(above.dot(up.axes()[1]) > -1e-6, "never upside down");
            }
        }
    }
}
