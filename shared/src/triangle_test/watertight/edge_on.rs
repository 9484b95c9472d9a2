//! Triangles that the ray sees edge-on, natively.

use crate::triangle_test::Crossing;
use glam::Vec3;

/// Up to this part of the largest product, the determinant is what rounding has left of the edge functions: each of them is off
/// by up to a 2^-23 of such a product, and the sum of three should be 20 times that to say where on the triangle a line is.
pub(super) const EDGE_ON: f32 = 64.0 * f32::EPSILON;

/// The test where f32 leaves nothing of the determinant: the products of f32 are exact in f64, so that the edge functions have
/// the right sign and their proportions are right, whether the line passes between the corners or beside them.
///
/// The corners are sheared. Of two triangles that share an edge, both see it alike, as in f32.
#[cold]
#[inline(never)]
pub(super) fn crossing([a, b, c]: [Vec3; 3]) -> Crossing {
    let edge = |from: Vec3, to: Vec3| f64::from(from.x) * f64::from(to.y) - f64::from(from.y) * f64::from(to.x);
    let weights = [edge(c, b), edge(a, c), edge(b, a)];
    let inside = weights.iter().all(|weight| *weight >= 0.0) || weights.iter().all(|weight| *weight <= 0.0);
    let determinant: f64 = weights.iter().sum();
    let distance = weights[0] * f64::from(a.z) + weights[1] * f64::from(b.z) + weights[2] * f64::from(c.z);
    Crossing {
        crosses: inside && determinant.abs() > f64::from(f32::MIN_POSITIVE),
        t: (distance / determinant) as f32,
        u: (weights[1] / determinant) as f32,
        v: (weights[2] / determinant) as f32,
    }
}
