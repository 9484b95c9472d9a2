//! Eight rays that go much the same way, in lanes.

use super::start::TAME;
use crate::entered::NEARBY;
use crate::hit::{Hit, NO_TRIANGLE};
use crate::ray::Ray;
use crate::scene::Scene;
use crate::slabs::LEAST_SLOPE;
use crate::triangle_test::{Eight, TriangleTest};
use core::arch::x86_64::*;

/// How much the directions' slopes may differ from the first one's, and the origins from the first one in edge lengths of the
/// cube around everything: wider packets visit more nodes than their rays would.
const SLOPE_SPREAD: f32 = 1.0 / 16.0;
const ORIGIN_SPREAD: f32 = 1.0 / 16.0;

/// Eight rays with the same octant and the same axis of the largest direction component, ready for the nodes.
pub(super) struct Packet {
    /// As of [`crate::slabs::Slabs`], by axis.
    pub reciprocal: [__m256; 3],
    /// The same; the bits of powers of two are to be added.
    pub unscaled: [__m256i; 3],
    /// As of [`crate::slabs::Slabs`], by axis.
    pub offset: [__m256; 3],
    /// As of [`crate::slabs::Slabs`].
    pub octant: usize,
    /// What the rays' triangle tests keep.
    pub test: Eight,
    /// As of [`crate::ray::PreparedRay`].
    pub t_min: __m256,
    /// As of [`crate::ray::PreparedRay`].
    t_max: __m256,
    /// As of [`crate::ray::PreparedRay`].
    scale: __m256,
}

/// The best hits of a packet's rays.
pub(super) struct Best {
    /// What is behind is of no interest, in the prepared `t`.
    pub t: __m256,
    /// Slots of the triangles, [`NO_TRIANGLE`] where there is none.
    pub slot: __m256i,
    /// Their ids.
    pub id: __m256i,
    /// Barycentric weights.
    pub u: __m256,
    pub v: __m256,
}

