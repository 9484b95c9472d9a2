//! How far two pictures are apart.

mod difference_picture;
mod shot;
mod ssim;

pub use difference_picture::{DifferenceKind, difference_picture};
pub use shot::{Shot, ShotFault};

use flip_rs::{DEFAULT_PPD, ErrorMap, FlipError, RgbImage};
use serde::Serialize;
use ssim::mean_similarity;

/// What was measured of two pictures.
///
/// Light is linear RGB as it is in the files; colours are what a screen shows of it, cut off at 0 and 1 and sRGB-encoded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Root of the mean squared difference of light over all pixels and channels.
    pub rmse: f64,
    /// Peak signal-to-noise ratio of the colours, peak 1, decibels; infinite where they are alike (`null` in JSON).
    pub psnr: f64,
    /// Structural similarity of the colours' luma, mean over all windows, 1 where they are alike (Z. Wang, A. Bovik, H.
    /// Sheikh, E. Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE TIP 13(4),
    /// 2004).
    pub ssim: f64,
    /// What an eye sees when the pictures take turns, 0 to 1, for each pixel (P. Andersson et al., "FLIP: a difference
    /// evaluator for alternating images", HPG 2020).
    pub flip: FlipFigures,
    /// Pixels of which a channel's colour differs by more than `step`; with a step of 0, whose light differs at all.
    pub differing: usize,
    /// The step, in parts of 255.
    pub step: f32,
    /// Largest difference of a channel's colour, in parts of 255.
    pub largest: f64,
}

/// A map of FLIP in figures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FlipFigures {
    /// Pixels per degree of vision.
    pub pixels_per_degree: f32,
    /// Mean over the pixels.
    pub mean: f64,
    /// What 99 % of the pixels do not exceed.
    pub percentile_99: f32,
    /// The largest.
    pub largest: f32,
}

/// Why two pictures cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// They do not have the same size.
    #[error(
        "The pictures differ in size, {}x{} and {}x{} pixels; render them in the same size.",
        .0[0], .0[1], .1[0], .1[1]
    )]
    Sizes([u32; 2], [u32; 2]),
    /// FLIP refuses.
    #[error("FLIP cannot be had of these pictures ({0}); compare smaller ones.")]
    Flip(#[from] FlipError),
}

/// How large FLIP's pixels are: its authors' usual screen, 0.7 m wide, 3,840 pixels in a row, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f32 = DEFAULT_PPD;

/// The encodings of equal steps differ by no more than this, in parts of the step: rounding of f32.
const STEP_SLACK: f32 = 1e-4;

/// Compares a picture with the one that it should be; also returns the map of FLIP.
///
/// # Errors
/// [`CompareError`].
pub fn compare(wanted: &Shot, is: &Shot, step: f32) -> Result<(Comparison, ErrorMap), CompareError> {
    if wanted.size() != is.size() {
        return Err(CompareError::Sizes(wanted.size(), is.size()));
    }
    let [width, height] = wanted.size();
    let map = flip_rs::ldr_flip(&flip_image(wanted)?, &flip_image(is)?, PIXELS_PER_DEGREE)?;
    let color_error = mean_square(wanted.colors(), is.colors());
    let mut differing = 0;
    let mut largest = 0.0_f32;
    let light = wanted.light().iter().zip(is.light());
    for ((a, b), (a_light, b_light)) in wanted.colors().iter().zip(is.colors()).zip(light) {
        let difference = (0..3).fold(0.0_f32, |most, channel| most.max((a[channel] - b[channel]).abs())) * 255.0;
        largest = largest.max(difference);
        let differs = if step > 0.0 {
            difference > step * (1.0 + STEP_SLACK)
        } else {
            a_light != b_light
        };
        differing += usize::from(differs);
    }
    let comparison = Comparison {
        width,
        height,
        rmse: mean_square(wanted.light(), is.light()).sqrt(),
        psnr: -10.0 * color_error.log10(),
        ssim: mean_similarity(wanted, is),
        flip: FlipFigures::of(&map),
        differing,
        step,
        largest: f64::from(largest),
    };
    Ok((comparison, map))
}

impl FlipFigures {
    fn of(map: &ErrorMap) -> Self {
        let mut sorted = map.pixels().to_vec();
        sorted.sort_unstable_by(f32::total_cmp);
        let rank = (sorted.len() * 99).div_ceil(100);
        FlipFigures {
            pixels_per_degree: PIXELS_PER_DEGREE,
            mean: sorted.iter().copied().map(f64::from).sum::<f64>() / sorted.len() as f64,
            percentile_99: sorted[rank - 1],
            largest: sorted[sorted.len() - 1],
        }
    }
}

fn flip_image(shot: &Shot) -> Result<RgbImage<f32>, FlipError> {
    let [width, height] = shot.size().map(|side| side as usize);
    RgbImage::new(width, height, shot.colors().as_flattened().to_vec())
}

fn mean_square(a: &[[f32; 3]], b: &[[f32; 3]]) -> f64 {
    let (a, b) = (a.as_flattened(), b.as_flattened());
    let square = |(a, b): (&f32, &f32)| (f64::from(*a) - f64::from(*b)).powi(2);
    a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64
}

#[cfg(test)]
mod tests;
