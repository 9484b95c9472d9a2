//! How a pixel is sampled.

use clap::ValueEnum;
use oktant_shared::sampling::{BOX, GAUSSIAN, R2, REGULAR, ROTATED, TENT};
use serde::Deserialize;

/// Samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Samples {
    /// One, in the middle.
    #[default]
    #[value(name = "1")]
    One,
    /// Two by two.
    #[value(name = "4")]
    Four,
    /// Four by four.
    #[value(name = "16")]
    Sixteen,
    /// Eight by eight.
    #[value(name = "64")]
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
