//! The camera and the place of the light, as a view tells them.

use crate::model::{Focus, Model};
use crate::projection::Projection;
use crate::stereo::{Stereo, StereoMode};
use crate::view::{Place, View};
use glam::{DVec2, DVec3};
use oktant_shared::orbit::Up;

/// Distance of the eyes where nobody says it, in parts of the convergence.
const EYE_PART: f64 = 1.0 / 30.0;

/// A pinhole camera, or two beside each other that look straight ahead; or a plane from which parallel rays leave.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    /// The pinhole, the middle between the two, or the middle of the plane.
    pub eye: DVec3,
    forward: DVec3,
    /// Unit vector.
    right: DVec3,
    /// Unit vector.
    above: DVec3,
    /// Half the width and height of what is seen at distance 1, or at any distance where rays are parallel.
    half: DVec2,
    is_parallel: bool,
    /// Width and height of an eye's picture, pixels.
    pub size: [u32; 2],
    stereo: Option<StereoMode>,
    /// Half the distance between the eyes.
    shift: f64,
    /// Depth at which both pictures agree.
    convergence: f64,
}

/// Through which eye a ray goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Eye {
    Only,
    Left,
    Right,
}

/// What a pixel of the whole picture shows.
pub(super) struct Glance {
    /// The pixel of the eye's own picture.
    pub pixel: [u32; 2],
    pub eye: Eye,
    /// Which channels of the light it contributes.
    pub channels: DVec3,
    /// Whether its weight counts: of two that share a pixel, the first one's.
    pub counts: bool,
}

/// What a view counts its distances in.
pub(super) fn focus(model: &Model) -> (DVec3, f64) {
    if let Some(Focus { center, radius }) = model.focus {
        return (center.as_dvec3(), f64::from(radius));
    }
    model.mesh.bounds().map_or((DVec3::ZERO, 1.0), |(low, high)| {
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        ((low + high) / 2.0, (high - low).length() / 2.0)
    })
}

/// The unit vectors to the right, up, and to the front.
fn axes(up: Up) -> [DVec3; 3] {
    match up {
        Up::Y => [DVec3::X, DVec3::Y, DVec3::Z],
        Up::Z => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
    }
}

/// The unit vector towards a place, from what it circles.
pub(super) fn towards(place: &Place, up: Up) -> DVec3 {
    let [right, above, front] = axes(up);
    let (sin, cos) = f64::from(place.azimuth).to_radians().sin_cos();
    let (height, level) = f64::from(place.elevation).to_radians().sin_cos();
    (right * sin + front * cos) * level + above * height
}

impl Camera {
    /// That of a view, for a picture of `size` pixels in all.
    pub fn new(model: &Model, view: &View, size: [u32; 2]) -> Self {
        let (center, radius) = focus(model);
        let stereo = view.stereo.map(|stereo| stereo.mode);
        let size = match stereo {
            Some(StereoMode::SideBySide) => [size[0].div_ceil(2), size[1]],
            _ => size,
        };
        let target = center + view.target.as_dvec3() * radius;
        let distance = f64::from(view.camera.distance) * radius;
        let back = towards(&view.camera, view.up);
        let [right, _, front] = axes(view.up);
        let (sin, cos) = f64::from(view.camera.azimuth).to_radians().sin_cos();
        let right = right * cos - front * sin;
        let slope = (f64::from(view.field_of_view).to_radians() / 2.0).tan();
        let half_height = match (view.projection, view.ortho_height) {
            (Projection::Perspective, _) => slope,
            (Projection::Orthographic, Some(height)) => f64::from(height) * radius / 2.0,
            (Projection::Orthographic, None) => slope * distance,
        };
        let (shift, convergence) = view.stereo.map_or((0.0, distance), |stereo| eyes(&stereo, distance));
        Camera {
            eye: target + back * distance,
            forward: -back,
            right,
            above: back.cross(right),
            half: DVec2::new(half_height * f64::from(size[0]) / f64::from(size[1]), half_height),
            is_parallel: view.projection == Projection::Orthographic,
            size,
            stereo,
            shift,
            convergence,
        }
    }

    /// Width and height of the whole picture.
    pub fn picture_size(&self) -> [u32; 2] {
        let [width, height] = self.size;
        match self.stereo {
            Some(StereoMode::SideBySide) => [2 * width, height],
            Some(StereoMode::Sequential) => [width, 2 * height],
            _ => [width, height],
        }
    }

    /// What a pixel of the whole picture shows, eye by eye; the left one, or the only one, comes first.
    pub fn glances(&self, [x, y]: [u32; 2]) -> Vec<Glance> {
        let [width, height] = self.size;
        let one = |pixel, eye| Glance {
            pixel,
            eye,
            channels: DVec3::ONE,
            counts: true,
        };
        let side = |is_right| if is_right { Eye::Right } else { Eye::Left };
        match self.stereo {
            None => vec![one([x, y], Eye::Only)],
            Some(StereoMode::SideBySide) => vec![one([x % width, y], side(x >= width))],
            Some(StereoMode::Sequential) => vec![one([x, y % height], side(y >= height))],
            Some(StereoMode::Rows) => vec![one([x, y], side(y % 2 == 1))],
            Some(StereoMode::Anaglyph) => vec![
                Glance {
                    channels: DVec3::X,
                    ..one([x, y], Eye::Left)
                },
                Glance {
                    channels: DVec3::Y + DVec3::Z,
                    counts: false,
                    ..one([x, y], Eye::Right)
                },
            ],
        }
    }

    /// Origin and direction of the ray through a point of an eye's picture, in pixels from the upper left corner; the
    /// direction is 1 long along the line of sight.
    pub fn ray(&self, at: DVec2, eye: Eye) -> (DVec3, DVec3) {
        let [width, height] = self.size.map(f64::from);
        let across = (2.0 * at.x / width - 1.0) * self.half.x;
        let upwards = (1.0 - 2.0 * at.y / height) * self.half.y;
        let sideways = self.right * across + self.above * upwards;
        if self.is_parallel {
            return (self.eye + sideways, self.forward);
        }
        let direction = self.forward + sideways;
        let aside = match eye {
            Eye::Only => return (self.eye, direction),
            Eye::Left => self.right * -self.shift,
            Eye::Right => self.right * self.shift,
        };
        (self.eye + aside, direction - aside / self.convergence)
    }
}

/// Half the distance between the eyes, and the depth at which their pictures agree, for a camera that looks at something
/// so far away.
fn eyes(stereo: &Stereo, distance: f64) -> (f64, f64) {
    let convergence = stereo.convergence.map_or(distance, f64::from);
    let apart = stereo.eye_distance.map_or(convergence * EYE_PART, f64::from);
    (apart / 2.0, convergence)
}
