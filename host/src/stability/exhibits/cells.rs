//! Which triangles belong to a cell, for exhibits that build their own cells.

use crate::mesh::Mesh;
use glam::Vec3;

/// What of its faces belongs to a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// All.
    Closed,
    /// The low ones, as in the thesis.
    HalfOpen,
}

/// Corners of a triangle's box.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Smallest coordinates.
    pub low: Vec3,
    /// Largest coordinates.
    pub high: Vec3,
}

impl Extent {
    /// The boxes of all triangles of a mesh.
    pub fn of_triangles(mesh: &Mesh) -> Vec<Self> {
        let extent = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
            Extent {
                low: a.min(b).min(c),
                high: a.max(b).max(c),
            }
        };
        mesh.triangles.iter().map(extent).collect()
    }

    /// The box round several; that of none is inside out.
    pub fn of_all(extents: &[Extent]) -> Self {
        extents.iter().fold(
            Extent {
                low: Vec3::INFINITY,
                high: Vec3::NEG_INFINITY,
            },
            |all, one| Extent {
                low: all.low.min(one.low),
                high: all.high.max(one.high),
            },
        )
    }

    /// Whether a triangle's box has a part in the cell from `low` to `high`.
    pub fn overlaps(&self, faces: Faces, low: Vec3, high: Vec3) -> bool {
        let below = match faces {
            Faces::Closed => self.low.cmple(high).all(),
            Faces::HalfOpen => self.low.cmplt(high).all(),
        };
        below && self.high.cmpge(low).all()
    }
}
