//! The way of a ray through a structure, and the search along it.

use crate::box_test::BoxTest;
use crate::buffer::load;
use crate::candidate::{nearer, within};
use crate::entered::Entered;
use crate::hit::Hit;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::traversal::Traversal;
use crate::triangle_test::TriangleTest;
use core::marker::PhantomData;

/// The way of a ray from leaf to leaf of a structure, front to back.
pub trait Walk {
    /// What a leaf is.
    type Leaf: Leaf;

    /// See [`Traversal::SHADOWS_APART`].
    const SHADOWS_APART: bool = true;

    /// Takes a ray to the structure, with the box test `B`.
    #[inline(always)]
    fn enter<B: BoxTest>(scene: &Scene<'_>, ray: &Ray) -> Entered {
        Entered::new::<B>(scene, ray)
    }

    /// The way of a ray that has entered; where it has not, [`Walk::goes_on`] is false.
    fn new(scene: &Scene<'_>, entered: &Entered) -> Self;

    /// Whether there is more to visit.
    fn goes_on(&self) -> bool;

    /// Goes to the next leaf, which may be empty. What lies behind `limit` may be left out.
    fn leaf(&mut self, scene: &Scene<'_>, limit: f32) -> Self::Leaf;

    /// Leaves the leaf. What lies behind `limit` need not be visited.
    fn leave(&mut self, limit: f32);
}

/// The triangles of a leaf that are still to be tested.
pub trait Leaf {
    /// Whether there are any.
    fn remains(&self) -> bool;

    /// Takes one of them; returns its slot.
    fn take(&mut self, scene: &Scene<'_>) -> u32;
}

/// Triangles side by side.
pub struct Range {
    /// Slot of the next.
    pub next: u32,
    /// The slot behind the last.
    pub end: u32,
}

impl Leaf for Range {
    #[inline(always)]
    fn remains(&self) -> bool {
        self.next < self.end
    }

    #[inline(always)]
    fn take(&mut self, _: &Scene<'_>) -> u32 {
        self.next += 1;
        self.next - 1
    }
}

/// Triangles that are listed among the references.
pub struct List {
    /// Index of the next reference.
    pub next: u32,
    /// The index behind the last.
    pub end: u32,
}

impl Leaf for List {
    #[inline(always)]
    fn remains(&self) -> bool {
        self.next < self.end
    }

    #[inline(always)]
    fn take(&mut self, scene: &Scene<'_>) -> u32 {
        self.next += 1;
        load(scene.references, self.next - 1)
    }
}

/// Some of up to 32 triangles side by side.
pub struct Some32 {
    /// Slot of the first, whether it is one of them or not.
    pub first: u32,
    /// A bit for each, the lowest for the first.
    pub bits: u32,
}

impl Leaf for Some32 {
    #[inline(always)]
    fn remains(&self) -> bool {
        self.bits != 0
    }

    #[inline(always)]
    fn take(&mut self, _: &Scene<'_>) -> u32 {
        let slot = self.first + self.bits.trailing_zeros();
        self.bits &= self.bits - 1;
        slot
    }
}

/// The search along the way `W`, with the box test `B` at the structure's box and the triangle test `T` in the leaves.
///
/// Its loops ask at their end whether to go on: one that asks at its beginning becomes a branch inside of a loop that asks
/// once more, and closest hits take a tenth longer on a GPU.
pub struct Along<W, B, T>(PhantomData<(W, B, T)>);

impl<W: Walk, B: BoxTest, T: TriangleTest> Traversal for Along<W, B, T> {
    const SHADOWS_APART: bool = W::SHADOWS_APART;

    #[inline(always)]
    fn closest_hit(scene: &Scene<'_>, ray: &Ray) -> Hit {
        let entered = W::enter::<B>(scene, ray);
        let mut best = Hit::miss(entered.ray.t_max);
        let test = T::prepare_in(scene, &entered.ray);
        let mut walk = W::new(scene, &entered);
        if walk.goes_on() {
            loop {
                let mut leaf = walk.leaf(scene, best.t);
                if leaf.remains() {
                    loop {
                        nearer(scene, &test, leaf.take(scene), entered.ray.t_min, &mut best);
                        if !leaf.remains() {
                            break;
                        }
                    }
                }
                walk.leave(best.t);
                if !walk.goes_on() {
                    break;
                }
            }
        }
        entered.left(ray, best)
    }

    #[inline(always)]
    fn any_hit(scene: &Scene<'_>, ray: &Ray) -> bool {
        let entered = W::enter::<B>(scene, ray);
        let mut found = false;
        let test = T::prepare_in(scene, &entered.ray);
        let mut walk = W::new(scene, &entered);
        if walk.goes_on() {
            loop {
                let mut leaf = walk.leaf(scene, entered.ray.t_max);
                if leaf.remains() {
                    loop {
                        found = within(scene, &test, leaf.take(scene), &entered.ray);
                        if found | !leaf.remains() {
                            break;
                        }
                    }
                }
                walk.leave(entered.ray.t_max);
                if found | !walk.goes_on() {
                    break;
                }
            }
        }
        found
    }
}
