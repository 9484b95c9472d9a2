//! Bringing a mesh near the origin, where f32 is fine enough.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::face::Faces;
use super::fault::{Fault, Place};
use super::vertex::Positions;

/// How many bounding-box diagonals from the origin the centre of an f32 mesh may lie for its vertices to stay as they
/// are: at 16 of them, f32 still resolves a millionth of the diagonal.
const NEAR: f64 = 16.0;

/// What has to be subtracted from every position before it is rounded to f32; there must be triangles.
///
/// Zero for an f32 mesh near the origin. Else the centre of the bounding box of the vertices that `faces` use, each
/// coordinate rounded to a multiple of a power of two between 1/32 and 1/16 of the box's diagonal: then subtracting it
/// is exact in f64 (Sterbenz), and what is subtracted has few digits.
pub(super) fn shift(positions: &Positions, faces: &[Faces]) -> DVec3 {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (min, max) = faces
        .par_iter()
        .map(|faces| {
            let corners = faces.triangles.as_flattened().iter();
            corners
                .chain(&faces.polygon_corners)
                .map(|&corner| positions.get(corner))
                .fold(empty, |(min, max), position| (min.min(position), max.max(position)))
        })
        .reduce(|| empty, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let centre = 0.5 * min + 0.5 * max;
    let diagonal = (max - min).length();
    let is_near = centre.length() <= NEAR * diagonal;
    if is_near && matches!(positions, Positions::Single(_)) {
        return DVec3::ZERO;
    }
    // Without its mantissa, a positive number is the largest power of two that is not above it.
    let step = f64::from_bits(diagonal.to_bits() & f64::INFINITY.to_bits()) / 16.0;
    centre.map(|coordinate| {
        // Adding zero makes -0.0 positive, which subtracting then leaves every -0.0 as it is.
        let rounded = (coordinate / step).round() * step + 0.0;
        // Not so if the box is a point, or so small that a step is lost next to the coordinate.
        if rounded.is_finite() { rounded } else { coordinate }
    })
}

/// The positions less the shift, rounded to f32.
pub(super) fn apply(positions: Positions, shift: DVec3) -> Result<Vec<Vec3>, Fault> {
    let shifted: Vec<Vec3> = match positions {
        Positions::Single(positions) if shift == DVec3::ZERO => return Ok(positions),
        Positions::Single(positions) => positions
            .into_iter()
            .map(|position| (position.as_dvec3() - shift).as_vec3())
            .collect(),
        Positions::Double(positions) => positions
            .into_iter()
            .map(|position| (position - shift).as_vec3())
            .collect(),
    };
    // Only a vertex that no triangle uses can be that far from the others.
    for (index, position) in shifted.iter().enumerate() {
        for (axis, coordinate) in ["x", "y", "z"].into_iter().zip(position.to_array()) {
            if !coordinate.is_finite() {
                let place = Place::Element {
                    element: "vertex".to_owned(),
                    index,
                    byte: None,
                };
                return Err(Fault::OutOfRange { place, axis });
            }
        }
    }
    Ok(shifted)
}
