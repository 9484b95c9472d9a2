//! Structural similarity.

use super::shot::Shot;
use rayon::prelude::*;

/// Pixels of the window to either side of its middle.
const REACH: usize = 5;
/// Standard deviation of the window's weights, pixels.
const SIGMA: f64 = 1.5;
/// The paper's constants, of colours from 0 to 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;
/// Luma of sRGB-encoded colours (Rec. 709).
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// The mean over all windows of 11 x 11 pixels that lie in the pictures, whose weights are Gaussian. Where a picture is
/// narrower, there is one window about its middle.
pub fn mean_similarity(a: &Shot, b: &Shot) -> f64 {
    let [width, height] = a.size().map(|side| side as usize);
    let (a, b) = (luma(a), luma(b));
    // Means of both, of both squared, and of their product.
    let moments: Vec<[f64; 5]> = a.iter().zip(&b).map(|(&a, &b)| [a, b, a * a, b * b, a * b]).collect();
    let columns = Windows::new(width);
    let rows = Windows::new(height);
    // Windows are products: along the rows first.
    let along_rows: Vec<Vec<[f64; 5]>> = moments
        .par_chunks_exact(width)
        .map(|row| columns.middles().map(|x| columns.mean(x, |at| row[at])).collect())
        .collect();
    let sums: Vec<f64> = rows
        .middles()
        .into_par_iter()
        .map(|y| {
            let row = 0..along_rows[0].len();
            row.map(|x| similarity(rows.mean(y, |at| along_rows[at][x]))).sum()
        })
        .collect();
    sums.iter().sum::<f64>() / (sums.len() * along_rows[0].len()) as f64
}

fn luma(shot: &Shot) -> Vec<f64> {
    let luma = |color: &[f32; 3]| (0..3).map(|channel| LUMA[channel] * f64::from(color[channel])).sum();
    shot.colors().iter().map(luma).collect()
}

/// Of the weighted means of `a`, `b`, `a^2`, `b^2` and `a b`.
fn similarity([a, b, aa, bb, ab]: [f64; 5]) -> f64 {
    let (variance_a, variance_b, covariance) = (aa - a * a, bb - b * b, ab - a * b);
    (2.0 * a * b + C1) * (2.0 * covariance + C2) / ((a * a + b * b + C1) * (variance_a + variance_b + C2))
}

/// The windows along one axis.
struct Windows {
    /// Pixels along the axis.
    length: usize,
    weights: [f64; 2 * REACH + 1],
}

impl Windows {
    fn new(length: usize) -> Self {
        Windows {
            length,
            weights: std::array::from_fn(|i| (-0.5 * ((i as f64 - REACH as f64) / SIGMA).powi(2)).exp()),
        }
    }

    /// Where windows have their middles.
    fn middles(&self) -> std::ops::Range<usize> {
        if self.length > 2 * REACH {
            REACH..self.length - REACH
        } else {
            self.length / 2..self.length / 2 + 1
        }
    }

    /// The weighted mean about a middle of what there is at each pixel.
    fn mean(&self, middle: usize, at: impl Fn(usize) -> [f64; 5]) -> [f64; 5] {
        let mut sum = [0.0; 5];
        let mut weights = 0.0;
        for (i, weight) in self.weights.into_iter().enumerate() {
            let Some(pixel) = (middle + i).checked_sub(REACH).filter(|pixel| *pixel < self.length) else {
                continue;
            };
            weights += weight;
            for (sum, value) in sum.iter_mut().zip(at(pixel)) {
                *sum += weight * value;
            }
        }
        sum.map(|sum| sum / weights)
    }
}
