//! How the picture is taken and shown, under the names of the command line.

use super::value::{choice, named, number, number_in, position};
use crate::projection::Projection;
use crate::sampling::{Filter, Pattern, SampleCount};
use crate::scene_file::{Degrees, Depth, Elevation, FieldOfView, Length, Steps, Stops, Tolerance};
use crate::stereo::StereoMode;
use crate::tone::Curve;
use crate::view::Shading;
use crate::viewer::caption::name;
use crate::viewer::session::DISTANCES;
use glam::Vec3;
use std::ops::RangeInclusive;

/// Ways to share the screen between two eyes, and none.
pub const STEREO: [Option<StereoMode>; 5] = [
    None,
    Some(StereoMode::SideBySide),
    Some(StereoMode::Rows),
    Some(StereoMode::Sequential),
    Some(StereoMode::Anaglyph),
];
/// Edges of the blocks that adaptive sampling may interpolate.
pub const BLOCKS: [u32; 4] = [1, 2, 4, 8];

/// Something about the picture with its new value; units and ranges as in [`crate::view::View`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PictureAdjustment {
    /// Samples of a pixel, or at most so many.
    Samples(SampleCount),
    /// How far a pixel of few samples may be off.
    Error(f32),
    /// Edge of blocks that may be interpolated.
    Block(u32),
    /// Where in a pixel the samples lie.
    Pattern(Pattern),
    /// How much each counts.
    Filter(Filter),
    /// How surfaces get their normals.
    Shading(Shading),
    /// How many times a ray may be reflected or refracted.
    Depth(u32),
    /// Steps of 8 bits that may be left out.
    Cutoff(f32),
    /// Where the camera stands: degrees about the up axis.
    Azimuth(f32),
    /// Its height, degrees.
    Elevation(f32),
    /// Its distance, radii.
    Distance(f32),
    /// What it looks at, an offset in radii.
    Target(Vec3),
    /// Whether there is perspective.
    Projection(Projection),
    /// Vertical field of view, degrees.
    FieldOfView(f32),
    /// What an orthographic picture shows from its lower edge to the upper one, radii.
    OrthoHeight(f32),
    /// Where the first light stands: degrees about the up axis.
    LightAzimuth(f32),
    /// Its height, degrees.
    LightElevation(f32),
    /// Its distance, radii.
    LightDistance(f32),
    /// How two eyes share the screen, if there are two.
    Stereo(Option<StereoMode>),
    /// Between the eyes, scene units.
    EyeDistance(f32),
    /// The depth that appears on the screen itself, scene units.
    Convergence(f32),
    /// Brightness, stops.
    Exposure(f32),
    /// The tone curve.
    Tone(Curve),
}

impl PictureAdjustment {
    /// The names, as on the command line.
    pub const NAMES: [&str; 23] = [
        "samples",
        "error",
        "block",
        "pattern",
        "filter",
        "shading",
        "depth",
        "cutoff",
        "azimuth",
        "elevation",
        "distance",
        "target",
        "projection",
        "fov",
        "ortho-height",
        "light-azimuth",
        "light-elevation",
        "light-distance",
        "stereo",
        "eye-distance",
        "convergence",
        "exposure",
        "tone",
    ];

    /// What one of the names and a value mean.
    pub fn parse(name: &str, value: &str) -> Result<Self, String> {
        let distance = || number_in(value, &radii(), "radii");
        Ok(match name {
            "samples" => Self::Samples(choice(value, "number of samples")?),
            "error" => Self::Error(number::<Tolerance>(value)?.0),
            "block" => Self::Block(named(value, "edge of a block", &BLOCKS, |edge| edge.to_string())?),
            "pattern" => Self::Pattern(choice(value, "pattern")?),
            "filter" => Self::Filter(choice(value, "filter")?),
            "shading" => Self::Shading(choice(value, "shading")?),
            "depth" => Self::Depth(number::<Depth>(value)?.0),
            "cutoff" => Self::Cutoff(number::<Steps>(value)?.0),
            "azimuth" => Self::Azimuth(number::<Degrees>(value)?.0 as f32),
            "elevation" => Self::Elevation(number::<Elevation>(value)?.0),
            "distance" => Self::Distance(distance()?),
            "target" => Self::Target(position(value)?),
            "projection" => Self::Projection(choice(value, "projection")?),
            "ortho-height" => Self::OrthoHeight(distance()?),
            "fov" => Self::FieldOfView(number::<FieldOfView>(value)?.0),
            "light-azimuth" => Self::LightAzimuth(number::<Degrees>(value)?.0 as f32),
            "light-elevation" => Self::LightElevation(number::<Elevation>(value)?.0),
            "light-distance" => Self::LightDistance(distance()?),
            "stereo" => Self::Stereo(named(value, "kind of picture for two eyes", &STEREO, stereo_name)?),
            "eye-distance" => Self::EyeDistance(number::<Length>(value)?.0),
            "convergence" => Self::Convergence(number::<Length>(value)?.0),
            "exposure" => Self::Exposure(number::<Stops>(value)?.0),
            "tone" => Self::Tone(choice(value, "tone curve")?),
            _ => return Err(crate::viewer::grammar::unknown(name, "setting", &Self::NAMES)),
        })
    }
}

/// What the command line calls a way to share the screen, or none.
pub fn stereo_name(mode: Option<StereoMode>) -> String {
    mode.map_or_else(|| "none".into(), |mode| name(&mode))
}

/// How far camera and light may be, radii of what is looked at.
fn radii() -> RangeInclusive<f32> {
    DISTANCES[0]..=DISTANCES[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_takes_a_value_and_refuses_others() {
        for name in PictureAdjustment::NAMES {
            for bad in ["", "?", "1e30"] {
                let error = PictureAdjustment::parse(name, bad).unwrap_err();
                assert!(!error.contains("setting"), "{name} {bad}: {error}");
            }
        }
        for (name, value, wanted) in [
            ("error", "0.02", PictureAdjustment::Error(0.02)),
            ("block", "4", PictureAdjustment::Block(4)),
            ("target", "1,0,-2", PictureAdjustment::Target(Vec3::new(1.0, 0.0, -2.0))),
            (
                "projection",
                "orthographic",
                PictureAdjustment::Projection(Projection::Orthographic),
            ),
            ("ortho-height", "2.5", PictureAdjustment::OrthoHeight(2.5)),
            ("azimuth", "-30", PictureAdjustment::Azimuth(-30.0)),
            ("light-distance", "3", PictureAdjustment::LightDistance(3.0)),
            ("stereo", "none", PictureAdjustment::Stereo(None)),
            ("stereo", "rows", PictureAdjustment::Stereo(Some(StereoMode::Rows))),
            ("tone", "reinhard", PictureAdjustment::Tone(Curve::Reinhard)),
        ] {
            assert_eq!(PictureAdjustment::parse(name, value), Ok(wanted));
        }
    }
}
