//! Directions of secondary rays.

use glam::DVec3;
use std::f64::consts::TAU;

/// A direction mirrored at a surface with this unit normal.
pub fn reflected(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - normal * (2.0 * direction.dot(normal))
}

/// A direction about a normal, distributed by its cosine (Malley's method: a point of the unit disc, lifted to the
/// sphere). `radius_squared` and `turn` are uniform, 0 to 1; `axis`, across the normal, is where turns begin.
pub fn cosine_weighted(normal: DVec3, axis: DVec3, radius_squared: f64, turn: f64) -> DVec3 {
    let axis = axis.normalize();
    let radius = radius_squared.sqrt();
    let angle = TAU * turn;
    axis * (radius * angle.cos()) + normal.cross(axis) * (radius * angle.sin()) + normal * (1.0 - radius_squared).sqrt()
}

/// What 32 bits are, 0 to 1.
pub fn unit_interval(bits: u32) -> f64 {
    f64::from(bits) / 4_294_967_296.0
}
