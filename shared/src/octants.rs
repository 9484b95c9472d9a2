//! The octree of tight boxes.

mod boxes;
#[cfg(target_arch = "x86_64")]
mod lanes;

use crate::box_test::{BoxTest, KayKajiya};
use crate::buffer::{Stack, load};
use crate::entered::Entered;
use crate::hit::Hit;
use crate::parts::TraversalKind;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::slabs::Slabs;
#[cfg(target_arch = "x86_64")]
use crate::traversal;
use crate::traversal::Traversal;
use crate::triangle_test::TriangleTest;
use crate::walk::{self, Along, Some32};
use boxes::met;
use core::marker::PhantomData;
use glam::{UVec2, uvec2};

/// Words of a node, four to a vector.
pub const NODE_VECTORS: u32 = 8;

/// Deepest level of a node; the root's is 0. The traversal's stack has one entry for each level.
pub const MAX_LEVEL: u32 = 31;

/// A leaf has at most so many triangles: a node's leaves have 32 places among them.
pub const MAX_LEAF: u32 = 4;

/// By how much boxes must be wider on every side, in parts of the largest coordinate of the cube around everything plus
/// ten of its edge lengths, for rays to miss none that they touch: origins are no further from the cube than
/// [`crate::entered::NEARBY`] of its edge lengths along each axis, and the planes' crossings are off by less than eight
/// roundings of such coordinates.
pub const MARGIN: f32 = 1.0 / (1 << 21) as f32;

/// A tree of eight children a node, each triangle in one leaf, with the triangle test `T`.
///
/// A node's children lie in the slots of its octants, their boxes tight around what is in them, on the
/// node's own raster (H. Ylitie, T. Karras, S. Laine, "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", HPG 2017). A ray visits slots in the order of `slot XOR octant`, so that front comes before back without sorting.
///
/// Deviations: faces are halves of f32 instead of integers of 8 bits, which take a GPU and a processor longer to make f32
/// of; no postponed triangles, leaves of a node are tested before its inner children; boxes are
/// wider by [`MARGIN`], so that rounding misses none; own words.
///
/// A node is 32 words: the raster's corner (three f32); its sizes as exponents, 8 bits each of x, y, z, and in the highest
/// 8 bits the slots that hold inner nodes; the first inner child's index; the first leaf's slot; for each octant a byte, of
/// a leaf its count times 32 plus its first triangle's place among the node's; then for x, y and z each the low faces of
/// all octants and the high ones, from the corner in parts of the size: 0 to 1, two to a word
/// (see [`crate::arithmetic::halves`]).
///
/// With `LANES`, a processor that has AVX2 tests a node's boxes, and four triangles, in the lanes of a register; the answers
/// are the same bit for bit.
pub struct Octants<T, const LANES: bool = true>(PhantomData<T>);

impl<T: TriangleTest, const LANES: bool> Traversal for Octants<T, LANES> {
    #[inline(always)]
    fn parts(_: u32) -> u32 {
        if T::IS_INDEXED {
            TraversalKind::Compact as u32
        } else {
            TraversalKind::Octants as u32
        }
    }

    #[inline(always)]
    fn closest_hit(scene: &Scene<'_>, ray: &Ray) -> Hit {
        #[cfg(target_arch = "x86_64")]
        if LANES && lanes::are_there() {
            // SAFETY: they are there.
            return unsafe { lanes::closest_hit::<T>(scene, ray) };
        }
        Along::<Walk, KayKajiya, T>::closest_hit(scene, ray)
    }

    #[inline(always)]
    fn any_hit(scene: &Scene<'_>, ray: &Ray) -> bool {
        #[cfg(target_arch = "x86_64")]
        if LANES && lanes::are_there() {
            // SAFETY: as above.
            return unsafe { lanes::any_hit::<T>(scene, ray) };
        }
        Along::<Walk, KayKajiya, T>::any_hit(scene, ray)
    }

