//! Rays on their way from node to node.

use super::batch::Batch;
use super::node::{Group, Nodes};
use super::start::Start;
use crate::buffer::load;
use crate::hit::Hit;
use crate::octants::MAX_LEVEL;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::TriangleTest;
use core::arch::x86_64::*;
use core::mem::MaybeUninit;

/// Entries of the stack: one for every level that has children, and two beside.
const DEPTH: usize = MAX_LEVEL as usize + 2;

/// A ray on its way from node to node, but for its stacks.
struct Pursuit<'a, T> {
    /// Which of the rays it is.
    index: usize,
    start: Start,
    nodes: Nodes<'a>,
    test: T,
    /// The node to visit.
    node: u32,
    /// How many groups wait.
    waiting: usize,
    /// What is behind this `t` is of no interest.
    limit: f32,
    best: Hit,
}

impl<'a, T: TriangleTest> Pursuit<'a, T> {
    /// At the root.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    fn new(scene: &Scene<'a>, index: usize, start: Start) -> Self {
        Pursuit {
            index,
            nodes: Nodes::new(scene.nodes, &start),
            test: T::prepare_in(scene, &start.ray),
            node: 0,
            waiting: 1,
            limit: start.ray.t_max,
            best: Hit::miss(start.ray.t_max),
            start,
        }
    }

    /// What was found of the ray as it was given.
    #[inline(always)]
    fn found(&self, given: &Ray) -> Hit {
        if self.best.is_hit() {
            self.start.left(self.best)
        } else {
            Hit::miss(given.t_max)
        }
    }
}

/// Visits the node that a pursuit has come to and chooses the next one, front to back, as [`super::Walk`] does. True where
/// there is none, or where any hit will do and there is one.
///
/// What lies behind a limit that has moved is not visited: the boxes are wide enough that no triangle in one is hit before
/// the ray enters it.
///
/// A macro, so that what is known of two rays at a time stays in registers: a function with `target_feature` cannot be
/// `inline(always)`.
macro_rules! visit {
    ($scene:ident, $count:ident, $pursuit:ident, $stack:ident, $enters:ident, $any:expr) => {
        'visit: {
            let met = $pursuit.nodes.meet($pursuit.node, _mm256_set1_ps($pursuit.limit));
            let mut group = met.group;
            if met.leaves != 0 {
                if !group.is_empty() {
                    // On its way while the leaves are looked at.
                    $pursuit.nodes.prefetch($pursuit.nodes.front(group));
                }
                let (first, mut triangles) = $pursuit.nodes.triangles(&met);
                let end = first as usize + (u32::BITS - triangles.leading_zeros()) as usize;
                assert!(end <= $count, "there is no such triangle");
                let mut found = false;
                while triangles != 0 {
                    let batch = Batch::next(&mut triangles, first);
                    // SAFETY: a batch has slots that there are.
                    let crossings = unsafe { $pursuit.test.crossings_at($scene, batch.slots, batch.count) };
                    let mut nearer =
                        batch.within(&crossings.t, $pursuit.start.ray.t_min, $pursuit.limit) & crossings.crosses;
                    found |= nearer != 0;
                    while nearer != 0 {
                        let lane = nearer.trailing_zeros() as usize & 3;
                        nearer &= nearer - 1;
                        let (t, slot) = (crossings.t[lane], batch.slots[lane]);
                        let wins = (t < $pursuit.best.t)
                            || (t == $pursuit.best.t
                                && (!$pursuit.best.is_hit()
                                    || load($scene.ids, slot) < load($scene.ids, $pursuit.best.triangle)));
                        if wins {
                            $pursuit.best = Hit {
                                t,
                                triangle: slot,
                                u: crossings.u[lane],
                                v: crossings.v[lane],
                            };
                            $pursuit.limit = t;
                        }
                    }
                    if $any && found {
                        break 'visit true;
                    }
                }
                if found {
                    let limit = _mm256_set1_ps($pursuit.limit);
                    group = group.within($pursuit.nodes.before(met.enters, limit));
                    let mut kept = 1;
                    for level in 1..$pursuit.waiting {
                        // SAFETY: below `waiting` all were written.
                        let (entered, group) = unsafe { ($enters[level].assume_init(), $stack[level].assume_init()) };
                        let remains = group.within($pursuit.nodes.before(entered, limit));
                        $stack[kept] = MaybeUninit::new(remains);
                        $enters[kept] = MaybeUninit::new(entered);
                        kept += usize::from(!remains.is_empty());
                    }
                    $pursuit.waiting = kept;
                }
            }
            if !$any {
                $enters[$pursuit.waiting] = MaybeUninit::new(met.enters);
            }
            // SAFETY: as above.
            let top = unsafe { $stack[$pursuit.waiting - 1].assume_init() };
            // Without a branch: half of them would be foreseen wrongly.
            let waiting = $pursuit.waiting - usize::from(group.is_empty());
            let group = group.or(top);
            if waiting == 0 {
                break 'visit true;
            }
            $pursuit.node = $pursuit.nodes.front(group);
            let rest = group.rest();
            $stack[waiting] = MaybeUninit::new(rest);
            $pursuit.waiting = waiting + usize::from(!rest.is_empty());
            false
        }
    };
}

