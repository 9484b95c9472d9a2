//! The octree: what it consists of, and its figures.

mod build;
mod duplicates;
mod options;
mod overlap;
mod prune;
mod root;

pub(crate) use duplicates::{distinct, duplicates, has_area};
pub use options::OctreeOptions;
pub(crate) use overlap::overlapped_children;
pub(crate) use root::root;
pub use root::{LARGEST_EXTENT, SMALLEST_EXTENT};

use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Progress;
use glam::Vec3;
use oktant_shared::octree::{Node, Root};

/// An octree over the triangles of a mesh, as flat arrays.
#[derive(Clone, Debug)]
pub struct Octree {
    /// The cube around everything.
    pub root: Root,
    /// The cells, the root first, the children of a cell side by side.
    pub nodes: Vec<Node>,
    /// Ids of triangles, leaf by leaf, ascending in each.
    pub references: Vec<u32>,
    /// Triangles left out because they have no area.
    pub degenerate: u32,
    /// Triangles left out because they lie exactly on one with a lower id.
    pub duplicates: u32,
}

impl Octree {
    /// Builds the octree of a mesh; the same one for the same mesh, whatever the number of threads.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to build it from.
    pub fn build(mesh: &Mesh, options: &OctreeOptions, progress: Progress<'_>) -> Result<Self, BuildError> {
        build::build(mesh, options, progress)
    }

    /// An octree without triangles.
    pub fn empty() -> Self {
        Octree {
            root: root(Vec3::splat(-1.0), Vec3::ONE, 0).expect("a cube of two units has a root"),
            nodes: vec![Node { first: 0, count: 0 }],
            references: Vec::new(),
            degenerate: 0,
            duplicates: 0,
        }
    }
}
