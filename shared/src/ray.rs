//! The ray, as it is given and as the traversal uses it.

use crate::arithmetic::{is_finite, is_finite_vector, max, max_component};
use crate::buffer::load;
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};

/// Stands for an unbounded `t`. Not infinity, which naga rejects as a literal.
pub const T_MAX: f32 = 3.0e38;

/// A half-line `origin + t * direction`, searched for `t_min <= t <= t_max` and `t >= 0`.
///
/// The direction need not have length 1: `t` counts in lengths of it. A ray with a component that is not finite, a limit
/// that is NaN, or a direction whose largest component lies outside 2^-126 to 2^126 in size hits nothing.
///
/// Kernels read arrays of it as rows of four words, as those of [`crate::triangle::Triangle`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Ray {
    /// Where the ray starts, scene units.
    pub origin: Vec3,
    /// Smallest `t` that counts as a hit, in lengths of `direction`.
    pub t_min: f32,
    /// Where the ray goes, scene units per `t`.
    pub direction: Vec3,
    /// Largest `t` that counts as a hit, in lengths of `direction`; [`T_MAX`] or infinity where unbounded.
    pub t_max: f32,
}

const _: () = assert!(size_of::<Ray>() == 32);

impl Ray {
    /// A ray without limits: every hit at `t >= 0` counts.
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Ray {
            origin,
            t_min: 0.0,
            direction,
            t_max: T_MAX,
        }
    }

    /// The ray at an index of those that lie in rows.
    #[inline(always)]
    pub fn of_rows(rows: &[Vec4], index: u32) -> Self {
        let origin = load(rows, 2 * index);
        let direction = load(rows, 2 * index + 1);
        Ray {
            origin: Vec3::new(origin.x, origin.y, origin.z),
            t_min: origin.w,
            direction: Vec3::new(direction.x, direction.y, direction.z),
            t_max: direction.w,
        }
    }

    /// The point at `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// A ray made safe to compute with.
///
/// The direction is scaled by a power of two, which is exact, until its largest component is in 1 to 2; components below
/// 2^-100 of that are zero (CPU and GPU agree then, whether or not they flush denormals), and no zero has a sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedRay {
    /// Where the ray starts, scene units.
    pub origin: Vec3,
    /// Scaled direction.
    pub direction: Vec3,
    /// Smallest `t` that counts, in lengths of the scaled direction, at least 0.
    pub t_min: f32,
    /// Largest `t` that counts, in lengths of the scaled direction.
    pub t_max: f32,
    /// What a `t` of this ray is multiplied with to become a `t` of the ray that it was made from.
    pub scale: f32,
    /// False where the ray can hit nothing (see [`Ray`]); the other fields mean nothing then.
    pub valid: bool,
}

/// Direction components smaller than this part of the largest one count as zero.
const NEGLIGIBLE: f32 = 7.888_609e-31; // 2^-100

impl PreparedRay {
    /// Prepares a ray.
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let largest = max_component(ray.direction.abs());
        let exponent = largest.to_bits() >> 23;
        let t_min = max(ray.t_min, 0.0);
        // Without branches: on a GPU each `&&` is one.
        let valid = is_finite_vector(ray.origin)
            & is_finite_vector(ray.direction)
            & (exponent.wrapping_sub(1) < 252)
            & is_number(ray.t_min)
            & is_number(ray.t_max)
            & (t_min <= ray.t_max);
        // Clamped so that the shift below stays in range for rays that are not valid anyway.
        let exponent = if valid { exponent } else { 127 };
        let scale = f32::from_bits((254 - exponent) << 23);
        let unscale = f32::from_bits(exponent << 23);
        PreparedRay {
            origin: ray.origin,
            direction: Vec3::new(
                significant(ray.direction.x * scale),
                significant(ray.direction.y * scale),
                significant(ray.direction.z * scale),
            ),
            t_min: t_min * unscale,
            t_max: ray.t_max * unscale,
            scale,
            valid,
        }
    }
}

#[inline]
fn significant(component: f32) -> f32 {
    if component.abs() < NEGLIGIBLE { 0.0 } else { component }
}

/// Infinity is a fair limit for `t`, NaN is not.
#[inline]
fn is_number(x: f32) -> bool {
    is_finite(x) | (x.to_bits() & 0x007f_ffff == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prepared(direction: Vec3) -> PreparedRay {
        PreparedRay::new(&Ray::new(Vec3::ONE, direction))
    }

    #[test]
    fn scaling_is_exact() {
        for exponent in [-120, -60, -1, 0, 1, 60, 120] {
            let size = 2.0_f32.powi(exponent);
            let ray = prepared(Vec3::new(0.3, -0.7, 0.11) * size);
            assert!(ray.valid, "2^{exponent}");
            assert_eq!(ray.direction, Vec3::new(0.6, -1.4, 0.22));
            assert_eq!(ray.scale * size, 2.0);
        }
    }

    #[test]
    fn negligible_components_become_positive_zero() {
        for tiny in [-0.0, 1e-39, -1e-39, 1e-45, -5e-31] {
            let ray = prepared(Vec3::new(tiny, 1.0, 0.5));
            assert_eq!(ray.direction.x.to_bits(), 0, "{tiny}");
        }
        assert_eq!(prepared(Vec3::new(1e-30, 1.0, 0.5)).direction.x, 1e-30);
    }

    #[test]
    fn rays_that_can_hit_nothing_are_not_valid() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(!prepared(Vec3::new(0.0, bad, 1.0)).valid);
            assert!(!PreparedRay::new(&Ray::new(Vec3::new(bad, 0.0, 0.0), Vec3::X)).valid);
        }
        assert!(!prepared(Vec3::ZERO).valid);
        assert!(!prepared(Vec3::splat(1e-39)).valid);
        let limited = |t_min, t_max| {
            PreparedRay::new(&Ray {
                t_min,
                t_max,
                ..Ray::new(Vec3::ZERO, Vec3::X)
            })
        };
        assert!(!limited(f32::NAN, 1.0).valid);
        assert!(!limited(0.0, f32::NAN).valid);
        assert!(!limited(2.0, 1.0).valid);
        assert!(!limited(-2.0, -1.0).valid);
        assert!(limited(1.0, 1.0).valid);
        assert!(limited(0.0, f32::INFINITY).valid);
    }

    #[test]
    fn limits_are_scaled_with_the_direction() {
        let ray = PreparedRay::new(&Ray {
            t_min: 1.0,
            t_max: 3.0,
            ..Ray::new(Vec3::ZERO, Vec3::X * 8.0)
        });
        assert_eq!((ray.t_min, ray.t_max, ray.scale), (8.0, 24.0, 0.125));
    }
}