/// Searches for one ray, of whose hits any will do or the closest is wanted.
///
/// # Panics
/// Where a link of the scene leads nowhere.
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
#[inline]
pub(super) fn pursue_one<T: TriangleTest, const ANY: bool>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    let Some(start) = Start::new(scene, ray) else {
        return Hit::miss(ray.t_max);
    };
    let count = T::slots(scene);
    let mut stack = [MaybeUninit::<Group>::uninit(); DEPTH];
    let mut enters = [MaybeUninit::<__m256>::uninit(); DEPTH];
    stack[0] = MaybeUninit::new(Group::EMPTY);
    let mut one = Pursuit::<T>::new(scene, 0, start);
    while !visit!(scene, count, one, stack, enters, ANY) {}
    one.found(ray)
}

/// Searches for all rays, two at a time: while one waits for its node the processor has the other's at hand. `tell` gets
/// the index and what is found of each, of which any will do or the closest is wanted.
///
/// # Panics
/// Where a link of the scene leads nowhere.
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
// Registers are allotted better to each way of searching by itself.
#[inline(never)]
pub(super) fn pursue<T: TriangleTest, const ANY: bool>(
    scene: &Scene<'_>,
    rays: &[Ray],
    mut tell: impl FnMut(usize, Hit),
) {
    let count = T::slots(scene);
    let mut started = 0;
    // Groups of which children remain to be visited, above an empty one, and where the ray enters the children of their
    // nodes, which is of use once its limit moves.
    let mut stack = [MaybeUninit::<Group>::uninit(); DEPTH];
    let mut enters = [MaybeUninit::<__m256>::uninit(); DEPTH];
    let mut other_stack = [MaybeUninit::<Group>::uninit(); DEPTH];
    let mut other_enters = [MaybeUninit::<__m256>::uninit(); DEPTH];
    // The next ray that meets anything.
    macro_rules! begin {
        ($stack:expr) => {
            loop {
                let Some(ray) = rays.get(started) else { break None };
                let index = started;
                started += 1;
                let Some(start) = Start::new(scene, ray) else {
                    tell(index, Hit::miss(ray.t_max));
                    continue;
                };
                $stack[0] = MaybeUninit::new(Group::EMPTY);
                break Some(Pursuit::<T>::new(scene, index, start));
            }
        };
    }
    let Some(mut one) = begin!(stack) else { return };
    if let Some(mut other) = begin!(other_stack) {
        loop {
            if visit!(scene, count, one, stack, enters, ANY) {
                tell(one.index, one.found(&rays[one.index]));
                let Some(next) = begin!(stack) else {
                    while !visit!(scene, count, other, other_stack, other_enters, ANY) {}
                    tell(other.index, other.found(&rays[other.index]));
                    return;
                };
                one = next;
            }
            if visit!(scene, count, other, other_stack, other_enters, ANY) {
                tell(other.index, other.found(&rays[other.index]));
                let Some(next) = begin!(other_stack) else { break };
                other = next;
            }
        }
    }
    while !visit!(scene, count, one, stack, enters, ANY) {}
    tell(one.index, one.found(&rays[one.index]));
}
