//! The plain bounding volume hierarchy.

use crate::aabb::Aabb;
use crate::arithmetic::{greater, lesser};
use crate::box_test::BoxTest;
use crate::buffer::{Stack, load};
use crate::entered::Entered;
use crate::scene::Scene;
use crate::walk::{self, Along, Range};
use glam::{UVec4, Vec3};

/// Words of a node, four to a vector.
pub const NODE_VECTORS: u32 = 4;

/// Deepest level of a node; the root's is 0. The traversal's stack has one entry for each level.
pub const MAX_LEVEL: u32 = 96;

/// The bit of a link that leads to a leaf.
pub const LEAF: u32 = 1 << 31;

/// By how much a box may be entered behind the nearest hit and is visited all the same. Boxes and triangles are rounded in
/// different ways: without it, of two triangles in one plane the one with the lower id would be lost where its box comes
/// out a little behind the other.
const LIMIT_SLACK: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// The link of a walk that has come to its end.
const DONE: u32 = u32::MAX;

/// Bits of a leaf's link that count its triangles; above them is the slot of the first.
pub const COUNT_BITS: u32 = 3;

/// A binary tree of boxes, each triangle in one leaf, with the box test `B` and the triangle test `T`; the nearer of two
/// children first, the other on a stack (T. Aila, S. Laine, "Understanding the efficiency of ray traversal on GPUs", HPG
/// 2009, without its tricks).
///
/// A node is 16 words: low corner of the first child's box and its link, high corner, then the same of the second child;
/// the links are the fourth and the twelfth word.
pub type Bvh2<B, T> = Along<Walk<B>, B, T>;

/// The walk of a ray from node to node.
pub struct Walk<B> {
    test: B,
    t_min: f32,
    /// The node or leaf to visit.
    link: u32,
    stack: Stack<u32, { MAX_LEVEL as usize + 1 }>,
}

impl<B: BoxTest> walk::Walk for Walk<B> {
    type Leaf = Range;

    #[inline(always)]
    fn new(scene: &Scene<'_>, entered: &Entered) -> Self {
        Walk {
            test: B::prepare_in(scene, &entered.ray),
            t_min: entered.ray.t_min,
            link: if entered.inside { 0 } else { DONE },
            stack: Stack::new(0),
        }
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        self.link != DONE
    }

    #[inline(always)]
    fn leaf(&mut self, scene: &Scene<'_>, limit: f32) -> Range {
        if self.link & LEAF == 0 {
            let limit = limit * LIMIT_SLACK;
            loop {
                self.descend(scene, limit);
                if self.link & LEAF != 0 {
                    break;
                }
            }
        }
        let next = (self.link & !LEAF) >> COUNT_BITS;
        let count = self.link & ((1 << COUNT_BITS) - 1);
        Range {
            next,
            end: if self.link == DONE { next } else { next + count },
        }
    }

    #[inline(always)]
    fn leave(&mut self, _: f32) {
        self.pop();
    }
}

impl<B: BoxTest> Walk<B> {
    /// Goes from a node to its nearer child.
    #[inline(always)]
    fn descend(&mut self, scene: &Scene<'_>, limit: f32) {
        let at = self.link * NODE_VECTORS;
        let low0 = load(scene.nodes, at);
        let high0 = load(scene.nodes, at + 1);
        let low1 = load(scene.nodes, at + 2);
        let high1 = load(scene.nodes, at + 3);
        let first = self.test.interval(&aabb(low0, high0));
        let second = self.test.interval(&aabb(low1, high1));
        let meets0 = greater(first.enter, self.t_min) <= lesser(first.exit, limit);
        let meets1 = greater(second.enter, self.t_min) <= lesser(second.exit, limit);
        let (link0, link1) = (low0.w, low1.w);
        let is_second_nearer = meets1 & (!meets0 | (second.enter < first.enter));
        self.link = if is_second_nearer { link1 } else { link0 };
        if meets0 & meets1 {
            self.stack.push(if is_second_nearer { link0 } else { link1 });
        }
        if !(meets0 | meets1) {
            self.pop();
        }
    }

    #[inline(always)]
    fn pop(&mut self) {
        if self.stack.waiting == 0 {
            self.link = DONE;
        } else {
            self.link = self.stack.pop();
        }
    }
}

#[inline(always)]
fn aabb(low: UVec4, high: UVec4) -> Aabb {
    let corner = |words: UVec4| {
        Vec3::new(
            f32::from_bits(words.x),
            f32::from_bits(words.y),
            f32::from_bits(words.z),
        )
    };
    Aabb {
        low: corner(low),
        high: corner(high),
    }
}
