//! Packets on their way from node to node.

use super::node::Children;
use super::packet::{Best, Packet};
use crate::buffer::load;
use crate::hit::Hit;
use crate::octants::{MAX_LEVEL, NODE_VECTORS};
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::TriangleTest;
use core::arch::x86_64::*;
use core::mem::MaybeUninit;

/// Entries of the stack: on each level all children but one wait.
const DEPTH: usize = 7 * (MAX_LEVEL as usize + 1) + 1;

/// So many rays of a packet are asked one by one which children they meet, all eight children at a time, before children are
/// asked about all rays: most of them are met by none.
const FEW: u32 = 4;

/// A node that waits.
#[derive(Clone, Copy)]
struct Waiting {
    /// Where the rays enter its box; infinite for those that do not.
    enters: __m256,
    node: u32,
}

/// A node's raster as the rays of a packet see it, by axis.
struct Raster {
    /// From one end of it to the other, in `t`.
    steps: [__m256; 3],
    /// Where it begins.
    starts: [__m256; 3],
    t_min: __m256,
}

impl Raster {
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    fn new(packet: &Packet, children: &Children) -> Self {
        let mut raster = Raster {
            steps: packet.reciprocal,
            starts: packet.offset,
            t_min: packet.t_min,
        };
        for axis in 0..3 {
            let exponent = _mm256_set1_epi32(children.exponents[axis]);
            raster.steps[axis] = _mm256_castsi256_ps(_mm256_add_epi32(exponent, packet.unscaled[axis]));
            let corner = _mm256_set1_ps(children.corner[axis]);
            raster.starts[axis] = _mm256_fmadd_ps(corner, packet.reciprocal[axis], packet.offset[axis]);
        }
        raster
    }

    /// Where the rays enter the box of a child, and all bits of those that do before `limit`.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    fn meet(&self, children: &Children, child: usize, limit: __m256) -> (__m256, __m256) {
        let crossed = |faces: &[[f32; 8]; 3], axis: usize| {
            _mm256_fmadd_ps(
                _mm256_set1_ps(faces[axis][child & 7]),
                self.steps[axis],
                self.starts[axis],
            )
        };
        let (near, far) = (&children.near, &children.far);
        let enters = _mm256_max_ps(
            _mm256_max_ps(crossed(near, 0), crossed(near, 1)),
            _mm256_max_ps(crossed(near, 2), self.t_min),
        );
        let exits = _mm256_min_ps(
            _mm256_min_ps(crossed(far, 0), crossed(far, 1)),
            _mm256_min_ps(crossed(far, 2), limit),
        );
        (enters, _mm256_cmp_ps::<_CMP_LE_OQ>(enters, exits))
    }

    /// Children that any of some rays, a bit each, meets before `limit`.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    fn met_by(&self, children: &Children, mut rays: u32, limit: __m256) -> u32 {
        let mut lanes = [[0.0_f32; 8]; 8];
        let [a, b, c] = self.starts;
        let [d, e, f] = self.steps;
        for (lanes, values) in lanes.iter_mut().zip([a, b, c, d, e, f, self.t_min, limit]) {
            // SAFETY: there is room for eight.
            unsafe { _mm256_storeu_ps(lanes.as_mut_ptr(), values) };
        }
        let mut met = 0;
        while rays != 0 {
            let ray = rays.trailing_zeros() as usize & 7;
            rays &= rays - 1;
            let of_ray = |value: usize| _mm256_set1_ps(lanes[value][ray]);
            let crossed = |faces: &[[f32; 8]; 3], axis: usize| {
                // SAFETY: there are eight.
                let faces = unsafe { _mm256_loadu_ps(faces[axis].as_ptr()) };
                _mm256_fmadd_ps(faces, of_ray(3 + axis), of_ray(axis))
            };
            let (near, far) = (&children.near, &children.far);
            let enters = _mm256_max_ps(
                _mm256_max_ps(crossed(near, 0), crossed(near, 1)),
                _mm256_max_ps(crossed(near, 2), of_ray(6)),
            );
            let exits = _mm256_min_ps(
                _mm256_min_ps(crossed(far, 0), crossed(far, 1)),
                _mm256_min_ps(crossed(far, 2), of_ray(7)),
            );
            met |= _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enters, exits)) as u32;
        }
        met
    }
}

