//! Bringing what lies far away near the origin, where f32 is fine enough.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// How many bounding-box diagonals from the origin the centre of a mesh may lie for its vertices to stay as they are: at 16
/// of them, f32 still resolves a millionth of the diagonal.
const NEAR: f64 = 16.0;

/// Whether vertices within a box may stay where they are.
pub(crate) fn is_near(low: DVec3, high: DVec3) -> bool {
    (0.5 * low + 0.5 * high).length() <= NEAR * (high - low).length()
}

/// What has to be subtracted from every position within a box before it is rounded to f32: the centre of the box, each
/// coordinate rounded to a multiple of a power of two between 1/32 and 1/16 of the box's diagonal. Then subtracting it is
/// exact in f64 (Sterbenz), and what is subtracted has few digits.
pub(crate) fn centring(low: DVec3, high: DVec3) -> DVec3 {
    let diagonal = (high - low).length();
    // Without its mantissa, a positive number is the largest power of two that is not above it.
    let step = f64::from_bits(diagonal.to_bits() & f64::INFINITY.to_bits()) / 16.0;
    (0.5 * low + 0.5 * high).map(|coordinate| {
        // Adding zero makes -0.0 positive, which subtracting then leaves every -0.0 as it is.
        let rounded = (coordinate / step).round() * step + 0.0;
        // Not so if the box is a point, or so small that a step is lost next to the coordinate.
        if rounded.is_finite() { rounded } else { coordinate }
    })
}

/// Rounds positions to f32, less what brings the box of those that triangles use near the origin; that is zero where it is
/// near already. Returns them with what was subtracted.
///
/// # Errors
/// The index of a position that is not finite then: of one that is not, or of one that no triangle uses and that is too
/// far from the others.
pub(crate) fn settle(positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<(Vec<Vec3>, DVec3), usize> {
    let nothing = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = triangles
        .as_flattened()
        .par_iter()
        .fold(nothing, |(low, high), corner| {
            let position = positions[*corner as usize];
            (low.min(position), high.max(position))
        })
        .reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let shift = if triangles.is_empty() || is_near(low, high) {
        DVec3::ZERO
    } else {
        centring(low, high)
    };
    let settled: Vec<Vec3> = positions
        .par_iter()
        .map(|position| (*position - shift).as_vec3())
        .collect();
    match settled.iter().position(|position| !position.is_finite()) {
        Some(index) => Err(index),
        None => Ok((settled, shift)),
    }
}
