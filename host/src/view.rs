//! What the user sets about a picture, and the frame that follows from it.

use crate::scene::Scene;
use glam::Vec3;
use oktant_shared::camera::Camera;
use oktant_shared::frame::{Frame, SMOOTH_NORMALS};
use oktant_shared::orbit::{Orbit, Up};

/// How surfaces get their normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Each triangle is flat.
    Flat,
    /// Normals are interpolated between the vertices.
    #[default]
    Phong,
}

/// Samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Samples {
    /// One, in the middle.
    #[default]
    One,
    /// Two by two.
    Four,
    /// Four by four.
    Sixteen,
}

impl Samples {
    /// All of them, fewest first.
    pub const ALL: [Samples; 3] = [Samples::One, Samples::Four, Samples::Sixteen];

    /// Along each side of a pixel.
    pub fn per_side(self) -> u32 {
        match self {
            Samples::One => 1,
            Samples::Four => 2,
            Samples::Sixteen => 4,
        }
    }

    /// In all.
    pub fn count(self) -> u32 {
        self.per_side() * self.per_side()
    }
}

/// A point on a sphere around the mesh, as people say it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Degrees about the up axis, counterclockwise seen from above; 0 is in front.
    pub azimuth: f32,
    /// Degrees above the horizon, -90 to 90.
    pub elevation: f32,
    /// From the mesh's centre, in radii of its bounding sphere.
    pub distance: f32,
}

/// Everything about a picture but the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the camera is.
    pub camera: Place,
    /// Where the light is.
    pub light: Place,
    /// What the camera looks at, and circles, as an offset from the mesh's centre in radii of its bounding sphere.
    pub target: Vec3,
    /// Vertical field of view, degrees.
    pub field_of_view: f32,
    /// Which way is up.
    pub up: Up,
    /// How surfaces get their normals.
    pub shading: Shading,
    /// Samples of a pixel.
    pub samples: Samples,
}

impl Default for View {
    fn default() -> Self {
        View {
            camera: Place {
                azimuth: 0.0,
                elevation: 15.0,
                distance: 2.8,
            },
            light: Place {
                azimuth: -40.0,
                elevation: 50.0,
                distance: 6.0,
            },
            target: Vec3::ZERO,
            field_of_view: 40.0,
            up: Up::Y,
            shading: Shading::Phong,
            samples: Samples::One,
        }
    }
}

impl View {
    /// The frame that takes all samples of a picture of `width` times `height` pixels in one pass.
    pub fn frame(&self, scene: &Scene, width: u32, height: u32) -> Frame {
        let radius = scene.radius();
        let orbit = |place: &Place, center: Vec3| Orbit {
            center,
            radius: place.distance * radius,
            azimuth: place.azimuth,
            elevation: place.elevation,
            up: self.up,
        };
        let smooth = match self.shading {
            Shading::Flat => 0,
            Shading::Phong => SMOOTH_NORMALS,
        };
        Frame {
            camera: Camera::on_orbit(
                &orbit(&self.camera, scene.center() + self.target * radius),
                self.field_of_view,
                width,
                height,
            ),
            root: scene.root,
            background: Vec3::new(0.045, 0.06, 0.085),
            samples_per_side: self.samples.per_side(),
            light: orbit(&self.light, scene.center()).position(),
            first_sample: 0,
            light_color: Vec3::ONE,
            sample_count: self.samples.count(),
            base_color: Vec3::new(0.62, 0.58, 0.53),
            features: scene.features & (smooth | !SMOOTH_NORMALS),
            ambient: 0.12,
            diffuse: 0.85,
            specular: 0.22,
            exponent: 40.0,
        }
    }
}