/// Searches for the rays of a packet together, of each of which any hit will do or the closest is wanted. None where they do
/// not go much the same way.
///
/// A node is visited once for all rays that meet its box, and a triangle of a leaf is tested with all of them (I. Wald,
/// P. Slusallek, C. Benthin, M. Wagner, "Interactive rendering with coherent ray tracing", Computer Graphics Forum 20(3),
/// 2001). Boxes and triangles are asked as one ray alone asks them: the hits are the same bit for bit.
///
/// # Panics
/// Where a link of the scene leads nowhere.
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
// Registers are allotted better to each way of searching by itself.
#[inline(never)]
pub(super) fn pursue_together<T: TriangleTest, const ANY: bool>(
    scene: &Scene<'_>,
    rays: &[Ray; 8],
) -> Option<[Hit; 8]> {
    let packet = Packet::new::<T>(scene, rays)?;
    let count = T::slots(scene);
    let nodes = scene.nodes.len() as u32 / NODE_VECTORS;
    let mut best = packet.none();
    // What is behind is of no interest: nothing is before that of a ray that has a hit where any will do.
    let mut limit = best.t;
    let mut stack = [MaybeUninit::<Waiting>::uninit(); DEPTH];
    let mut waiting = 0;
    let mut node = 0;
    let mut active = 0xff_u32;
    loop {
        assert!(node < nodes, "there is no such node");
        // SAFETY: it is there.
        let children = unsafe { Children::new(scene.nodes, node, packet.octant) };
        let raster = Raster::new(&packet, &children);
        let candidates = if active.count_ones() <= FEW {
            raster.met_by(&children, active, limit)
        } else {
            !0
        };
        let mut leaves = children.leaves & candidates;
        while leaves != 0 {
            let child = leaves.trailing_zeros() as usize;
            leaves &= leaves - 1;
            let (_, meets) = raster.meet(&children, child, limit);
            if _mm256_movemask_ps(meets) == 0 {
                continue;
            }
            let (first, triangles) = children.leaf(child);
            let end = first as usize + triangles as usize;
            assert!(end <= count, "there is no such triangle");
            for slot in first..end as u32 {
                // SAFETY: there is such a slot.
                let crossings = unsafe { packet.test.crossings(T::corners_at(scene, slot)) };
                let within = _mm256_and_ps(
                    _mm256_cmp_ps::<_CMP_GE_OQ>(crossings.t, packet.t_min),
                    _mm256_cmp_ps::<_CMP_LE_OQ>(crossings.t, limit),
                );
                let nearer = _mm256_and_ps(_mm256_and_ps(within, meets), crossings.crosses);
                if _mm256_movemask_ps(nearer) == 0 {
                    continue;
                }
                let of_slot = _mm256_set1_epi32(slot as i32);
                if ANY {
                    best.slot = _mm256_blendv_epi8(best.slot, of_slot, _mm256_castps_si256(nearer));
                    limit = _mm256_blendv_ps(limit, _mm256_set1_ps(f32::NEG_INFINITY), nearer);
                    if _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_GE_OQ>(limit, packet.t_min)) == 0 {
                        return Some(packet.found(&best, rays));
                    }
                    continue;
                }
                let id = _mm256_set1_epi32(load(scene.ids, slot) as i32);
                // As numbers without a sign: that of none is the highest.
                let is_higher = _mm256_cmpeq_epi32(_mm256_min_epu32(best.id, id), best.id);
                let ties = _mm256_cmp_ps::<_CMP_EQ_OQ>(crossings.t, best.t);
                let loses = _mm256_and_ps(ties, _mm256_castsi256_ps(is_higher));
                let wins = _mm256_andnot_ps(loses, nearer);
                best = Best {
                    t: _mm256_blendv_ps(best.t, crossings.t, wins),
                    slot: _mm256_blendv_epi8(best.slot, of_slot, _mm256_castps_si256(wins)),
                    id: _mm256_blendv_epi8(best.id, id, _mm256_castps_si256(wins)),
                    u: _mm256_blendv_ps(best.u, crossings.u, wins),
                    v: _mm256_blendv_ps(best.v, crossings.v, wins),
                };
                limit = best.t;
            }
        }
        // From back to front: the front one is visited next.
        let mut inner = children.inner & candidates;
        while inner != 0 {
            let child = 31 - inner.leading_zeros() as usize;
            inner &= !(1 << child);
            let (enters, meets) = raster.meet(&children, child, limit);
            stack[waiting] = MaybeUninit::new(Waiting {
                enters: _mm256_blendv_ps(_mm256_set1_ps(f32::INFINITY), enters, meets),
                node: children.node(child),
            });
            waiting += usize::from(_mm256_movemask_ps(meets) != 0);
        }
        // A limit may have moved since.
        loop {
            if waiting == 0 {
                return Some(packet.found(&best, rays));
            }
            waiting -= 1;
            // SAFETY: below `waiting` all were written.
            let next = unsafe { stack[waiting].assume_init() };
            active = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(next.enters, limit)) as u32;
            if active != 0 {
                node = next.node;
                break;
            }
        }
    }
}
