//! Directions in 32 bits.

use crate::arithmetic::max;
use crate::normal::unit_or_zero;
use glam::Vec3;

/// The word of no direction.
pub const NONE: u32 = 0x8000_8000;

/// The largest number of a half of a word; the least is its negative.
const LARGEST: f32 = 32_767.0;

/// The direction of a word, of unit length; zero for [`NONE`].
///
/// Q. Meyer, J. Suessmuth, G. Sussner, M. Stamminger, G. Greiner, "On floating-point normal vectors", EGSR 2010: the sphere
/// is laid on an octahedron, which is unfolded into a square; a word holds the place in it, 16 bits each of x (the lower
/// half) and y. Off by at most 4.7e-5 radians.
#[inline]
pub fn direction(word: u32) -> Vec3 {
    if word == NONE {
        return Vec3::ZERO;
    }
    let x = ((word << 16) as i32 >> 16) as f32 / LARGEST;
    let y = (word as i32 >> 16) as f32 / LARGEST;
    let z = 1.0 - x.abs() - y.abs();
    // What is below lies in the square's corners, turned outwards.
    let beyond = max(-z, 0.0);
    let toward_zero = |v: f32| if v < 0.0 { v + beyond } else { v - beyond };
    unit_or_zero(Vec3::new(toward_zero(x), toward_zero(y), z))
}

/// The word whose direction is nearest to that of a vector, of the four about its place in the square; [`NONE`] of zero.
#[cfg(not(target_arch = "spirv"))]
pub fn word(vector: Vec3) -> u32 {
    let exact = vector.as_dvec3().normalize_or_zero();
    let size = exact.abs().element_sum();
    if size == 0.0 {
        return NONE;
    }
    let (x, y) = (exact.x / size, exact.y / size);
    let (x, y) = if exact.z < 0.0 {
        ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y))
    } else {
        (x, y)
    };
    let largest = f64::from(LARGEST);
    let (x, y) = ((x * largest).floor(), (y * largest).floor());
    let half = |at: f64| u32::from((at.min(largest) as i16) as u16);
    let mut best = (f64::INFINITY, NONE);
    for (along_x, along_y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let word = half(x + along_x) | half(y + along_y) << 16;
        let off = (direction(word).as_dvec3() - exact).length_squared();
        if off < best.0 {
            best = (off, word);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oracle: the direction that was given, in f64.
    #[test]
    fn directions_return_within_the_stated_error() {
        let mut worst = 0.0_f64;
        let mut state = 1_u64;
        let mut random = || {
            // SplitMix64: this crate has no generator of random numbers.
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (z ^ (z >> 31)) as u32 as f32 / u32::MAX as f32 - 0.5
        };
        for _ in 0..1_000_000 {
            let given = Vec3::new(random(), random(), random());
            if given.length_squared() > 0.25 || given.length_squared() < 1e-3 {
                continue;
            }
            let packed = direction(word(given));
            assert!((packed.length() - 1.0).abs() < 1e-6, "{given}");
            let (a, b) = (packed.as_dvec3().normalize(), given.as_dvec3().normalize());
            worst = worst.max((a - b).length());
        }
        assert!((3e-5..4.7e-5).contains(&worst), "{worst}");
    }

    #[test]
    fn axes_diagonals_and_nothing_are_exact() {
        for x in [-1.0, 0.0, 1.0] {
            for y in [-1.0, 0.0, 1.0] {
                for z in [-1.0, 0.0, 1.0] {
                    let given = Vec3::new(x, y, z);
                    let packed = direction(word(given));
                    let off = (packed - given.normalize_or_zero()).length();
                    let bound = if given.abs().element_sum() < 2.0 { 0.0 } else { 4.7e-5 };
                    assert!(off <= bound, "{given}: {packed}");
                }
            }
        }
    }
}
