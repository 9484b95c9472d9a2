//! Where a ray that leaves a surface starts.

use crate::arithmetic::{max, max_component, min};
use crate::hit::Hit;
use crate::triangle::Triangle;
use glam::Vec3;

/// Of a coordinate of the hit point, what its rounding and that of the moved point can amount to, and half as much
/// again: three times 2^-24.
const POINT_ERROR: f32 = 3.0 / (1 << 24) as f32;
/// Of the triangle's extent, what rounding of the edges, of their weighted sum, and of the test that the new ray makes
/// of the same triangle can amount to: six times 2^-24.
const EXTENT_ERROR: f32 = 6.0 / (1 << 24) as f32;
/// Of the extent over the area below, what the error of that test comes to where it is more than the above, and three times
/// as much: 2^-27.
const SLENDER_ERROR: f32 = 1.0 / (1 << 27) as f32;
/// Of the extent, the most that an origin is moved for it. Of so slender a triangle, 2^24 times as long as wide, not even the normal is known.
const MOST: f32 = 1.0;

/// The point of `triangle` at `hit`, and by how much a ray's origin must be moved along the unit face normal or against
/// it, scene units.
///
/// The point comes from the barycentric weights, not from `origin + t * direction`, whose error grows with the length of
/// the ray; the distance is a bound of its rounding error, and no more, so that a ray does not meet the surface that it
/// leaves. The method is that of NVIDIA's "Self-intersection avoidance" (2023). Deviation: the bound is derived here for
/// points in the mesh's own coordinates, and counts the rounding of the last addition, without which the displacement
/// itself can be rounded away; and that the error of the test grows with how slender the triangle is, its longest edge over
/// the height above that: more than 12 times, the distance grows with it, up to the triangle's length.
pub fn surface_point(triangle: &Triangle, hit: &Hit, normal: Vec3) -> (Vec3, f32) {
    let edge_ab = triangle.b - triangle.a;
    let edge_ac = triangle.c - triangle.a;
    let extent = max_component(edge_ab.abs() + edge_ac.abs() + (edge_ab - edge_ac).abs());
    let point = triangle.a + (edge_ab * hit.u + edge_ac * hit.v);
    let scale = 1.0 / extent;
    // A quarter over how slender it is, as the extent is about twice the longest edge.
    let area = max_component((edge_ab * scale).cross(edge_ac * scale).abs());
    let of_extent = max(EXTENT_ERROR, min(SLENDER_ERROR / area, MOST));
    let error = point.abs() * POINT_ERROR + Vec3::splat(extent * of_extent);
    (point, error.dot(normal.abs()))
}

/// The origin of a ray that leaves `triangle` at `hit` on the side to which the unit face normal `side` points.
pub fn secondary_origin(triangle: &Triangle, hit: &Hit, side: Vec3) -> Vec3 {
    let (point, clearance) = surface_point(triangle, hit, side);
    point + side * clearance
}
