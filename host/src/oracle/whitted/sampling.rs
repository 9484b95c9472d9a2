//! Where in a pixel samples lie, and how much each counts.

use crate::sampling::{Filter, Pattern};
use glam::DVec2;

/// The root of `x^3 = x + 1`, of whose powers the R2 sequence is made (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018).
const PLASTIC: f64 = 1.324_717_957_244_746;

/// A sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    /// From the upper left corner of the pixel, pixels.
    pub place: DVec2,
    pub weight: f64,
}

/// All samples of a pixel, `side` times `side` of them.
pub(super) fn samples(side: u32, pattern: Pattern, filter: Filter) -> Vec<Sample> {
    let reach = match filter {
        Filter::Box => 0.5,
        Filter::Tent => 1.0,
        Filter::Gaussian => 1.5,
    };
    let sample = |number| {
        let offset = (place(number, side, pattern) - DVec2::splat(0.5)) * (2.0 * reach);
        Sample {
            place: offset + DVec2::splat(0.5),
            weight: weight(filter, offset),
        }
    };
    (0..side * side).map(sample).collect()
}

/// The place of a sample in the unit square.
fn place(number: u32, side: u32, pattern: Pattern) -> DVec2 {
    let count = side * side;
    match pattern {
        Pattern::Regular => {
            let (column, row) = (number % side, number / side);
            (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / f64::from(side)
        }
        // Steps of one column to the right and `side` rows down, on a torus of count + 1 rows, of which the last is left
        // out.
        Pattern::Rotated => {
            let row = (number * side + side - 1) % (count + 1);
            (DVec2::new(f64::from(number), f64::from(row)) + 0.5) / f64::from(count)
        }
        Pattern::R2 => {
            let step = DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC));
            (DVec2::splat(0.5) + step * f64::from(number)).map(f64::fract)
        }
    }
}

/// How much a sample at an offset from the middle of the pixel counts.
fn weight(filter: Filter, offset: DVec2) -> f64 {
    match filter {
        Filter::Box => 1.0,
        Filter::Tent => (1.0 - offset.x.abs()).max(0.0) * (1.0 - offset.y.abs()).max(0.0),
        // Of standard deviation half a pixel.
        Filter::Gaussian => (-0.5 * offset.length_squared() / 0.25).exp(),
    }
}
