//! The watertight test of a triangle with eight rays at once.

use super::edge_on;
use core::arch::x86_64::*;
use glam::{Vec3, Vec4};

/// What [`super::Watertight`] keeps of a ray, of eight rays whose largest direction component is along the same axis.
#[derive(Clone, Copy)]
pub struct Eight {
    /// The rays' origins, the axis last.
    origin: [__m256; 3],
    /// Where in a corner's row the components lie, the axis last.
    order: [usize; 3],
    /// Shears along x and y, and the reciprocal of the largest direction component.
    shear: [__m256; 3],
}

/// What the test of a triangle finds, ray by ray.
pub struct EightCrossings {
    /// All bits where the line crosses the triangle.
    pub crosses: __m256,
    /// See [`crate::triangle_test::Crossing::t`].
    pub t: __m256,
    /// See [`crate::triangle_test::Crossing::u`].
    pub u: __m256,
    /// See [`crate::triangle_test::Crossing::v`].
    pub v: __m256,
}

impl Eight {
    /// For prepared rays, of which origins and directions are given by axis. None where the largest component is along one
    /// axis for one and along another for another.
    ///
    /// # Safety
    /// The processor has AVX2.
    #[target_feature(enable = "avx2")]
    #[inline]
    pub fn prepare(origin: [__m256; 3], direction: [__m256; 3]) -> Option<Self> {
        let [x, y, z] = direction.map(|direction| _mm256_andnot_ps(_mm256_set1_ps(-0.0), direction));
        let less = |a, b| _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b));
        let (not_x, not_y) = (less(x, y) | less(x, z), less(y, z));
        let axis = match (not_x, not_y) {
            (0, _) => 0,
            (0xff, 0) => 1,
            (0xff, 0xff) => 2,
            _ => return None,
        };
        let order = [(axis + 1) % 3, (axis + 2) % 3, axis];
        let reciprocal = _mm256_div_ps(_mm256_set1_ps(1.0), direction[order[2]]);
        Some(Eight {
            origin: [origin[order[0]], origin[order[1]], origin[order[2]]],
            order,
            shear: [
                _mm256_mul_ps(direction[order[0]], reciprocal),
                _mm256_mul_ps(direction[order[1]], reciprocal),
                reciprocal,
            ],
        })
    }

    /// How much the rays go sideways, in lengths of the largest component.
    pub fn slopes(&self) -> [__m256; 2] {
        [self.shear[0], self.shear[1]]
    }

    /// Where the rays' lines cross a triangle, of which is said where the rows of its corners lie: for each ray operation by
    /// operation the same as that of one.
    ///
    /// # Safety
    /// The processor has AVX2, and there are rows at all three places.
    #[target_feature(enable = "avx2")]
    #[inline]
    pub unsafe fn crossings(&self, [a, b, c]: [*const Vec4; 3]) -> EightCrossings {
        let sheared = |row: *const Vec4| {
            let row = row.cast::<f32>();
            // SAFETY: the caller's; a row has four words, and none of `order` is above 2.
            let component = |place: usize| unsafe { _mm256_broadcast_ss(&*row.add(self.order[place])) };
            let x = _mm256_sub_ps(component(0), self.origin[0]);
            let y = _mm256_sub_ps(component(1), self.origin[1]);
            let z = _mm256_sub_ps(component(2), self.origin[2]);
            (
                _mm256_sub_ps(x, _mm256_mul_ps(self.shear[0], z)),
                _mm256_sub_ps(y, _mm256_mul_ps(self.shear[1], z)),
                _mm256_mul_ps(z, self.shear[2]),
            )
        };
        let (a, b, c) = (sheared(a), sheared(b), sheared(c));
        let difference_of_products = |a, b, c, d| _mm256_sub_ps(_mm256_mul_ps(a, b), _mm256_mul_ps(c, d));
        let weight_a = difference_of_products(c.0, b.1, c.1, b.0);
        let weight_b = difference_of_products(a.0, c.1, a.1, c.0);
        let weight_c = difference_of_products(b.0, a.1, b.1, a.0);
        let determinant = _mm256_add_ps(_mm256_add_ps(weight_a, weight_b), weight_c);
        let zero = _mm256_setzero_ps();
        let is_positive = |weight| _mm256_cmp_ps::<_CMP_GE_OQ>(weight, zero);
        let is_negative = |weight| _mm256_cmp_ps::<_CMP_LE_OQ>(weight, zero);
        let front = _mm256_and_ps(
            _mm256_and_ps(is_positive(weight_a), is_positive(weight_b)),
            is_positive(weight_c),
        );
        let back = _mm256_and_ps(
            _mm256_and_ps(is_negative(weight_a), is_negative(weight_b)),
            is_negative(weight_c),
        );
        let inside = _mm256_or_ps(front, back);
        let absolute = |x| _mm256_andnot_ps(_mm256_set1_ps(-0.0), x);
        let size = absolute(determinant);
        let has_area = _mm256_cmp_ps::<_CMP_GT_OQ>(size, _mm256_set1_ps(f32::MIN_POSITIVE));
        let reciprocal = _mm256_div_ps(_mm256_set1_ps(1.0), determinant);
        let distance = _mm256_add_ps(
            _mm256_add_ps(_mm256_mul_ps(weight_a, a.2), _mm256_mul_ps(weight_b, b.2)),
            _mm256_mul_ps(weight_c, c.2),
        );
        let found = EightCrossings {
            crosses: _mm256_and_ps(inside, has_area),
            t: _mm256_mul_ps(distance, reciprocal),
            u: _mm256_mul_ps(weight_b, reciprocal),
            v: _mm256_mul_ps(weight_c, reciprocal),
        };
        let product = |x, y| absolute(_mm256_mul_ps(x, y));
        let largest = _mm256_max_ps(_mm256_max_ps(product(c.0, b.1), product(a.0, c.1)), product(b.0, a.1));
        let is_edge_on = _mm256_cmp_ps::<_CMP_LE_OQ>(size, _mm256_mul_ps(_mm256_set1_ps(edge_on::EDGE_ON), largest));
        let edge_on = _mm256_movemask_ps(_mm256_and_ps(inside, is_edge_on)) as u32;
        if edge_on == 0 {
            return found;
        }
        edge_on_too(found, edge_on, [a, b, c].map(|corner| [corner.0, corner.1, corner.2]))
    }
}

