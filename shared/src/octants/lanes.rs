//! The traversal for processors that have AVX2: eight boxes and four triangles at a time, in lanes.
//!
//! Without fused multiply-add, which would round otherwise than the scalar twins.

mod node;

use super::MAX_LEVEL;
use crate::buffer::load;
use crate::entered::Entered;
use crate::hit::Hit;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::TriangleTest;
use core::arch::x86_64::*;
use core::mem::MaybeUninit;
use node::{Met, Nodes};

/// Whether this processor has what the functions below need; asked once, then remembered.
#[inline(always)]
pub(super) fn are_there() -> bool {
    std::is_x86_feature_detected!("avx2")
        && std::is_x86_feature_detected!("bmi1")
        && std::is_x86_feature_detected!("popcnt")
}

/// The closest hit.
///
/// # Safety
/// [`are_there`], and the scene's arrays are valid.
#[target_feature(enable = "avx2,bmi1,popcnt")]
pub(super) unsafe fn closest_hit<T: TriangleTest>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    let entered = Entered::by_slabs(scene, ray);
    let mut best = Hit::miss(entered.ray.t_max);
    if entered.inside {
        let test = T::prepare_in(scene, &entered.ray);
        let visit = |leaves: Batch, limit: &mut f32| {
            // SAFETY: a valid scene's leaves have valid slots.
            let crossings = unsafe { test.crossings_at(scene, leaves.slots, leaves.count) };
            let mut nearer = leaves.within(&crossings.t, entered.ray.t_min, *limit) & crossings.crosses;
            while nearer != 0 {
                let lane = nearer.trailing_zeros() as usize & 3;
                nearer &= nearer - 1;
                let (t, slot) = (crossings.t[lane], leaves.slots[lane]);
                let wins = (t < best.t)
                    || (t == best.t && (!best.is_hit() || load(scene.ids, slot) < load(scene.ids, best.triangle)));
                if wins {
                    best = Hit {
                        t,
                        triangle: slot,
                        u: crossings.u[lane],
                        v: crossings.v[lane],
                    };
                    *limit = t;
                }
            }
            true
        };
        // SAFETY: the caller's.
        unsafe { walk(scene, &entered, visit) };
    }
    entered.left(ray, best)
}

/// Whether there is a hit.
///
/// # Safety
/// As of [`closest_hit`].
#[target_feature(enable = "avx2,bmi1,popcnt")]
pub(super) unsafe fn any_hit<T: TriangleTest>(scene: &Scene<'_>, ray: &Ray) -> bool {
    let entered = Entered::by_slabs(scene, ray);
    let mut found = false;
    if entered.inside {
        let test = T::prepare_in(scene, &entered.ray);
        let visit = |leaves: Batch, limit: &mut f32| {
            // SAFETY: as above.
            let crossings = unsafe { test.crossings_at(scene, leaves.slots, leaves.count) };
            found = leaves.within(&crossings.t, entered.ray.t_min, *limit) & crossings.crosses != 0;
            !found
        };
        // SAFETY: the caller's.
        unsafe { walk(scene, &entered, visit) };
    }
    found
}

/// Up to four triangles of a node's leaves.
struct Batch {
    /// Their slots; beyond `count` that of the first.
    slots: [u32; 4],
    /// How many they are, 1 to 4.
    count: u32,
}

impl Batch {
    /// Takes triangles of a node out of the bits of those that remain, of which there must be one.
    #[inline(always)]
    fn next(triangles: &mut u32, first: u32) -> Self {
        let nearest = triangles.trailing_zeros();
        let mut batch = Batch {
            slots: [first + nearest; 4],
            count: 1,
        };
        *triangles &= *triangles - 1;
        for slot in &mut batch.slots[1..] {
            let is_there = *triangles != 0;
            let place = if is_there { triangles.trailing_zeros() } else { nearest };
            *slot = first + place;
            *triangles &= triangles.wrapping_sub(u32::from(is_there));
            batch.count += u32::from(is_there);
        }
        batch
    }

    /// Bit for each triangle whose `t` is between two limits.
    #[inline(always)]
    fn within(&self, t: &[f32; 4], t_min: f32, limit: f32) -> u32 {
        // SAFETY: SSE is always there, and the array has four elements.
        let lanes = unsafe {
            let t = _mm_loadu_ps(t.as_ptr());
            let within = _mm_and_ps(_mm_cmpge_ps(t, _mm_set1_ps(t_min)), _mm_cmple_ps(t, _mm_set1_ps(limit)));
            _mm_movemask_ps(within) as u32
        };
        lanes & ((1 << self.count) - 1)
    }
}

/// A level of the tree whose children were not all visited.
#[derive(Clone, Copy)]
struct Level {
    /// Where the ray enters the children's boxes, slot by slot.
    enters: __m256,
    /// Index of the first inner child.
    base: u32,
    /// The children that remain, see [`super::Walk`].
    group: u32,
}

/// Goes from node to node, front to back, as [`super::Walk`] does; `visit` gets the leaves, moves the limit of `t`, and says
/// whether to go on.
///
/// What lies behind a limit that has moved meanwhile is not visited: the boxes are wide enough that no triangle in one is
/// hit before the ray enters it.
///
/// # Safety
/// As of [`closest_hit`].
#[inline(always)]
unsafe fn walk(scene: &Scene<'_>, entered: &Entered, mut visit: impl FnMut(Batch, &mut f32) -> bool) {
    let mut limit = entered.ray.t_max;
    // SAFETY: the caller's, here and below.
    let nodes = unsafe { Nodes::new(scene.nodes, &entered.ray) };
    let mut stack = [MaybeUninit::<Level>::uninit(); MAX_LEVEL as usize + 1];
    let mut waiting = 0;
    let mut node = 0;
    loop {
        // SAFETY: links of a valid scene lead to nodes.
        let met: Met = unsafe { nodes.meet(node, limit) };
        let mut enters = met.enters;
        let (mut base, mut group) = (met.base, met.group);
        if group & 0xff != 0 {
            // On its way while the leaves are looked at.
            nodes.prefetch(base + nodes.place(group));
        }
        if met.leaves != 0 {
            // SAFETY: it is the node of before.
            let mut triangles = unsafe { nodes.triangles(node, met.leaves) };
            while triangles != 0 {
                if !visit(Batch::next(&mut triangles, met.first), &mut limit) {
                    return;
                }
            }
        }
        while group & 0xff == 0 {
            if waiting == 0 {
                return;
            }
            waiting -= 1;
            // SAFETY: what waits was written.
            let level = unsafe { stack[waiting].assume_init() };
            (enters, base) = (level.enters, level.base);
            // SAFETY: the caller's.
            group = level.group & unsafe { nodes.before(enters, limit) };
        }
        node = base + nodes.place(group);
        group &= group - 1;
        if group & 0xff != 0 {
            stack[waiting] = MaybeUninit::new(Level { enters, base, group });
            waiting += 1;
        }
    }
}
