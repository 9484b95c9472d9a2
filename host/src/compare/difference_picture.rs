//! A picture of where two pictures differ.

use super::Shot;
use clap::ValueEnum;
use flip_rs::ErrorMap;

/// What a picture of the difference shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum DifferenceKind {
    /// FLIP in the colours of magma: black where an eye sees no difference, pale yellow where it sees the greatest.
    #[default]
    Flip,
    /// Second minus first colour on grey, eight times as strong: brighter where the second is.
    Signed,
}

/// By how much differences of [`DifferenceKind::Signed`] are made stronger.
const GAIN: f32 = 8.0;

/// Red, green and blue of the picture's pixels, sRGB-encoded. The pictures and the map are those of one comparison.
pub fn difference_picture(kind: DifferenceKind, wanted: &Shot, is: &Shot, map: &ErrorMap) -> Vec<u8> {
    match kind {
        DifferenceKind::Flip => {
            let color = |error: &f32| {
                colorous::MAGMA
                    .eval_continuous(f64::from(error.clamp(0.0, 1.0)))
                    .as_array()
            };
            map.pixels().iter().flat_map(color).collect()
        }
        DifferenceKind::Signed => {
            let channels = wanted.colors().as_flattened().iter().zip(is.colors().as_flattened());
            channels
                .map(|(a, b)| (127.5 + (b - a) * 127.5 * GAIN).round().clamp(0.0, 255.0) as u8)
                .collect()
        }
    }
}
