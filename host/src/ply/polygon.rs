//! Cutting the polygons of a file into triangles.

use crate::polygon::{Cutter, MOST_CORNERS, TooLarge};

use super::face::Faces;
use super::fault::{Fault, Place};
use super::vertex::Positions;

/// A face of more than three corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    /// Index of the first of its triangles among those of its [`Faces`].
    pub(super) first_triangle: usize,
    /// How many corners it has.
    pub(super) corners: usize,
    /// Index of the face in the file.
    pub(super) face: usize,
}

/// Cuts every polygon of `faces`.
pub(super) fn cut(faces: &mut Faces, positions: &Positions) -> Result<(), Fault> {
    let mut cutter = Cutter::default();
    let mut corners = faces.polygon_corners.as_slice();
    for polygon in &faces.polygons {
        let (ring, rest) = corners.split_at(polygon.corners);
        corners = rest;
        let triangles = &mut faces.triangles[polygon.first_triangle..][..polygon.corners - 2];
        cutter
            .cut(ring, |corner| positions.get(corner), triangles)
            .map_err(|TooLarge| Fault::PolygonTooLarge {
                place: Place::Element {
                    element: "face".to_owned(),
                    index: polygon.face,
                    byte: None,
                },
                corners: polygon.corners,
                limit: MOST_CORNERS,
            })?;
    }
    faces.polygons = Vec::new();
    faces.polygon_corners = Vec::new();
    Ok(())
}