/// The same with the rays of the bits of `edge_on` asked in f64.
#[cold]
#[inline(never)]
#[target_feature(enable = "avx2")]
fn edge_on_too(found: EightCrossings, mut edge_on: u32, corners: [[__m256; 3]; 3]) -> EightCrossings {
    let corners = corners.map(|corner| corner.map(|x| lanes(x)));
    let (mut crosses, mut t, mut u, mut v) = (lanes(found.crosses), lanes(found.t), lanes(found.u), lanes(found.v));
    while edge_on != 0 {
        let lane = edge_on.trailing_zeros() as usize;
        edge_on &= edge_on - 1;
        let crossing = edge_on::crossing(corners.map(|[x, y, z]| Vec3::new(x[lane], y[lane], z[lane])));
        crosses[lane] = f32::from_bits(if crossing.crosses { !0 } else { 0 });
        (t[lane], u[lane], v[lane]) = (crossing.t, crossing.u, crossing.v);
    }
    EightCrossings {
        crosses: of(crosses),
        t: of(t),
        u: of(u),
        v: of(v),
    }
}

#[target_feature(enable = "avx2")]
#[inline]
fn lanes(register: __m256) -> [f32; 8] {
    let mut lanes = [0.0; 8];
    // SAFETY: there is room for eight.
    unsafe { _mm256_storeu_ps(lanes.as_mut_ptr(), register) };
    lanes
}

#[target_feature(enable = "avx2")]
#[inline]
fn of(lanes: [f32; 8]) -> __m256 {
    // SAFETY: there are eight.
    unsafe { _mm256_loadu_ps(lanes.as_ptr()) }
}
