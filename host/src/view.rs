//! What the user sets about a picture, and the frame that follows from it.

use crate::media::media_at;
use crate::model::Focus;
use crate::projection::Projection;
use crate::sampling::{Filter, Pattern, Samples};
use crate::scene::Scene;
use crate::stereo::Stereo;
use crate::tone::Tone;
use clap::ValueEnum;
use glam::Vec3;
use oktant_shared::camera::Camera;
use oktant_shared::frame::{FLAT, Frame, PARTS_SHIFT, TRANSPARENT};
use oktant_shared::light::{AREA, DIRECTIONAL, Light};
use oktant_shared::orbit::{Orbit, Up};
use oktant_shared::stereo::MONO;
use oktant_shared::whitted::MAX_DEPTH;
use serde::Deserialize;

/// How surfaces get their normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// Each triangle is flat.
    Flat,
    /// Normals are interpolated between the vertices.
    #[default]
    Phong,
}

/// A point on a sphere around the focus, as people say it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Degrees about the up axis, counterclockwise seen from above; 0 is in front.
    pub azimuth: f32,
    /// Degrees above the horizon, -90 to 90.
    pub elevation: f32,
    /// From the centre of the focus, in its radii.
    pub distance: f32,
}

impl Place {
    /// The place at an offset from the centre of a focus with that radius.
    pub fn at(offset: Vec3, radius: f32, up: Up) -> Self {
        let [right, above, front] = up.axes().map(|axis| axis.dot(offset));
        let level = right.hypot(front);
        Place {
            azimuth: if level == 0.0 {
                0.0
            } else {
                right.atan2(front).to_degrees()
            },
            // People are told of it, for whom there is no -0.
            elevation: above.atan2(level).to_degrees() + 0.0,
            distance: offset.length() / radius,
        }
    }
}

/// Everything about a picture but the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the camera is.
    pub camera: Place,
    /// Where the first light is: a directional one shines from there, the middle of an area light lies there.
    pub light: Place,
    /// What the camera looks at, and circles, as an offset from the centre of the focus in its radii.
    pub target: Vec3,
    /// Whether there is perspective.
    pub projection: Projection,
    /// Vertical field of view, degrees.
    pub field_of_view: f32,
    /// From the lower edge of an orthographic picture to the upper one, in radii of the focus; where it is not said, what a
    /// picture in perspective shows at the distance of what the camera looks at.
    pub ortho_height: Option<f32>,
    /// Which way is up.
    pub up: Up,
    /// How surfaces get their normals.
    pub shading: Shading,
    /// Samples of a pixel.
    pub samples: Samples,
    /// Where they lie.
    pub pattern: Pattern,
    /// How much each counts.
    pub filter: Filter,
    /// Whether each pixel gets only as many samples as it needs, up to [`View::samples`].
    pub adaptive: bool,
    /// How far a pixel of few samples may be off, as a part of the output's range, 0 to 1.
    pub tolerance: f32,
    /// Edge of the blocks of pixels that adaptive sampling may interpolate: 1 (none), 2, 4 or 8.
    pub block: u32,
    /// How many times a ray may be reflected or refracted, at most [`MAX_DEPTH`].
    pub depth: u32,
    /// Rays are not followed as long as all that is left out can change no channel of the output by more than so many steps
    /// of 8 bits; 0: all are.
    pub cutoff: f32,
    /// Whether, and how, there are two eyes.
    pub stereo: Option<Stereo>,
    /// How the light is made to fit the screen.
    pub tone: Tone,
}

/// [`View::tolerance`] where nobody says it: two steps of 8 bits and a half.
pub const TOLERANCE: f32 = 0.01;
/// [`View::cutoff`] where nobody says it: rounded to 8 bits, no channel is seen to be off by more than a step.
pub const CUTOFF: f32 = 0.5;

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
            projection: Projection::Perspective,
            field_of_view: 40.0,
            ortho_height: None,
            up: Up::Y,
            shading: Shading::Phong,
            samples: Samples::One,
            pattern: Pattern::Regular,
            filter: Filter::Box,
            adaptive: false,
            tolerance: TOLERANCE,
            block: 1,
            depth: MAX_DEPTH,
            cutoff: CUTOFF,
            stereo: None,
            tone: Tone::default(),
        }
    }
}

impl View {
    /// Lets the camera look at `center` from a place so far off it, not zero; returns what it then circles: a sphere that
    /// just fits into the picture.
    pub fn look(&mut self, center: Vec3, offset: Vec3) -> Focus {
        self.camera = Place::at(offset, 1.0, self.up);
        self.look_from(center, offset.length())
    }

