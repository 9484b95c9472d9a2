//! The traversal for processors that have AVX2: eight boxes and four triangles at a time, in lanes.
//!
//! Boxes are tested with fused multiply-add, triangles without it: a box may be met that the scalar twin passes by, hits are
//! the same bit for bit.

mod node;

use super::MAX_LEVEL;
use crate::buffer::load;
use crate::entered::Entered;
use crate::hit::Hit;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::TriangleTest;
use core::arch::x86_64::*;
use core::hint::select_unpredictable;
use core::mem::MaybeUninit;
use node::{Group, Nodes};
use std::sync::LazyLock;

/// Whether this processor has what the functions below need; asked once, then remembered.
#[inline(always)]
pub(super) fn are_there() -> bool {
    static ARE_THERE: LazyLock<bool> = LazyLock::new(|| {
        std::is_x86_feature_detected!("avx2")
            && std::is_x86_feature_detected!("fma")
            && std::is_x86_feature_detected!("bmi1")
            && std::is_x86_feature_detected!("bmi2")
            && std::is_x86_feature_detected!("lzcnt")
            && std::is_x86_feature_detected!("popcnt")
    });
    *ARE_THERE
}

/// The closest hit.
///
/// # Safety
/// [`are_there`].
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
pub(super) unsafe fn closest_hit<T: TriangleTest>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    let entered = Entered::by_slabs(scene, ray);
    let mut best = Hit::miss(entered.ray.t_max);
    if entered.inside {
        let test = T::prepare_in(scene, &entered.ray);
        let visit = |leaves: Batch, limit: &mut f32| {
            // SAFETY: a batch has slots that there are.
            let crossings = unsafe { test.crossings_at(scene, leaves.slots, leaves.count) };
            let mut nearer = leaves.within(&crossings.t, entered.ray.t_min, *limit) & crossings.crosses;
            let found = nearer != 0;
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
            found
        };
        walk::<false>(scene, &entered, visit);
    }
    entered.left(ray, best)
}

/// Whether there is a hit.
///
/// # Safety
/// As of [`closest_hit`].
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
pub(super) unsafe fn any_hit<T: TriangleTest>(scene: &Scene<'_>, ray: &Ray) -> bool {
    let entered = Entered::by_slabs(scene, ray);
    if !entered.inside {
        return false;
    }
    let test = T::prepare_in(scene, &entered.ray);
    let visit = |leaves: Batch, limit: &mut f32| {
        // SAFETY: as above.
        let crossings = unsafe { test.crossings_at(scene, leaves.slots, leaves.count) };
        leaves.within(&crossings.t, entered.ray.t_min, *limit) & crossings.crosses != 0
    };
    walk::<true>(scene, &entered, visit)
}

/// Up to four triangles of a node's leaves, that there are.
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
        let nearest = first + triangles.trailing_zeros();
        let mut batch = Batch {
            slots: [nearest; 4],
            count: triangles.count_ones().min(4),
        };
        *triangles &= *triangles - 1;
        for slot in &mut batch.slots[1..] {
            *slot = select_unpredictable(*triangles == 0, nearest, first.wrapping_add(triangles.trailing_zeros()));
            *triangles &= triangles.wrapping_sub(1);
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

/// Entries of the stack: one for every level that has children, and two beside.
const DEPTH: usize = MAX_LEVEL as usize + 2;

/// Goes from node to node, front to back, as [`super::Walk`] does; `visit` gets leaves, returns whether it has found
/// anything, and may move the limit of `t`. Whoever looks for the closest hit goes on then, with `ANY` that is all.
///
/// What lies behind a limit that has moved is not visited: the boxes are wide enough that no triangle in one is hit before
/// the ray enters it.
///
/// # Panics
/// Where a link of the scene leads nowhere.
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
#[inline]
fn walk<const ANY: bool>(scene: &Scene<'_>, entered: &Entered, mut visit: impl FnMut(Batch, &mut f32) -> bool) -> bool {
    let mut limit = entered.ray.t_max;
    let nodes = Nodes::new(scene.nodes, &entered.ray);
    // Groups of which children remain, above an empty one. Where the ray enters the children is of use once the limit moves.
    let mut stack = [MaybeUninit::<Group>::uninit(); DEPTH];
    stack[0] = MaybeUninit::new(Group::EMPTY);
    let mut enters = [MaybeUninit::<__m256>::uninit(); DEPTH];
    let mut waiting = 1;
    let count = scene.triangles.len() / 3;
    let mut node = 0;
    loop {
        let met = nodes.meet(node, _mm256_set1_ps(limit));
        let mut group = met.group;
        if met.leaves != 0 {
            if !group.is_empty() {
                // On its way while the leaves are looked at.
                nodes.prefetch(nodes.front(group));
            }
            let (first, mut triangles) = nodes.triangles(&met);
            let end = first as usize + (u32::BITS - triangles.leading_zeros()) as usize;
            assert!(end <= count, "there is no such triangle");
            let mut found = false;
            while triangles != 0 {
                found |= visit(Batch::next(&mut triangles, first), &mut limit);
                if ANY && found {
                    return true;
                }
            }
            if found {
                let before = |enters| nodes.before(enters, _mm256_set1_ps(limit));
                group = group.within(before(met.enters));
                let mut kept = 1;
                for level in 1..waiting {
                    // SAFETY: below `waiting` all were written.
                    let (entered, group) = unsafe { (enters[level].assume_init(), stack[level].assume_init()) };
                    let remains = group.within(before(entered));
                    stack[kept] = MaybeUninit::new(remains);
                    enters[kept] = MaybeUninit::new(entered);
                    kept += usize::from(!remains.is_empty());
                }
                waiting = kept;
            }
        }
        if !ANY {
            enters[waiting] = MaybeUninit::new(met.enters);
        }
        // SAFETY: as above.
        let top = unsafe { stack[waiting - 1].assume_init() };
        // Without a branch: half of them would be foreseen wrongly.
        waiting -= usize::from(group.is_empty());
        group = group.or(top);
        if waiting == 0 {
            return false;
        }
        node = nodes.front(group);
        let rest = group.rest();
        stack[waiting] = MaybeUninit::new(rest);
        waiting += usize::from(!rest.is_empty());
    }
}
