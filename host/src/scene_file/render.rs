//! How the picture is made.

use super::fault::{Fault, Reason};
use super::number::{Depth, Pixels, Steps, Stops, Tolerance};
use super::place::Place;
use crate::picture::{DEFAULT_SIZE, LARGEST_PICTURE, LARGEST_SIDE};
use crate::sampling::{Filter, Pattern, SampleCount};
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
    /// Samples of a pixel: 1, 4, 16 or 64, or for example "adaptive:16". Default: 1.
    pub samples: Option<Count>,
    /// How far a pixel of few samples may be off where they are adaptive, as a part of the output's range. Default: 0.01.
    pub error: Option<Tolerance>,
    /// Edge of the blocks of pixels that may be interpolated where samples are adaptive: 1, 2, 4 or 8. Default: 1.
    pub block: Option<Block>,
    /// Where in a pixel the samples lie: "regular", "rotated" or "r2". Default: "regular".
    pub pattern: Option<Pattern>,
    /// How much each counts: "box", "tent" or "gaussian". Default: "box".
    pub filter: Option<Filter>,
    /// How many times a ray may be reflected or refracted, 0 to 16. Default: 16.
    pub depth: Option<Depth>,
    /// Rays are left out as long as that can change no channel of the output by more than so many steps of 8 bits, 0 to
    /// 255. Default: 0.9.
    pub cutoff: Option<Steps>,
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
        set(&mut view.samples, self.samples.map(|count| count.0.samples));
        set(&mut view.adaptive, self.samples.map(|count| count.0.adaptive));
        set(&mut view.tolerance, self.error.map(|error| error.0));
        set(&mut view.block, self.block.map(|block| block.0));
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
pub struct Count(pub SampleCount);

impl<'de> Deserialize<'de> for Count {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CountVisitor)
    }
}

struct CountVisitor;

impl Visitor<'_> for CountVisitor {
    type Value = Count;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("1, 4, 16 or 64, or such a number after \"adaptive:\"")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Count, E> {
        match SampleCount::from_name(&value.to_string()) {
            Some(count) => Ok(Count(count)),
            None => Err(E::invalid_value(Unexpected::Signed(value), &self)),
        }
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Count, E> {
        match SampleCount::from_name(value).filter(|count| count.adaptive) {
            Some(count) => Ok(Count(count)),
            None => Err(E::invalid_value(Unexpected::Str(value), &self)),
        }
    }
}

/// Edge of a block that there is.
#[derive(Clone, Copy, Debug)]
pub struct Block(pub u32);

impl<'de> Deserialize<'de> for Block {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(BlockVisitor)
    }
}

struct BlockVisitor;

impl Visitor<'_> for BlockVisitor {
    type Value = Block;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("1, 2, 4 or 8")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Block, E> {
        match value {
            1 | 2 | 4 | 8 => Ok(Block(value as u32)),
            _ => Err(E::invalid_value(Unexpected::Signed(value), &self)),
        }
    }
}
