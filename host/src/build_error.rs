//! Why no structure can be built.

use crate::octree::{LARGEST_EXTENT, SMALLEST_EXTENT};

/// Why there is no structure over a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// Nothing to see.
    #[error("The mesh has no triangle with an area; give one that has.")]
    NoArea,
    /// Beyond what single precision can compute with.
    #[error(
        "The mesh is {0:e} units wide; scale it to between {SMALLEST_EXTENT:e} and {LARGEST_EXTENT:e}, where single \
         precision can tell its triangles apart."
    )]
    Extent(f32),
}
