//! Bringing a mesh near the origin, where f32 is fine enough.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::shift::{centring, is_near};

use super::face::Faces;
use super::fault::{Fault, Place};
use super::vertex::Positions;

/// What has to be subtracted from every position before it is rounded to f32; there must be triangles.
///
/// Zero for an f32 mesh near the origin, else what brings the bounding box of the vertices that `faces` use there.
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
    if is_near(min, max) && matches!(positions, Positions::Single(_)) {
        return DVec3::ZERO;
    }
    centring(min, max)
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
