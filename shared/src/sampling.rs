//! Where in a pixel samples lie, and how much each counts.

use crate::arithmetic::max;
use crate::frame::Frame;
use glam::{Vec2, vec2};
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// [`Frame::pattern`]: a regular grid.
pub const REGULAR: u32 = 0;
/// [`Frame::pattern`]: a grid turned by the arc tangent of one over its side, so that no two samples share a row or
/// column.
pub const ROTATED: u32 = 1;
/// [`Frame::pattern`]: the R2 sequence (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
pub const R2: u32 = 2;

/// [`Frame::filter`]: all samples of the pixel count alike.
pub const BOX: u32 = 0;
/// [`Frame::filter`]: falls linearly to 0 at the middles of the neighbours; samples reach as far.
pub const TENT: u32 = 1;
/// [`Frame::filter`]: a Gaussian of standard deviation half a pixel, cut off at three of them.
pub const GAUSSIAN: u32 = 2;

/// A sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Place from the upper left corner of the pixel, pixels; beyond it for filters that reach so far.
    pub place: Vec2,
    /// How much it counts; 1 in the middle of the pixel.
    pub weight: f32,
}

/// Samples of a pixel that are taken together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch {
    /// Samples of the pixel in all: 1, 4, 16 or 64.
    pub samples: u32,
    /// Along each side of it, if they lie in a regular grid.
    pub per_side: u32,
    /// The first that is taken.
    pub first: u32,
    /// How many are.
    pub count: u32,
}

impl Batch {
    /// Those of a frame.
    #[inline]
    pub fn of_frame(frame: &Frame) -> Self {
        Batch {
            samples: frame.samples,
            per_side: frame.samples_per_side,
            first: frame.first_sample,
            count: frame.sample_count,
        }
    }

    /// All of a pixel with so many along each side.
    #[inline]
    pub const fn whole(per_side: u32) -> Self {
        Batch {
            samples: per_side * per_side,
            per_side,
            first: 0,
            count: per_side * per_side,
        }
    }

    /// Of these, those that are also among a frame's; none where the count is 0.
    #[inline]
    #[must_use]
    pub fn among(self, frame: &Frame) -> Self {
        let end = frame.first_sample + frame.sample_count;
        let end = if end < self.samples { end } else { self.samples };
        let end = if end > frame.first_sample {
            end
        } else {
            frame.first_sample
        };
        Batch {
            first: frame.first_sample,
            count: end - frame.first_sample,
            ..self
        }
    }
}

/// The sample with this number, below [`Batch::samples`].
#[inline]
pub fn sample(frame: &Frame, batch: &Batch, number: u32) -> Sample {
    let even = place(frame.pattern, batch, number);
    let radius = if frame.filter == BOX {
        0.5
    } else if frame.filter == TENT {
        1.0
    } else {
        1.5
    };
    let offset = (even - vec2(0.5, 0.5)) * (2.0 * radius);
    Sample {
        place: offset + vec2(0.5, 0.5),
        weight: weight(frame.filter, offset),
    }
}

/// The place of a sample in the unit square.
#[inline]
fn place(pattern: u32, batch: &Batch, number: u32) -> Vec2 {
    let side = batch.per_side;
    if pattern == ROTATED {
        // The lattice of which a turned grid consists has side^2 + 1 points; one of them is left out.
        let row = ((number + 1) * side - 1) % (side * side + 1);
        return vec2(number as f32 + 0.5, row as f32 + 0.5) / batch.samples as f32;
    }
    if pattern == R2 {
        let at = |step: f32| {
            let x = 0.5 + number as f32 * step;
            x - x.floor()
        };
        return vec2(at(0.754_877_7), at(0.569_840_3));
    }
    vec2((number % side) as f32 + 0.5, (number / side) as f32 + 0.5) / side as f32
}

#[inline]
fn weight(filter: u32, offset: Vec2) -> f32 {
    if filter == BOX {
        1.0
    } else if filter == TENT {
        max(1.0 - offset.x.abs(), 0.0) * max(1.0 - offset.y.abs(), 0.0)
    } else {
        (-2.0 * offset.length_squared()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn frame(pattern: u32, filter: u32) -> Frame {
        Frame {
            pattern,
            filter,
            ..Frame::zeroed()
        }
    }

    #[test]
    fn one_sample_is_in_the_middle() {
        for pattern in [REGULAR, ROTATED, R2] {
            for filter in [BOX, TENT, GAUSSIAN] {
                let sample = sample(&frame(pattern, filter), &Batch::whole(1), 0);
                assert_eq!((sample.place, sample.weight), (vec2(0.5, 0.5), 1.0));
            }
        }
    }

    #[test]
    fn a_turned_grid_fills_every_row_and_column_once() {
        for side in [2, 4, 8] {
            let frame = frame(ROTATED, BOX);
            let mut rows = [false; 64];
            for number in 0..side * side {
                let place = sample(&frame, &Batch::whole(side), number).place * (side * side) as f32;
                assert_eq!(place.x, number as f32 + 0.5);
                rows[place.y as usize] = true;
            }
            assert_eq!(rows.iter().filter(|&&row| row).count(), (side * side) as usize);
        }
        // The four of rotated-grid supersampling.
        let places: [Vec2; 4] =
            core::array::from_fn(|i| sample(&frame(ROTATED, BOX), &Batch::whole(2), i as u32).place * 8.0);
        assert_eq!(places, [vec2(1.0, 3.0), vec2(3.0, 7.0), vec2(5.0, 1.0), vec2(7.0, 5.0)]);
    }

    #[test]
    fn patterns_are_even() {
        for pattern in [REGULAR, ROTATED, R2] {
            for side in [2, 4, 8] {
                let count = side * side;
                let mean: Vec2 = (0..count)
                    .map(|number| sample(&frame(pattern, BOX), &Batch::whole(side), number).place)
                    .sum::<Vec2>()
                    / count as f32;
                let tolerance = if pattern == R2 { 0.6 / side as f32 } else { 1e-6 };
                assert!(mean.abs_diff_eq(vec2(0.5, 0.5), tolerance), "{pattern}, {side}: {mean}");
            }
        }
    }

    #[test]
    fn passes_take_each_sample_once() {
        for (samples, step) in [(4, 1), (16, 3), (16, 16), (64, 13)] {
            let whole = Batch::whole(u32::isqrt(samples));
            let mut next = 0;
            for first_sample in (0..64).step_by(step as usize) {
                let pass = Frame {
                    first_sample,
                    sample_count: step,
                    ..Frame::zeroed()
                };
                let batch = whole.among(&pass);
                if batch.count > 0 {
                    assert_eq!((batch.first, batch.samples), (next, samples));
                    next += batch.count;
                }
            }
            assert_eq!(next, samples);
        }
    }

    #[test]
    fn filters_fall_towards_the_outside() {
        for filter in [TENT, GAUSSIAN] {
            let frame = frame(REGULAR, filter);
            let weights: [f32; 64] = core::array::from_fn(|i| sample(&frame, &Batch::whole(8), i as u32).weight);
            assert!(weights.iter().all(|&weight| (0.0..1.0).contains(&weight)));
            assert!(
                weights[0] < 0.05 && weights[27] > 0.7,
                "{filter}: {} {}",
                weights[0],
                weights[27]
            );
        }
    }
}
