//! The test by the sides of the edges.

use super::{Crossing, TriangleTest};
use crate::arithmetic::difference_of_products;
use crate::ray::PreparedRay;
use crate::triangle::Triangle;
use glam::Vec3;

/// The line passes all three edges on the same side, told by the permuted inner products of Plücker coordinates
/// (J. Amanatides and K. Choi, "Ray tracing triangular meshes", Western Computer Graphics Symposium, 1997; A. Kensler and
/// P. Shirley, "Optimizing ray-triangle intersection via automated search", RT 2006).
///
/// The origin of coordinates is moved to the ray's, so that the ray's moment is zero, and an edge's moment is made of its
/// vector and the sum of its ends: its side flips its sign, and nothing else, where a neighbour has the edge the other way
/// round, whether or not a driver contracts products and sums. So no line through the inside of a shared edge is lost.
/// Not watertight at corners: the sides of the edges that meet there round each on its own, and of the lines aimed exactly
/// at the corner of three slivers about one in eleven slips through. The distance is that of the plane, along the normal.
#[derive(Clone, Copy, Debug)]
pub struct Plucker {
    origin: Vec3,
    direction: Vec3,
}

impl TriangleTest for Plucker {
    #[inline]
    fn prepare(ray: &PreparedRay) -> Self {
        Plucker {
            origin: ray.origin,
            direction: ray.direction,
        }
    }

    #[inline]
    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let a = triangle.a - self.origin;
        let b = triangle.b - self.origin;
        let c = triangle.c - self.origin;
        let weight_a = self.side(b, c);
        let weight_b = self.side(c, a);
        let weight_c = self.side(a, b);
        let sum = weight_a + weight_b + weight_c;
        let inside = (weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0)
            || (weight_a <= 0.0 && weight_b <= 0.0 && weight_c <= 0.0);

        let ab = triangle.b - triangle.a;
        let ac = triangle.c - triangle.a;
        let normal = Vec3::new(
            difference_of_products(ab.y, ac.z, ab.z, ac.y),
            difference_of_products(ab.z, ac.x, ab.x, ac.z),
            difference_of_products(ab.x, ac.y, ab.y, ac.x),
        );
        let towards = normal.dot(self.direction);
        // Divided before it is multiplied, the smallest triangles stay clear of underflow.
        let distance = (normal * (1.0 / towards)).dot(a);
        let reciprocal = 1.0 / sum;
        Crossing {
            crosses: inside && sum.abs() > f32::MIN_POSITIVE && towards.abs() > f32::MIN_POSITIVE,
            t: distance,
            u: weight_b * reciprocal,
            v: weight_c * reciprocal,
        }
    }
}

impl Plucker {
    /// On which side of the edge between two corners the ray passes: twice the volume that it spans with them, signed.
    ///
    /// Exactly opposite for the edge the other way round.
    #[inline]
    fn side(&self, from: Vec3, to: Vec3) -> f32 {
        (to - from).cross(to + from).dot(self.direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::Ray;

    #[test]
    fn the_side_of_an_edge_is_opposite_from_its_other_end() {
        let mut x = 0.1_f32;
        let mut next = || {
            x = (x * 997.0 + 0.123_456_7) % 1.0;
            x - 0.5
        };
        let mut point = || Vec3::new(next(), next() * 1e3, next() * 1e-3);
        let mut zeros = 0;
        for _ in 0..100_000 {
            let test = Plucker::prepare(&PreparedRay::new(&Ray::new(point(), point())));
            let (from, to) = (point(), point());
            let side = test.side(from, to);
            assert_eq!(side, -test.side(to, from));
            zeros += u32::from(side == 0.0);
        }
        assert!(zeros < 100);
    }
}