impl Packet {
    /// Prepares rays. None unless all of them start near the scene with directions neither huge nor tiny, may hit something,
    /// and go much the same way.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn new<T: TriangleTest>(scene: &Scene<'_>, rays: &[Ray; 8]) -> Option<Self> {
        // A ray is eight f32: origin, t_min, direction, t_max.
        let [ox, oy, oz, t_min, dx, dy, dz, t_max] = transposed(rays);
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let (low, high) = (scene.root.low.to_array(), scene.root.high.to_array());
        let reach = scene.root.size() * (NEARBY - 1.0);
        let size = direction.map(|direction| _mm256_andnot_ps(_mm256_set1_ps(-0.0), direction));
        let zero = _mm256_setzero_ps();
        let mut is_fair = _mm256_and_ps(
            _mm256_cmp_ps::<_CMP_LE_OQ>(t_min, t_max),
            _mm256_cmp_ps::<_CMP_LE_OQ>(zero, t_max),
        );
        let mut moves_at_all = zero;
        for axis in 0..3 {
            let from = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_set1_ps(low[axis] - reach), origin[axis]);
            let to = _mm256_cmp_ps::<_CMP_LE_OQ>(origin[axis], _mm256_set1_ps(high[axis] + reach));
            let is_tame = _mm256_and_ps(
                _mm256_cmp_ps::<_CMP_LE_OQ>(size[axis], _mm256_set1_ps(TAME)),
                _mm256_or_ps(
                    _mm256_cmp_ps::<_CMP_GE_OQ>(size[axis], _mm256_set1_ps(1.0 / TAME)),
                    _mm256_cmp_ps::<_CMP_EQ_OQ>(size[axis], zero),
                ),
            );
            is_fair = _mm256_and_ps(_mm256_and_ps(is_fair, is_tame), _mm256_and_ps(from, to));
            moves_at_all = _mm256_or_ps(moves_at_all, _mm256_cmp_ps::<_CMP_NEQ_OQ>(size[axis], zero));
        }
        if _mm256_movemask_ps(_mm256_and_ps(is_fair, moves_at_all)) != 0xff {
            return None;
        }
        // Bit for bit as one ray is prepared.
        let largest = _mm256_max_ps(_mm256_max_ps(size[0], size[1]), size[2]);
        let exponent = _mm256_and_si256(_mm256_castps_si256(largest), _mm256_set1_epi32(0x7f80_0000));
        let scale = _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_set1_epi32(254 << 23), exponent));
        let unscale = _mm256_castsi256_ps(exponent);
        let mut reciprocal = [zero; 3];
        let mut offset = [zero; 3];
        let mut scaled = [zero; 3];
        let mut octant = 0;
        for axis in 0..3 {
            let moves = _mm256_cmp_ps::<_CMP_NEQ_OQ>(size[axis], zero);
            let inverse = _mm256_mul_ps(_mm256_div_ps(_mm256_set1_ps(1.0), direction[axis]), unscale);
            reciprocal[axis] = _mm256_blendv_ps(_mm256_set1_ps(1.0 / LEAST_SLOPE), inverse, moves);
            scaled[axis] = _mm256_and_ps(_mm256_mul_ps(direction[axis], scale), moves);
            offset[axis] = _mm256_mul_ps(_mm256_xor_ps(origin[axis], _mm256_set1_ps(-0.0)), reciprocal[axis]);
            match _mm256_movemask_ps(reciprocal[axis]) {
                0 => {}
                0xff => octant |= 1 << axis,
                _ => return None,
            }
        }
        let test = T::eight(origin, scaled)?;
        let [across, upwards] = test.slopes();
        let differs = |values: __m256, by: f32| {
            let first = _mm256_broadcastss_ps(_mm256_castps256_ps128(values));
            let difference = _mm256_andnot_ps(_mm256_set1_ps(-0.0), _mm256_sub_ps(values, first));
            _mm256_cmp_ps::<_CMP_GT_OQ>(difference, _mm256_set1_ps(by))
        };
        let spread = ORIGIN_SPREAD * scene.root.size();
        let differs = _mm256_or_ps(
            _mm256_or_ps(differs(across, SLOPE_SPREAD), differs(upwards, SLOPE_SPREAD)),
            _mm256_or_ps(
                _mm256_or_ps(differs(ox, spread), differs(oy, spread)),
                differs(oz, spread),
            ),
        );
        if _mm256_movemask_ps(differs) != 0 {
            return None;
        }
        let one = _mm256_set1_epi32(127 << 23);
        Some(Packet {
            reciprocal,
            unscaled: reciprocal.map(|reciprocal| _mm256_sub_epi32(_mm256_castps_si256(reciprocal), one)),
            offset,
            octant,
            test,
            t_min: _mm256_mul_ps(_mm256_max_ps(t_min, zero), unscale),
            t_max: _mm256_mul_ps(t_max, unscale),
            scale,
        })
    }

    /// No hits yet.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn none(&self) -> Best {
        let zero = _mm256_setzero_ps();
        Best {
            t: self.t_max,
            slot: _mm256_set1_epi32(NO_TRIANGLE as i32),
            id: _mm256_set1_epi32(-1),
            u: zero,
            v: zero,
        }
    }

    /// What was found, in the `t` of the rays as they were given.
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    #[inline]
    pub fn found(&self, best: &Best, rays: &[Ray; 8]) -> [Hit; 8] {
        // As of a ray that was not advanced.
        let t = _mm256_mul_ps(_mm256_add_ps(best.t, _mm256_setzero_ps()), self.scale);
        let (mut ts, mut us, mut vs, mut slots) = ([0.0; 8], [0.0; 8], [0.0; 8], [0_u32; 8]);
        // SAFETY: there is room for eight of each.
        unsafe {
            _mm256_storeu_ps(ts.as_mut_ptr(), t);
            _mm256_storeu_ps(us.as_mut_ptr(), best.u);
            _mm256_storeu_ps(vs.as_mut_ptr(), best.v);
            _mm256_storeu_si256(slots.as_mut_ptr().cast(), best.slot);
        }
        let mut hits = [Hit::miss(0.0); 8];
        for lane in 0..8 {
            hits[lane] = if slots[lane] == NO_TRIANGLE {
                Hit::miss(rays[lane].t_max)
            } else {
                Hit {
                    t: ts[lane],
                    triangle: slots[lane],
                    u: us[lane],
                    v: vs[lane],
                }
            };
        }
        hits
    }
}

