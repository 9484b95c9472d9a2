//! How the picture is made.

use super::fault::{Fault, Reason};
use super::number::{Depth, Part, Pixels, Stops};
use super::place::Place;
use crate::picture::{DEFAULT_SIZE, LARGEST_PICTURE, LARGEST_SIDE};
use crate::sampling::{Filter, Pattern, Samples};
use crate::stereo::StereoMode;
use crate::tone::Curve;
use crate::view::{Shading, View};
use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;

const _: () = assert!(LARGEST_SIDE == 32_768, "the range of Pixels has to follow");

/// `[render]`: size and quality of the picture. What is given on the command line takes precedence.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Render {
    /// Width of the picture, pixels. Default: 1280.
    pub width: Option<Pixels>,
    /// Height of the picture, pixels. Default: 968.
    pub height: Option<Pixels>,
    /// Samples of a pixel: 1, 4, 16 or 64. Default: 1.
    pub samples: Option<SampleCount>,
    /// Where in a pixel the samples lie: "regular", "rotated" or "r2". Default: "regular".
    pub pattern: Option<Pattern>,
    /// How much each counts: "box", "tent" or "gaussian". Default: "box".
    pub filter: Option<Filter>,
    /// How many times a ray may be reflected or refracted, 0 to 16. Default: 5.
    pub depth: Option<Depth>,
    /// Rays that can change no colour by more than this part of their light are left out, 0 to 1. Default: 1/512.
    pub cutoff: Option<Part>,
    /// Normals: of the triangle ("flat"), or as the material says ("phong"). Default: "phong".
    pub shading: Option<Shading>,
    /// Brightness in stops, each of which doubles the light, -30 to 30. Default: 0.
    pub exposure: Option<Stops>,
    /// Curve that makes bright light fit the screen: "none", "reinhard" or "aces". Default: "none".
    pub tone: Option<Curve>,
}

impl Render {
    /// Width and height in pixels, where the file says at least one of them.
    pub fn size(&self) -> Option<[u32; 2]> {
        if self.width.is_none() && self.height.is_none() {
            return None;
        }
        Some([
            self.width.map_or(DEFAULT_SIZE[0], |width| width.0),
            self.height.map_or(DEFAULT_SIZE[1], |height| height.0),
        ])
    }

    /// Changes what the file says about the view.
    pub fn apply(&self, view: &mut View) -> Result<(), Fault> {
        if let Some([width, height]) = self.size()
            && u64::from(width) * u64::from(height) > LARGEST_PICTURE
        {
            let key = if self.width.is_some() { "width" } else { "height" };
            return Err(Fault::new(
                &Place::of("render").key(key),
                Reason::TooManyPixels(LARGEST_PICTURE),
            ));
        }
        fn set<T: Copy>(value: &mut T, given: Option<T>) {
            *value = given.unwrap_or(*value);
        }
        set(&mut view.samples, self.samples.map(|samples| samples.0));
        set(&mut view.pattern, self.pattern);
        set(&mut view.filter, self.filter);
        set(&mut view.depth, self.depth.map(|depth| depth.0));
        set(&mut view.cutoff, self.cutoff.map(|cutoff| cutoff.0));
        set(&mut view.shading, self.shading);
        set(&mut view.tone.exposure, self.exposure.map(|exposure| exposure.0));
        set(&mut view.tone.curve, self.tone);
        Ok(())
    }

    /// Makes sure that a picture for two eyes beside each other has a middle.
    pub fn check_halves(&self, view: &View) -> Result<(), Fault> {
        let is_halved = view.stereo.is_some_and(|stereo| stereo.mode == StereoMode::SideBySide);
        match &self.width {
            Some(Pixels(width)) if is_halved && width % 2 == 1 => {
                Err(Fault::new(&Place::of("render").key("width"), Reason::OddWidth(*width)))
            }
            _ => Ok(()),
        }
    }
}

/// A number of samples that there is.
#[derive(Clone, Copy, Debug)]
pub struct SampleCount(pub Samples);

impl<'de> Deserialize<'de> for SampleCount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SampleCountVisitor)
    }
}

struct SampleCountVisitor;

impl Visitor<'_> for SampleCountVisitor {
    type Value = SampleCount;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("1, 4, 16 or 64")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<SampleCount, E> {
        let found = Samples::ALL
            .into_iter()
            .find(|samples| i64::from(samples.count()) == value);
        match found {
            Some(samples) => Ok(SampleCount(samples)),
            None => Err(E::invalid_value(Unexpected::Signed(value), &self)),
        }
    }
}
