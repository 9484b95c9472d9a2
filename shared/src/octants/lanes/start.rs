//! Where a ray starts, one axis a lane.

use crate::arithmetic::max;
use crate::entered::{Entered, NEARBY};
use crate::hit::Hit;
use crate::ray::{PreparedRay, Ray};
use crate::scene::Scene;
use crate::slabs::{LEAST_SLOPE, Slabs};
use core::arch::x86_64::*;
use glam::{Vec3, Vec4};

/// A ray ready for the nodes.
pub(super) struct Start {
    /// Prepared, bit for bit as [`Entered::by_slabs`] does it.
    pub ray: PreparedRay,
    /// As of [`Slabs`]; the last lane means nothing.
    pub reciprocal: __m128,
    /// As of [`Slabs`]; the last lane means nothing.
    pub offset: __m128,
    /// By how much the origin was advanced, in the prepared `t`.
    advance: f32,
}

/// Largest size of a direction's components, but for zeros, that is prepared in lanes; the least is one over it. Of two
/// within these bounds neither is negligible beside the other, and products with their reciprocals keep all their digits.
pub(super) const TAME: f32 = (1_u32 << 30) as f32;

impl Start {
    /// Prepares a ray and takes it to the scene. None if it meets nothing.
    #[inline(always)]
    pub fn new(scene: &Scene<'_>, ray: &Ray) -> Option<Self> {
        match Self::nearby(scene, ray) {
            Some(start) => Some(start),
            None => {
                let (ray, advance) = Self::entered(scene, ray)?;
                let slabs = Slabs::new(&ray);
                Some(Start {
                    reciprocal: of(slabs.reciprocal),
                    offset: of(slabs.offset),
                    advance,
                    ray,
                })
            }
        }
    }

    /// Prepares a ray that starts near the scene and whose direction is neither huge nor tiny: nearly all are such. None
    /// of others.
    #[inline(always)]
    fn nearby(scene: &Scene<'_>, ray: &Ray) -> Option<Self> {
        // SAFETY: a ray is eight f32: origin, t_min, direction, t_max; SSE2 is always there.
        unsafe {
            let words = core::ptr::from_ref(ray).cast::<f32>();
            let (origin, direction) = (_mm_loadu_ps(words), _mm_loadu_ps(words.add(4)));
            let reach = Vec3::splat(scene.root.size() * (NEARBY - 1.0));
            let is_near = _mm_and_ps(
                _mm_cmple_ps(of(scene.root.low - reach), origin),
                _mm_cmple_ps(origin, of(scene.root.high + reach)),
            );
            let size = _mm_andnot_ps(_mm_set1_ps(-0.0), direction);
            let moves = _mm_cmpneq_ps(size, _mm_setzero_ps());
            let is_tame = _mm_and_ps(
                _mm_cmple_ps(size, _mm_set1_ps(TAME)),
                _mm_or_ps(
                    _mm_cmpge_ps(size, _mm_set1_ps(1.0 / TAME)),
                    _mm_cmpeq_ps(size, _mm_setzero_ps()),
                ),
            );
            let is_fair = (_mm_movemask_ps(_mm_and_ps(is_near, is_tame)) & 7 == 7)
                & (_mm_movemask_ps(moves) & 7 != 0)
                & (ray.t_min <= ray.t_max)
                & (0.0 <= ray.t_max);
            if !is_fair {
                return None;
            }
            // A ray that starts nearby is not advanced, and the root's children tell whether it meets anything. Powers of
            // two may be taken out of the reciprocals, which need not wait for them then.
            let largest = _mm_max_ps(
                _mm_max_ps(size, _mm_shuffle_ps::<0b11_01_00_01>(size, size)),
                _mm_shuffle_ps::<0b11_10_10_10>(size, size),
            );
            let exponent = _mm_and_si128(_mm_castps_si128(largest), _mm_set1_epi32(0x7f80_0000));
            let exponent = _mm_shuffle_epi32::<0>(exponent);
            let scale = _mm_castsi128_ps(_mm_sub_epi32(_mm_set1_epi32(254 << 23), exponent));
            let unscale = _mm_castsi128_ps(exponent);
            let reciprocal = _mm_mul_ps(_mm_div_ps(_mm_set1_ps(1.0), direction), unscale);
            let reciprocal = _mm_or_ps(
                _mm_and_ps(moves, reciprocal),
                _mm_andnot_ps(moves, _mm_set1_ps(1.0 / LEAST_SLOPE)),
            );
            let scaled = Vec4::from(_mm_and_ps(_mm_mul_ps(direction, scale), moves));
            let unscale = _mm_cvtss_f32(unscale);
            Some(Start {
                ray: PreparedRay {
                    origin: ray.origin,
                    direction: Vec3::new(scaled.x, scaled.y, scaled.z),
                    t_min: max(ray.t_min, 0.0) * unscale,
                    t_max: ray.t_max * unscale,
                    scale: _mm_cvtss_f32(scale),
                    valid: true,
                },
                reciprocal,
                offset: _mm_mul_ps(_mm_xor_ps(origin, _mm_set1_ps(-0.0)), reciprocal),
                advance: 0.0,
            })
        }
    }

    /// Prepares any ray and takes it to the scene: code of its own, so that the other way stays in registers.
    #[cold]
    #[inline(never)]
    fn entered(scene: &Scene<'_>, ray: &Ray) -> Option<(PreparedRay, f32)> {
        let entered = Entered::by_slabs(scene, ray);
        entered.inside.then_some((entered.ray, entered.advance))
    }

    /// What was found, in the `t` of the ray as it was given.
    #[inline(always)]
    pub fn left(&self, hit: Hit) -> Hit {
        Hit {
            t: (hit.t + self.advance) * self.ray.scale,
            ..hit
        }
    }
}

/// The components in lanes.
#[inline(always)]
fn of(v: Vec3) -> __m128 {
    v.extend(0.0).into()
}
