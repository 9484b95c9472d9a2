//! How a pixel is sampled.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use oktant_shared::sampling::{BOX, GAUSSIAN, R2, REGULAR, ROTATED, TENT};
use serde::Deserialize;

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
    /// Eight by eight.
    SixtyFour,
}

impl Samples {
    /// All of them, fewest first.
    pub const ALL: [Samples; 4] = [Samples::One, Samples::Four, Samples::Sixteen, Samples::SixtyFour];

    /// Along each side of a pixel.
    pub fn per_side(self) -> u32 {
        match self {
            Samples::One => 1,
            Samples::Four => 2,
            Samples::Sixteen => 4,
            Samples::SixtyFour => 8,
        }
    }

    /// In all.
    pub fn count(self) -> u32 {
        self.per_side() * self.per_side()
    }
}

/// Samples of a pixel, the same for all of them or as many as each needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleCount {
    /// So many, or at most so many.
    pub samples: Samples,
    /// Whether each pixel gets only as many as it needs.
    pub adaptive: bool,
}

impl SampleCount {
    /// All of them.
    pub const ALL: [SampleCount; 8] = {
        let mut all = [SampleCount {
            samples: Samples::One,
            adaptive: false,
        }; 8];
        let mut i = 0;
        while i < 8 {
            all[i].samples = Samples::ALL[i % 4];
            all[i].adaptive = i >= 4;
            i += 1;
        }
        all
    };

    /// As people write it: `16`, or `adaptive:16`.
    pub fn name(self) -> &'static str {
        match (self.adaptive, self.samples) {
            (false, Samples::One) => "1",
            (false, Samples::Four) => "4",
            (false, Samples::Sixteen) => "16",
            (false, Samples::SixtyFour) => "64",
            (true, Samples::One) => "adaptive:1",
            (true, Samples::Four) => "adaptive:4",
            (true, Samples::Sixteen) => "adaptive:16",
            (true, Samples::SixtyFour) => "adaptive:64",
        }
    }

    /// The one of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|count| count.name() == name)
    }
}

impl ValueEnum for SampleCount {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

/// Where in a pixel the samples lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pattern {
    /// A grid along the pixel's edges.
    #[default]
    Regular,
    /// A turned grid, in which no two samples share a row or column.
    Rotated,
    /// The R2 sequence.
    R2,
}

impl Pattern {
    /// As the kernel knows it.
    pub fn code(self) -> u32 {
        match self {
            Pattern::Regular => REGULAR,
            Pattern::Rotated => ROTATED,
            Pattern::R2 => R2,
        }
    }
}

/// How much each sample counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// All of the pixel alike.
    #[default]
    Box,
    /// The less the nearer to the middles of the neighbours.
    Tent,
    /// By a Gaussian that reaches a pixel beyond.
    Gaussian,
}

impl Filter {
    /// As the kernel knows it.
    pub fn code(self) -> u32 {
        match self {
            Filter::Box => BOX,
            Filter::Tent => TENT,
            Filter::Gaussian => GAUSSIAN,
        }
    }
}
