//! Comparing what two back ends make of the same frame.

use oktant::picture::Picture;
use oktant::tone::Tone;
use oktant_shared::hit::Hit;
use std::fmt;

/// Tolerances between two back ends, stated once. Drivers may contract `a * b + c`, divide within 2.5 units in the last
/// place and have their own `pow`, so nothing is bitwise equal.
pub struct Tolerance;

impl Tolerance {
    /// Pixels that may see another triangle, of all: rays that pass an edge within rounding.
    pub const OTHER_TRIANGLE: f64 = 1e-4;
    /// How far `t` may differ where the triangle agrees, relative.
    pub const T: f32 = 1e-5;
    /// Pixels whose `t` may differ by more, of all: rays that graze a triangle.
    pub const OTHER_T: f64 = 1e-5;
    /// How far a channel of a pixel may differ, of 255.
    pub const CHANNEL: u8 = 1;
    /// Pixels that may differ by more, of all: edges, and shadow edges above all.
    pub const OTHER_COLOR: f64 = 1e-3;
}

/// Pixel by pixel, in what two arrays of hits differ.
#[derive(Clone, Debug, Default)]
pub struct HitDifferences {
    /// Pixels compared.
    pub pixels: usize,
    /// Pixels that hit another triangle, or only one of which hits: index, first and second hit.
    pub other_triangle: Vec<(usize, Hit, Hit)>,
    /// Pixels that hit the same triangle at another `t`.
    pub other_t: Vec<(usize, Hit, Hit)>,
}

impl HitDifferences {
    /// Compares hits pixel by pixel.
    pub fn new(first: &[Hit], second: &[Hit]) -> Self {
        assert_eq!(first.len(), second.len(), "the same frame has the same pixels");
        let mut differences = HitDifferences {
            pixels: first.len(),
            ..HitDifferences::default()
        };
        for (index, (a, b)) in first.iter().zip(second).enumerate() {
            if a.triangle != b.triangle {
                differences.other_triangle.push((index, *a, *b));
            } else if a.is_hit() && !same_t(a.t, b.t) {
                differences.other_t.push((index, *a, *b));
            }
        }
        differences
    }

    /// Whether the differences are few enough.
    pub fn agree(&self) -> bool {
        let pixels = self.pixels as f64;
        self.other_triangle.len() as f64 <= Tolerance::OTHER_TRIANGLE * pixels
            && self.other_t.len() as f64 <= Tolerance::OTHER_T * pixels
    }
}

/// Whether two `t` agree; not a number agrees with nothing.
fn same_t(a: f32, b: f32) -> bool {
    (a - b).abs() <= Tolerance::T * b.abs()
}

impl fmt::Display for HitDifferences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} pixels hit another triangle, {} at another t",
            self.other_triangle.len(),
            self.pixels,
            self.other_t.len()
        )?;
        for (kind, list) in [("triangle", &self.other_triangle), ("t", &self.other_t)] {
            for (index, a, b) in list.iter().take(20) {
                write!(
                    f,
                    "\n  other {kind} at pixel {index}: {} at {:?} and {} at {:?}",
                    a.triangle, a.t, b.triangle, b.t
                )?;
            }
        }
        Ok(())
    }
}

/// Pixel by pixel, in what two pictures differ.
#[derive(Clone, Debug, Default)]
pub struct ColorDifferences {
    /// Pixels compared.
    pub pixels: usize,
    /// Pixels of which a channel differs by more than the tolerance.
    pub off: usize,
    /// The largest difference of a channel, of 255.
    pub largest: u8,
    /// Pixels that one of them never wrote.
    pub unwritten: usize,
}

impl ColorDifferences {
    /// Compares two pictures of the same size, sRGB-encoded in 8 bits.
    pub fn new(first: &Picture, second: &Picture) -> Self {
        assert_eq!(
            (first.width, first.height),
            (second.width, second.height),
            "the same frame has the same pixels"
        );
        let unwritten = |picture: &Picture| picture.sums.iter().filter(|sum| sum.w == 0.0).count();
        let mut differences = ColorDifferences {
            pixels: first.sums.len(),
            unwritten: unwritten(first) + unwritten(second),
            ..ColorDifferences::default()
        };
        let tone = Tone::default();
        for (a, b) in first.to_rgb8(&tone).chunks(3).zip(second.to_rgb8(&tone).chunks(3)) {
            let difference = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            differences.largest = differences.largest.max(difference);
            differences.off += usize::from(difference > Tolerance::CHANNEL);
        }
        differences
    }

    /// Whether the differences are few enough.
    pub fn agree(&self) -> bool {
        self.unwritten == 0 && self.off as f64 <= Tolerance::OTHER_COLOR * self.pixels as f64
    }
}

impl fmt::Display for ColorDifferences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} pixels differ by more than {} of 255 (at most by {}), {} unwritten",
            self.off,
            self.pixels,
            Tolerance::CHANNEL,
            self.largest,
            self.unwritten
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec4;

    fn hits() -> Vec<Hit> {
        (0..100_000)
            .map(|i| Hit {
                t: 1.0 + i as f32,
                triangle: i,
                u: 0.0,
                v: 0.0,
            })
            .collect()
    }

    #[test]
    fn equal_hits_agree_and_others_do_not() {
        let (first, mut second) = (hits(), hits());
        assert!(HitDifferences::new(&first, &second).agree());
        for hit in &mut second[..10] {
            hit.triangle += 1;
        }
        assert!(HitDifferences::new(&first, &second).agree(), "1 in 10^4 may differ");
        second[10] = Hit::miss(f32::MAX);
        assert!(!HitDifferences::new(&first, &second).agree(), "no more may");

        let mut second = hits();
        second[5].t *= 1.00002;
        assert!(HitDifferences::new(&first, &second).agree());
        second[6].t = f32::NAN;
        assert!(!HitDifferences::new(&first, &second).agree());
    }

    #[test]
    fn equal_pictures_agree_and_others_do_not() {
        let first = Picture::of_sums(1000, 1, vec![Vec4::new(0.2, 0.2, 0.2, 1.0); 1000]);
        let mut second = first.clone();
        assert!(ColorDifferences::new(&first, &second).agree());
        second.sums[0].x = 0.5;
        assert!(ColorDifferences::new(&first, &second).agree(), "1 in 10^3 may differ");
        second.sums[1].z = 0.3;
        assert!(!ColorDifferences::new(&first, &second).agree(), "no more may");
        let mut second = first.clone();
        second.sums[0] = Vec4::ZERO;
        assert!(!ColorDifferences::new(&first, &second).agree(), "unwritten pixels show");
    }
}
