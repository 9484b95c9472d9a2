//! Numbers of pixels, summed up.

use rayon::prelude::*;
use serde::Serialize;

/// How the numbers of a picture's pixels are spread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// Pixels that have a number.
    pub pixels: usize,
    /// The smallest.
    pub least: f64,
    /// As many are above as below; of an even number of them the upper one of the middle.
    pub median: f64,
    /// Their sum divided by their number.
    pub mean: f64,
    /// At least 99 of 100 are not greater.
    pub percentile_99: f64,
    /// The largest.
    pub greatest: f64,
}

impl Figures {
    /// Of all numbers that are some; none where there are none.
    pub fn new(numbers: &[f32]) -> Option<Self> {
        let mut sorted: Vec<f32> = numbers.par_iter().copied().filter(|number| !number.is_nan()).collect();
        sorted.par_sort_unstable_by(f32::total_cmp);
        let pixels = sorted.len();
        let of_hundred = (pixels * 99).div_ceil(100);
        Some(Figures {
            pixels,
            least: f64::from(*sorted.first()?),
            median: f64::from(sorted[pixels / 2]),
            mean: sorted.iter().copied().map(f64::from).sum::<f64>() / pixels as f64,
            percentile_99: f64::from(sorted[of_hundred.max(1) - 1]),
            greatest: f64::from(*sorted.last()?),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_summed_up_and_holes_left_out() {
        let mut numbers: Vec<f32> = (1..=200).rev().map(|i| i as f32).collect();
        numbers.insert(7, f32::NAN);
        let figures = Figures::new(&numbers).unwrap();
        let wanted = Figures {
            pixels: 200,
            least: 1.0,
            median: 101.0,
            mean: 100.5,
            percentile_99: 198.0,
            greatest: 200.0,
        };
        assert_eq!(figures, wanted);
        let one = Figures::new(&[4.0]).unwrap();
        assert_eq!(
            (one.least, one.median, one.percentile_99, one.greatest),
            (4.0, 4.0, 4.0, 4.0)
        );
        assert_eq!(Figures::new(&[f32::NAN]), None);
    }
}
