//! Where a ray that leaves a surface starts.

use crate::arithmetic::max_component;
use crate::hit::Hit;
use crate::triangle::Triangle;
use glam::Vec3;

/// Of a coordinate, what rounding of the hit point can amount to: 2^-24.
const COORDINATE_ERROR: f32 = 5.96e-8;
/// Of an edge, what rounding of the hit point can amount to: three times 2^-24.
const EDGE_ERROR: f32 = 1.79e-7;

/// The origin of a ray that leaves `triangle` at `hit` on the side to which the unit face normal `side` points.
///
/// The point comes from the barycentric weights, not from `origin + t * direction`, whose error grows with the length of
/// the ray; it is then moved along the normal by a bound of its own rounding error, so that a ray never meets the
/// surface it leaves, and is moved no further than that. The bound is the one of NVIDIA's "Self-intersection avoidance"
/// (2023), in the mesh's own coordinates.
pub fn secondary_origin(triangle: &Triangle, hit: &Hit, side: Vec3) -> Vec3 {
    let edge_ab = triangle.b - triangle.a;
    let edge_ac = triangle.c - triangle.a;
    let extent = max_component(edge_ab.abs() + edge_ac.abs() + (edge_ab - edge_ac).abs());
    let error = triangle.a.abs() * COORDINATE_ERROR + Vec3::splat(EDGE_ERROR * extent);
    let point = triangle.a + (edge_ab * hit.u + edge_ac * hit.v);
    point + side * error.dot(side.abs())
}
