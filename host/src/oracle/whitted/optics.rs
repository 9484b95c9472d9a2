//! Reflection and refraction at a smooth boundary.

use glam::DVec3;

/// A refracted ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refraction {
    /// Nothing goes through.
    Total,
    /// Part of the light does.
    Partial {
        /// Unit vector.
        direction: DVec3,
        /// What is reflected, 0 to 1, of light that is not polarised.
        reflectance: f64,
    },
}

/// The mirror image of a direction at a surface with a unit normal.
pub(super) fn mirrored(direction: DVec3, normal: DVec3) -> DVec3 {
    direction.reflect(normal)
}

/// How a ray with the unit direction goes on beyond a boundary, from a medium with index of refraction `from` into one
/// with `to`: the laws of Snell and Fresnel. The unit normal points to where the ray comes from.
pub(super) fn refracted(direction: DVec3, normal: DVec3, from: f64, to: f64) -> Refraction {
    let cosine = (-direction.dot(normal)).clamp(0.0, 1.0);
    let across = direction + normal * cosine;
    let sine_squared = (from / to).powi(2) * (1.0 - cosine * cosine);
    if sine_squared >= 1.0 {
        return Refraction::Total;
    }
    let beyond = (1.0 - sine_squared).sqrt();
    let perpendicular = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    let parallel = (from * beyond - to * cosine) / (from * beyond + to * cosine);
    Refraction::Partial {
        direction: (across * (from / to) - normal * beyond).normalize(),
        reflectance: (perpendicular.powi(2) + parallel.powi(2)) / 2.0,
    }
}
