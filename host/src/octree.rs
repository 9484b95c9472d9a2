//! The octree: what it consists of, its figures, and the check before it is handed to a kernel that trusts it.

mod build;
mod duplicates;
mod overlap;
mod root;

pub use build::OctreeOptions;
pub use root::{LARGEST_EXTENT, SMALLEST_EXTENT};

use crate::mesh::Mesh;
use crate::progress::Progress;
use glam::Vec3;
use oktant_shared::octree::{MAX_DEPTH, Node, Root};

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

/// Why there is no octree for a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OctreeError {
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

/// A broken rule of the arrays, in words; a bug of whoever made them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("The octree is not valid: {0}. This is a bug; please report it with the mesh.")]
pub struct InvalidOctree(pub String);

/// Figures of an octree.
#[derive(Clone, Debug, PartialEq)]
pub struct OctreeStatistics {
    /// Level of the deepest leaf; the root's is 0.
    pub depth: u32,
    /// Cells with children.
    pub inner: usize,
    /// Cells without children that hold references.
    pub filled: usize,
    /// Cells without children and references.
    pub empty: usize,
    /// References in all.
    pub references: usize,
    /// Leaves by number of references: `histogram[i]` have `2^(i-1) < n <= 2^i`, the first have one.
    pub histogram: Vec<usize>,
    /// References of the fullest leaf.
    pub fullest: u32,
    /// Bytes of nodes and references.
    pub bytes: usize,
}

impl Octree {
    /// Builds the octree of a mesh; the same one for the same mesh, whatever the number of threads.
    ///
    /// # Errors
    /// [`OctreeError`] where the mesh has nothing to build it from.
    pub fn build(mesh: &Mesh, options: &OctreeOptions, progress: Progress<'_>) -> Result<Self, OctreeError> {
        build::build(mesh, options, progress)
    }

    /// An octree without triangles.
    pub fn empty() -> Self {
        Octree {
            root: root::root(Vec3::splat(-1.0), Vec3::ONE, 0).expect("a cube of two units has a root"),
            nodes: vec![Node { first: 0, count: 0 }],
            references: Vec::new(),
            degenerate: 0,
            duplicates: 0,
        }
    }

    /// Checks everything that the traversal relies on without looking: indices in range, every cell reached once,
    /// levels within the traversal's stack.
    ///
    /// # Errors
    /// The first broken rule.
    pub fn validate(&self, triangles: usize) -> Result<(), InvalidOctree> {
        let invalid = |rule: String| Err(InvalidOctree(rule));
        if self.root.depth > MAX_DEPTH {
            return invalid(format!("its depth {} exceeds {MAX_DEPTH}", self.root.depth));
        }
        if self.nodes.is_empty() {
            return invalid("it has no root".into());
        }
        if let Some(id) = self.references.iter().find(|id| **id as usize >= triangles) {
            return invalid(format!("it refers to triangle {id} of {triangles}"));
        }
        let mut levels = vec![None; self.nodes.len()];
        levels[0] = Some(0);
        for (index, node) in self.nodes.iter().enumerate() {
            let Some(level) = levels[index] else {
                return invalid(format!("node {index} has no parent before it"));
            };
            if node.is_inner() {
                let first = node.first as usize;
                if level >= self.root.depth {
                    return invalid(format!("node {index} has children below the smallest cells"));
                }
                if first <= index || first + 8 > self.nodes.len() {
                    return invalid(format!("the children of node {index} are out of range"));
                }
                for child in &mut levels[first..first + 8] {
                    if child.replace(level + 1).is_some() {
                        return invalid(format!("node {index} shares a child"));
                    }
                }
            } else if u64::from(node.first) + u64::from(node.count) > self.references.len() as u64 {
                return invalid(format!("the references of node {index} are out of range"));
            }
        }
        Ok(())
    }
}

impl OctreeStatistics {
    /// Counts what there is in the cells of an octree with so many references.
    pub fn new(nodes: &[Node], references: usize) -> Self {
        let mut statistics = OctreeStatistics {
            depth: 0,
            inner: 0,
            filled: 0,
            empty: 0,
            references,
            histogram: Vec::new(),
            fullest: 0,
            bytes: size_of_val(nodes) + references * size_of::<u32>(),
        };
        let mut levels = vec![0_u32; nodes.len()];
        for (index, node) in nodes.iter().enumerate() {
            statistics.depth = statistics.depth.max(levels[index]);
            if node.is_inner() {
                statistics.inner += 1;
                let level = levels[index] + 1;
                levels[node.first as usize..node.first as usize + 8].fill(level);
            } else if node.count == 0 {
                statistics.empty += 1;
            } else {
                statistics.filled += 1;
                statistics.fullest = statistics.fullest.max(node.count);
                let class = node.count.next_power_of_two().ilog2() as usize;
                if statistics.histogram.len() <= class {
                    statistics.histogram.resize(class + 1, 0);
                }
                statistics.histogram[class] += 1;
            }
        }
        statistics
    }
}
