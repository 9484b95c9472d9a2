//! What decides how an octree is split.

use crate::costs::Costs;
use oktant_shared::octree::MAX_DEPTH;

/// What decides how an octree is split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OctreeOptions {
    /// Level beyond which no cell is split, 0 to [`MAX_DEPTH`].
    pub depth: u32,
    /// Cells with at most this many references are not split, and all others are; without it, a cell is split where that
    /// pays by `costs`.
    pub leaf: Option<u32>,
    /// Hard limit of references, as a multiple of the triangles.
    pub budget: u32,
    /// What a ray's work costs.
    pub costs: Costs,
}

impl Default for OctreeOptions {
    fn default() -> Self {
        OctreeOptions {
            depth: MAX_DEPTH,
            leaf: None,
            budget: 16,
            costs: Costs::OCTREE,
        }
    }
}