    #[cfg(target_arch = "x86_64")]
    fn closest_hits(scene: &Scene<'_>, rays: &[Ray], hits: &mut [Hit]) {
        if LANES && lanes::are_there() {
            // SAFETY: as above.
            unsafe { lanes::closest_hits::<T>(scene, rays, hits) }
        } else {
            traversal::closest_hits_in_turn::<Self>(scene, rays, hits);
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn any_hits(scene: &Scene<'_>, rays: &[Ray], are_hit: &mut [bool]) {
        if LANES && lanes::are_there() {
            // SAFETY: as above.
            unsafe { lanes::any_hits::<T>(scene, rays, are_hit) }
        } else {
            traversal::any_hits_in_turn::<Self>(scene, rays, are_hit);
        }
    }
}

/// The walk of a ray from node to node.
pub struct Walk {
    slabs: Slabs,
    t_min: f32,
    /// The node to visit.
    node: u32,
    /// Index of the first inner child of the node whose children are being visited.
    base: u32,
    /// Its children that remain, bit `slot XOR octant`; from bit 8 its slots with inner nodes.
    group: u32,
    stack: Stack<UVec2, { MAX_LEVEL as usize + 1 }>,
    goes_on: bool,
}

impl walk::Walk for Walk {
    type Leaf = Some32;

    /// By slabs, whatever the box test.
    #[inline(always)]
    fn enter<B: BoxTest>(scene: &Scene<'_>, ray: &Ray) -> Entered {
        Entered::by_slabs(scene, ray)
    }

    #[inline(always)]
    fn new(_: &Scene<'_>, entered: &Entered) -> Self {
        Walk {
            slabs: Slabs::new(&entered.ray),
            t_min: entered.ray.t_min,
            node: 0,
            base: 0,
            group: 0,
            stack: Stack::new(UVec2::ZERO),
            goes_on: entered.inside,
        }
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// Visits the current node: its inner children are the next to visit, the triangles of its leaves are returned.
    #[inline(always)]
    fn leaf(&mut self, scene: &Scene<'_>, limit: f32) -> Some32 {
        let at = self.node * NODE_VECTORS;
        let frame = load(scene.nodes, at);
        let links = load(scene.nodes, at + 1);
        let hits = met(&self.slabs, scene.nodes, at, frame, self.t_min, limit);
        let inner = frame.w >> 24;
        if self.group & 0xff != 0 {
            self.stack.push(uvec2(self.base, self.group));
        }
        self.base = links.x;
        self.group = toward(hits & inner, self.slabs.octant) | inner << 8;
        let mut bits = 0;
        let mut leaves = hits & !inner;
        if leaves != 0 {
            loop {
                let slot = leaves.trailing_zeros();
                leaves &= leaves - 1;
                let (low, high) = (links.z, links.w);
                let word = if slot < 4 { low } else { high };
                let byte = word >> (8 * (slot & 3));
                bits |= ((1 << (byte >> 5 & 7)) - 1) << (byte & 31);
                if leaves == 0 {
                    break;
                }
            }
        }
        Some32 { first: links.y, bits }
    }

    /// Goes to the node that is in front of all that remain.
    #[inline(always)]
    fn leave(&mut self, _: f32) {
        let mut remains = self.group & 0xff != 0;
        if !remains & (self.stack.waiting != 0) {
            let entry = self.stack.pop();
            self.base = entry.x;
            self.group = entry.y;
            remains = true;
        }
        let slot = (self.group.trailing_zeros() ^ self.slabs.octant) & 7;
        let before = (self.group >> 8) & ((1 << slot) - 1);
        self.group &= self.group.wrapping_sub(1);
        self.node = self.base + before.count_ones();
        self.goes_on = remains;
    }
}

/// Moves bit `slot` to bit `slot XOR octant`.
#[inline(always)]
const fn toward(slots: u32, octant: u32) -> u32 {
    let by_x = (slots & 0x55) << 1 | (slots >> 1 & 0x55);
    let bits = if octant & 1 != 0 { by_x } else { slots };
    let by_y = (bits & 0x33) << 2 | (bits >> 2 & 0x33);
    let bits = if octant & 2 != 0 { by_y } else { bits };
    let by_z = (bits & 0x0f) << 4 | (bits >> 4 & 0x0f);
    if octant & 4 != 0 { by_z } else { bits }
}