    /// Keeps the camera's direction, and puts it `distance` from `center`; returns what it then circles.
    pub fn look_from(&mut self, center: Vec3, distance: f32) -> Focus {
        let radius = distance * (self.field_of_view / 2.0).to_radians().sin();
        self.camera.distance = distance / radius;
        Focus { center, radius }
    }

    /// Lets the light that a view moves shine from where `light` does, in a scene with that focus.
    pub fn shine(&mut self, light: &Light, focus: Focus) {
        let offset = match light.kind {
            // As far as other lights are, though nobody sees the difference.
            DIRECTIONAL => light.position * (self.light.distance * focus.radius),
            AREA => light.position + (light.edge_u + light.edge_v) / 2.0 - focus.center,
            _ => light.position - focus.center,
        };
        self.light = Place::at(offset, focus.radius, self.up);
    }

    /// A light, moved to where this view's first one is, in a scene with that focus.
    pub fn lit(&self, light: &Light, focus: Focus) -> Light {
        placed(light, &self.orbit(&self.light, focus.center, focus))
    }

    /// The sphere about a centre on which a place lies.
    fn orbit(&self, place: &Place, center: Vec3, focus: Focus) -> Orbit {
        Orbit {
            center,
            radius: place.distance * focus.radius,
            azimuth: place.azimuth,
            elevation: place.elevation,
            up: self.up,
        }
    }

    /// The frame that takes all samples of a picture of `width` times `height` pixels in one pass. The picture may be
    /// larger: see [`Frame::size`].
    pub fn frame(&self, scene: &Scene, width: u32, height: u32) -> Frame {
        let [width, height] = self
            .stereo
            .map_or([width, height], |stereo| stereo.eye_size([width, height]));
        let focus = scene.focus;
        let target = focus.center + self.target * focus.radius;
        let orbit = self.orbit(&self.camera, target, focus);
        let mut camera = match self.projection {
            Projection::Perspective => Camera::on_orbit(&orbit, self.field_of_view, width, height),
            Projection::Orthographic => {
                Camera::orthographic_on_orbit(&orbit, self.seen_height() * focus.radius, width, height)
            }
        };
        if let Some(stereo) = self.stereo {
            stereo.part_eyes(&mut camera);
        }
        let is_flat = self.shading == Shading::Flat;
        let light = self.lit(&scene.light, focus);
        // An adaptive picture begins with one sample a pixel.
        let samples = if self.adaptive { Samples::One } else { self.samples };
        Frame {
            camera,
            root: scene.root,
            light,
            environment: scene.environment,
            ambient: scene.ambient,
            features: if is_flat { FLAT } else { 0 }
                | if scene.is_transparent() { TRANSPARENT } else { 0 }
                | scene.parts.number() << PARTS_SHIFT,
            samples: samples.count(),
            pattern: self.pattern.code(),
            filter: self.filter.code(),
            samples_per_side: samples.per_side(),
            first_sample: 0,
            sample_count: samples.count(),
            light_count: scene.light_count,
            plane_count: scene.plane_count,
            depth: self.depth,
            cutoff: self.cutoff,
            stereo: self.stereo.map_or(MONO, |stereo| stereo.code()),
            first_row: 0,
            media: media_at(scene, camera.eye).to_eye(),
            brightest: scene.brightest(&light),
            exposure: self.tone.factor(),
            curve: self.tone.curve.code(),
            tolerance: self.tolerance,
            block: self.block,
            most_samples: if self.adaptive { self.samples.count() } else { 0 },
            is_listed: 0,
            first_listed: 0,
            reserved_a: 0,
            reserved_b: 0,
        }
    }
}

/// The light, moved to the orbit's place.
fn placed(light: &Light, orbit: &Orbit) -> Light {
    let position = match light.kind {
        DIRECTIONAL => orbit.direction(),
        AREA => orbit.position() - (light.edge_u + light.edge_v) / 2.0,
        _ => orbit.position(),
    };
    Light { position, ..*light }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn places_are_found_again() {
        for up in [Up::Y, Up::Z] {
            for offset in [
                vec3(1.0, 2.0, 3.0),
                vec3(-4.0, 0.1, -0.2),
                vec3(0.0, -3.0, 0.0),
                vec3(0.0, 0.0, 2.0),
            ] {
                let place = Place::at(offset, 2.5, up);
                let orbit = Orbit {
                    center: Vec3::ZERO,
                    radius: place.distance * 2.5,
                    azimuth: place.azimuth,
                    elevation: place.elevation,
                    up,
                };
                assert!(orbit.position().distance(offset) < 1e-5, "{offset} is at {place:?}");
            }
        }
    }

    #[test]
    fn the_horizon_is_at_zero() {
        for offset in [vec3(0.0, 0.0, -2.0), vec3(-0.0, -0.0, -2.0)] {
            assert_eq!(Place::at(offset, 1.0, Up::Y).elevation.to_string(), "0");
        }
    }
}