/// The words of eight rays, the first ones in the first register.
#[target_feature(enable = "avx2")]
#[inline]
fn transposed(rays: &[Ray; 8]) -> [__m256; 8] {
    // SAFETY: a ray is eight f32.
    let row = |index: usize| unsafe { _mm256_loadu_ps(core::ptr::from_ref(&rays[index]).cast()) };
    let pair = |a, b| (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
    let ((a, b), (c, d)) = (pair(row(0), row(1)), pair(row(2), row(3)));
    let ((e, f), (g, h)) = (pair(row(4), row(5)), pair(row(6), row(7)));
    let low = |a, b| _mm256_shuffle_ps::<0b01_00_01_00>(a, b);
    let high = |a, b| _mm256_shuffle_ps::<0b11_10_11_10>(a, b);
    let first = [low(a, c), high(a, c), low(b, d), high(b, d)];
    let second = [low(e, g), high(e, g), low(f, h), high(f, h)];
    let near = |index: usize| _mm256_permute2f128_ps::<0x20>(first[index], second[index]);
    let far = |index: usize| _mm256_permute2f128_ps::<0x31>(first[index], second[index]);
    [near(0), near(1), near(2), near(3), far(0), far(1), far(2), far(3)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::octree::Root;
    use crate::triangle_test::{Indexed, MollerTrumbore, Watertight};
    use bytemuck::Zeroable;
    use glam::{Vec3, Vec3Swizzles};

    fn is_packet<T: TriangleTest>(rays: &[Ray; 8]) -> bool {
        let scene = Scene {
            root: Root {
                high: Vec3::ONE,
                ..Root::zeroed()
            },
            nodes: &[],
            references: &[],
            triangles: &[],
            ids: &[],
            parts: 0,
        };
        // SAFETY: asked before.
        unsafe { Packet::new::<T>(&scene, rays) }.is_some()
    }

    /// Neighbouring pixels, a shadow's, and what is not alike.
    #[test]
    fn rays_that_go_much_the_same_way_are_a_packet() {
        if !super::super::are_there() {
            return;
        }
        let spread = |by: Vec3| {
            core::array::from_fn(|lane| {
                Ray::new(Vec3::new(0.5, 0.5, -2.0), Vec3::new(0.1, 0.2, 1.0) + by * lane as f32)
            })
        };
        let near = spread(Vec3::new(0.002, 0.0, 0.0));
        assert!(is_packet::<Watertight>(&near));
        assert!(is_packet::<Indexed<Watertight>>(&near));
        assert!(!is_packet::<MollerTrumbore>(&near));
        assert!(!is_packet::<Watertight>(&spread(Vec3::new(0.05, 0.0, 0.0))), "slopes");
        let with = |change: fn(&mut Ray)| {
            let mut rays = near;
            change(&mut rays[5]);
            is_packet::<Watertight>(&rays)
        };
        assert!(with(|_| {}));
        assert!(with(|ray| ray.direction *= 3.0), "lengths do not matter");
        assert!(!with(|ray| ray.origin.x += 0.1), "origins");
        assert!(!with(|ray| ray.direction = ray.direction.zxy()), "axes");
        assert!(!with(|ray| ray.direction.x = -0.001), "octants");
        assert!(!with(|ray| ray.origin.z = -9.0), "far away");
        assert!(!with(|ray| ray.direction *= 1e20), "huge");
        assert!(!with(|ray| ray.direction = Vec3::ZERO), "nowhere");
        assert!(!with(|ray| ray.direction.y = f32::NAN), "no number");
        assert!(!with(|ray| ray.t_max = -1.0), "no way");
    }
}
