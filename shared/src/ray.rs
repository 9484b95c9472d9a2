//! The ray.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A half-line `origin + t * direction`, searched for `t_min <= t <= t_max`.
///
/// The direction need not have length 1: `t` counts in lengths of it. A ray with a component that is not finite, or
/// whose direction is zero (all components below 2^-126 in size), hits nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Ray {
    /// Where the ray starts, scene units.
    pub origin: Vec3,
    /// Smallest `t` that counts as a hit, in lengths of `direction`.
    pub t_min: f32,
    /// Where the ray goes, scene units per `t`.
    pub direction: Vec3,
    /// Largest `t` that counts as a hit, in lengths of `direction`; [`T_MAX`] where unbounded.
    pub t_max: f32,
}

/// Stands for an unbounded `t`. Not infinity, which naga rejects as a literal.
pub const T_MAX: f32 = 3.0e38;

const _: () = assert!(size_of::<Ray>() == 32);

impl Ray {
    /// A ray without limits: every hit at `t >= 0` counts.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Ray {
            origin,
            t_min: 0.0,
            direction,
            t_max: T_MAX,
        }
    }
}
