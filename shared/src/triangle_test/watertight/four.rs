//! The watertight test of four triangles at once.

use super::{Watertight, edge_on};
use crate::triangle_test::Crossings;
use core::arch::x86_64::*;
use glam::{Vec3, Vec4};

/// For each axis, where in a corner's row its rotated components lie.
const ROTATED: [[i32; 4]; 3] = [[1, 2, 0, 3], [2, 0, 1, 3], [0, 1, 2, 3]];

/// Where the ray's line crosses four triangles, of each of which is said where the rows of its corners lie: operation by
/// operation the same as that of one triangle.
///
/// # Safety
/// The processor has AVX, and there are rows at all twelve places.
#[inline(always)]
pub(super) unsafe fn crossings(test: &Watertight, [p, q, r, s]: [[*const Vec4; 3]; 4]) -> Crossings {
    // SAFETY: the caller's; rows are words, which can be read from anywhere, and `axis` is at most 2.
    unsafe {
        let rotation = _mm_loadu_si128(ROTATED.as_ptr().add(test.axis as usize).cast());
        // `map` of an array may be a call.
        macro_rules! row {
            ($at:expr) => {
                _mm_permutevar_ps(_mm_loadu_ps($at.cast()), rotation)
            };
        }
        let sheared = |p: *const Vec4, q: *const Vec4, r: *const Vec4, s: *const Vec4| {
            let (r0, r1, r2, r3) = (row!(p), row!(q), row!(r), row!(s));
            let (low01, low23) = (_mm_unpacklo_ps(r0, r1), _mm_unpacklo_ps(r2, r3));
            let (high01, high23) = (_mm_unpackhi_ps(r0, r1), _mm_unpackhi_ps(r2, r3));
            let x = _mm_sub_ps(_mm_movelh_ps(low01, low23), _mm_set1_ps(test.origin.x));
            let y = _mm_sub_ps(_mm_movehl_ps(low23, low01), _mm_set1_ps(test.origin.y));
            let z = _mm_sub_ps(_mm_movelh_ps(high01, high23), _mm_set1_ps(test.origin.z));
            (
                _mm_sub_ps(x, _mm_mul_ps(_mm_set1_ps(test.shear.x), z)),
                _mm_sub_ps(y, _mm_mul_ps(_mm_set1_ps(test.shear.y), z)),
                _mm_mul_ps(z, _mm_set1_ps(test.shear.z)),
            )
        };
        let a = sheared(p[0], q[0], r[0], s[0]);
        let b = sheared(p[1], q[1], r[1], s[1]);
        let c = sheared(p[2], q[2], r[2], s[2]);
        let difference_of_products = |a, b, c, d| _mm_sub_ps(_mm_mul_ps(a, b), _mm_mul_ps(c, d));
        let weight_a = difference_of_products(c.0, b.1, c.1, b.0);
        let weight_b = difference_of_products(a.0, c.1, a.1, c.0);
        let weight_c = difference_of_products(b.0, a.1, b.1, a.0);
        let determinant = _mm_add_ps(_mm_add_ps(weight_a, weight_b), weight_c);
        let reciprocal = _mm_div_ps(_mm_set1_ps(1.0), determinant);
        let zero = _mm_setzero_ps();
        let front = _mm_and_ps(
            _mm_and_ps(_mm_cmpge_ps(weight_a, zero), _mm_cmpge_ps(weight_b, zero)),
            _mm_cmpge_ps(weight_c, zero),
        );
        let back = _mm_and_ps(
            _mm_and_ps(_mm_cmple_ps(weight_a, zero), _mm_cmple_ps(weight_b, zero)),
            _mm_cmple_ps(weight_c, zero),
        );
        let absolute = |x| _mm_andnot_ps(_mm_set1_ps(-0.0), x);
        let size = absolute(determinant);
        let has_area = _mm_cmpgt_ps(size, _mm_set1_ps(f32::MIN_POSITIVE));
        let distance = _mm_add_ps(
            _mm_add_ps(_mm_mul_ps(weight_a, a.2), _mm_mul_ps(weight_b, b.2)),
            _mm_mul_ps(weight_c, c.2),
        );
        let inside = _mm_or_ps(front, back);
        let mut crossings = Crossings {
            crosses: _mm_movemask_ps(_mm_and_ps(inside, has_area)) as u32,
            ..Crossings::default()
        };
        _mm_storeu_ps(crossings.t.as_mut_ptr(), _mm_mul_ps(distance, reciprocal));
        _mm_storeu_ps(crossings.u.as_mut_ptr(), _mm_mul_ps(weight_b, reciprocal));
        _mm_storeu_ps(crossings.v.as_mut_ptr(), _mm_mul_ps(weight_c, reciprocal));
        let product = |x, y| absolute(_mm_mul_ps(x, y));
        let largest = _mm_max_ps(_mm_max_ps(product(c.0, b.1), product(a.0, c.1)), product(b.0, a.1));
        let is_edge_on = _mm_cmple_ps(size, _mm_mul_ps(_mm_set1_ps(edge_on::EDGE_ON), largest));
        let mut edge_on = _mm_movemask_ps(_mm_and_ps(inside, is_edge_on)) as u32;
        while edge_on != 0 {
            let lane = edge_on.trailing_zeros() as usize;
            edge_on &= edge_on - 1;
            let corner = |corner: (__m128, __m128, __m128)| {
                let [x, y, z] = [corner.0, corner.1, corner.2].map(|x| {
                    let mut lanes = [0.0; 4];
                    _mm_storeu_ps(lanes.as_mut_ptr(), x);
                    lanes[lane]
                });
                Vec3::new(x, y, z)
            };
            let crossing = edge_on::crossing([corner(a), corner(b), corner(c)]);
            crossings.crosses = crossings.crosses & !(1 << lane) | u32::from(crossing.crosses) << lane;
            (crossings.t[lane], crossings.u[lane], crossings.v[lane]) = (crossing.t, crossing.u, crossing.v);
        }
        crossings
    }
}
