//! The octree as flat arrays.

use crate::aabb::Aabb;
use crate::arithmetic::max_component;
use crate::buffer::load;
use bytemuck::{Pod, Zeroable};
use glam::{UVec4, Vec3};

/// Deepest level a leaf may have; the root's is 0. The traversal's stack has one entry for each level above the leaves,
/// and the planes of cells this deep are still exact in f32 (see [`Root`]).
pub const MAX_DEPTH: u32 = 13;

/// [`Node::count`] of an inner node.
pub const INNER: u32 = u32::MAX;

/// A cell of the octree.
///
/// An inner node has eight children side by side; child `x + 2 y + 4 z` is the upper half along each axis whose bit is
/// 1. Cells have no boxes of their own: a cell is where the path from the root leads.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Node {
    /// Inner node: index of the first child. Leaf: index of the first reference.
    pub first: u32,
    /// Inner node: [`INNER`]. Leaf: number of references, 0 where the cell is empty.
    pub count: u32,
}

const _: () = assert!(size_of::<Node>() == 8);

impl Node {
    /// The node at `index` of those that lie two by two in the words of a structure.
    #[inline]
    pub fn at(nodes: &[UVec4], index: u32) -> Self {
        let words = load(nodes, index >> 1);
        if index & 1 == 0 {
            Node {
                first: words.x,
                count: words.y,
            }
        } else {
            Node {
                first: words.z,
                count: words.w,
            }
        }
    }

    /// Whether the node has children rather than references.
    #[inline]
    pub fn is_inner(&self) -> bool {
        self.count == INNER
    }
}

/// The box around everything, and of an octree the raster of its smallest cells.
///
/// An octree's is a cube. All planes of all cells, `low + i * cell` for `0 <= i <= 2^depth`, are exact in f32, so that neighbours agree on
/// their common plane bit for bit. Every triangle lies inside by a margin that exceeds the traversal's rounding error.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Root {
    /// Corner with the smallest coordinates, scene units.
    pub low: Vec3,
    /// Edge length of the smallest cells, scene units.
    pub cell: f32,
    /// Corner with the largest coordinates, scene units.
    pub high: Vec3,
    /// Level of the smallest cells, at most [`MAX_DEPTH`].
    pub depth: u32,
}

const _: () = assert!(size_of::<Root>() == 32);

impl Root {
    /// The cube as a box.
    #[inline]
    pub fn aabb(&self) -> Aabb {
        Aabb {
            low: self.low,
            high: self.high,
        }
    }

    /// Length of the longest edge, scene units.
    #[inline]
    pub fn size(&self) -> f32 {
        max_component(self.high - self.low)
    }
}

/// By how much a cell is widened, in edge lengths of the root, before triangles are sorted into it.
///
/// The traversal computes where a ray crosses a plane with a relative error of a few units in the last place of
/// distances up to the root's diagonal, on a GPU with division of 2.5 units. Where it takes the wrong one of two
/// neighbours, the part of the ray that it leaves out is shorter than this, and what lies there is in both.
pub const CELL_MARGIN: f32 = 1.0 / (1 << 18) as f32;
