//! Reflection and refraction at a smooth boundary.

use crate::arithmetic::{dot_with_error, max, product_with_error};
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// The mirrored direction: as long as `direction`, on the other side of the plane with the unit `normal`.
#[inline]
pub fn reflected(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - normal * (2.0 * normal.dot(direction))
}

/// A refracted ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refraction {
    /// Unit vector; means nothing where all is reflected.
    pub direction: Vec3,
    /// Part that is reflected, 0 to 1 (Fresnel's equations, mean of both polarisations).
    pub reflectance: f32,
    /// Whether nothing goes through (total internal reflection).
    pub total: bool,
}

/// How a ray with unit `direction` goes on beyond the boundary whose unit `normal` points to where it comes from, out of
/// a medium with index of refraction `from` into one with `to` (Snell's law).
///
/// In the form of B. de Greve, "Reflections and refractions in ray tracing" (2006). Total internal reflection is a branch
/// and not the root of a negative number, which has no value on a GPU.
///
/// Deviation: the squared cosine beyond, `1 - (from / to)^2 (1 - cosine^2)`, is what two almost equal numbers leave near
/// the critical angle, and near grazing where the indices differ little. There a rounding of 1e-7 would turn the ray by
/// its root, and the vectors themselves are only as long as 1 to within that; so it is computed with the errors of all
/// roundings that matter, and holds for the two directions whatever their lengths.
pub fn refracted(direction: Vec3, normal: Vec3, from: f32, to: f32) -> Refraction {
    let (against, error) = dot_with_error(normal, direction);
    let along = -against;
    let cosine = if along > 1.0 { 1.0 } else { max(along, 0.0) };
    // By how much the product of both squared lengths exceeds 1.
    let excess = beyond_one(normal) + beyond_one(direction);
    // (to^2 - from^2) lengths^2 + from^2 cosine^2.
    let (to_squared, to_error) = product_with_error(to, to);
    let (from_squared, from_error) = product_with_error(from, from);
    let (scaled, scaled_error) = product_with_error(from, against);
    let (known, known_error) = product_with_error(scaled, scaled);
    let difference = to_squared - from_squared;
    let beyond_squared = (difference + known)
        + (to_error - from_error + known_error + 2.0 * scaled * (scaled_error + from * error) + difference * excess);
    if beyond_squared <= 0.0 {
        return Refraction {
            direction,
            reflectance: 1.0,
            total: true,
        };
    }
    let eta = from / to;
    let beyond = beyond_squared.sqrt() / to;
    let perpendicular = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    let parallel = (to * cosine - from * beyond) / (to * cosine + from * beyond);
    let tangent = direction + normal * along;
    Refraction {
        direction: (tangent * eta - normal * beyond).normalize(),
        reflectance: 0.5 * (perpendicular * perpendicular + parallel * parallel),
        total: false,
    }
}

/// By how much the squared length of an almost unit vector exceeds 1.
fn beyond_one(unit: Vec3) -> f32 {
    let (squared, error) = dot_with_error(unit, unit);
    (squared - 1.0) + error
}
