//! Sums of products without any rounding.

use glam::DVec3;

/// An exact sum, kept as f64 numbers whose bits do not overlap, the least first and none of them zero (J. Shewchuk,
/// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete & Computational Geometry
/// 18, 1997).
///
/// It is exact as long as nothing leaves the range of f64. Products of up to four f32 numbers never do: they are multiples
/// of 2^-596, and no larger than 2^512.
#[derive(Clone, Debug, Default)]
pub(super) struct Expansion {
    parts: Vec<f64>,
}

impl Expansion {
    /// Adds a number.
    pub fn add(&mut self, number: f64) {
        let mut sum = number;
        let mut kept = 0;
        for i in 0..self.parts.len() {
            let (rounded, error) = sum_with_error(sum, self.parts[i]);
            sum = rounded;
            if error != 0.0 {
                self.parts[kept] = error;
                kept += 1;
            }
        }
        self.parts.truncate(kept);
        if sum != 0.0 {
            self.parts.push(sum);
        }
    }

    /// Adds the product of two numbers.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(a.mul_add(b, -product));
        self.add(product);
    }

    /// Adds `factor` times the determinant of three vectors. All numbers are f32.
    pub fn add_determinant(&mut self, factor: f64, x: DVec3, y: DVec3, z: DVec3) {
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            // Products of two f32 are exact.
            self.add_product(factor * x[i], y[j] * z[k]);
            self.add_product(factor * x[i], -(y[k] * z[j]));
        }
    }

    /// -1, 0 or 1.
    pub fn sign(&self) -> f64 {
        // The last one is greater than the sum of all others.
        self.parts.last().map_or(0.0, |last| last.signum())
    }

    /// The sum, rounded.
    pub fn rounded(&self) -> f64 {
        self.parts.iter().sum()
    }
}

/// `a + b`, and what its rounding left out (D. Knuth, "The Art of Computer Programming" 2, 4.2.2).
fn sum_with_error(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_rounded() {
        let mut sum = Expansion::default();
        for number in [1e300, 1.0, -1e-300, 1e-200, -1e300, -1.0] {
            sum.add(number);
        }
        assert_eq!(sum.sign(), 1.0);
        sum.add(-1e-200);
        assert_eq!((sum.sign(), sum.rounded()), (-1.0, -1e-300));
        sum.add(1e-300);
        assert_eq!((sum.sign(), sum.rounded()), (0.0, 0.0));
    }

    #[test]
    fn determinants_of_integers_are_those_of_i128() {
        let mut random = integers(7);
        let mut zeros = 0;
        for _ in 0..20_000 {
            let vectors = [(); 3].map(|()| [(); 3].map(|()| random()));
            let factor = random();
            let [x, y, z] = vectors.map(|v: [i128; 3]| DVec3::from_array(v.map(|c| c as f64)));
            let mut sum = Expansion::default();
            sum.add_determinant(factor as f64, x, y, z);
            // Nearly singular: what is left is one determinant less the same with one number off by one.
            let mut off = vectors;
            off[0][0] += 1;
            sum.add_determinant(-(factor as f64), DVec3::from_array(off[0].map(|c| c as f64)), y, z);
            let wanted = factor * (determinant(vectors) - determinant(off));
            assert_eq!(sum.sign(), wanted.signum() as f64, "{vectors:?}");
            assert_eq!(sum.rounded(), wanted as f64);
            zeros += u32::from(wanted == 0);
        }
        assert!(zeros < 100);
    }

    /// Integers of up to 24 bits, which f32 holds.
    fn integers(mut state: u64) -> impl FnMut() -> i128 {
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            i128::from(state >> 40) - (1 << 23)
        }
    }

    fn determinant([x, y, z]: [[i128; 3]; 3]) -> i128 {
        (0..3)
            .map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                x[i] * (y[j] * z[k] - y[k] * z[j])
            })
            .sum()
    }
}
