//! Reflection and refraction at a smooth boundary.

use crate::arithmetic::max;
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
pub fn refracted(direction: Vec3, normal: Vec3, from: f32, to: f32) -> Refraction {
    let eta = from / to;
    let along = -normal.dot(direction);
    let cosine = if along > 1.0 { 1.0 } else { max(along, 0.0) };
    // From the part of the direction along the surface: 1 - cosine^2 would cancel near the perpendicular.
    let tangent = direction + normal * along;
    let sine_squared = eta * eta * tangent.dot(tangent);
    if sine_squared >= 1.0 {
        return Refraction {
            direction,
            reflectance: 1.0,
            total: true,
        };
    }
    let beyond = (1.0 - sine_squared).sqrt();
    let perpendicular = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    let parallel = (to * cosine - from * beyond) / (to * cosine + from * beyond);
    Refraction {
        direction: (tangent * eta - normal * beyond).normalize(),
        reflectance: 0.5 * (perpendicular * perpendicular + parallel * parallel),
        total: false,
    }
}
