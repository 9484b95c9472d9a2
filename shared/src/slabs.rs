//! A ray against planes across the axes, one multiplication and one addition each.

use crate::aabb::Aabb;
use crate::arithmetic::{greater, lesser, multiply_add};
use crate::box_test::Interval;
use crate::ray::PreparedRay;
use glam::Vec3;

/// A plane at `p` is crossed at `p * reciprocal + offset`.
///
/// The product form loses the digits that origin and plane have in common: boxes must be wider by the bound of
/// [`crate::octants::MARGIN`].
#[derive(Clone, Copy, Debug)]
pub struct Slabs {
    /// Of the direction; of a component below 2^-60 that of 2^-60, positive.
    pub reciprocal: Vec3,
    /// Minus the origin times the reciprocal.
    pub offset: Vec3,
    /// Axes along which the ray runs against the coordinates; bit 0 is x.
    pub octant: u32,
}

/// Direction components smaller than this count as this: over the cube's diagonal the ray moves sideways by less than its
/// coordinates resolve.
pub const LEAST_SLOPE: f32 = 1.0 / (1_u64 << 60) as f32;

impl Slabs {
    /// Does the work that is done once for each ray.
    #[inline(always)]
    pub fn new(ray: &PreparedRay) -> Self {
        let reciprocal = Vec3::new(
            reciprocal(ray.direction.x),
            reciprocal(ray.direction.y),
            reciprocal(ray.direction.z),
        );
        let x = if reciprocal.x < 0.0 { 1 } else { 0 };
        let y = if reciprocal.y < 0.0 { 2 } else { 0 };
        let z = if reciprocal.z < 0.0 { 4 } else { 0 };
        Slabs {
            reciprocal,
            offset: -ray.origin * reciprocal,
            octant: x | y | z,
        }
    }

    /// Where the ray is inside a box, but for rounding.
    #[inline(always)]
    pub fn interval(&self, aabb: &Aabb) -> Interval {
        let x = slab(aabb.low.x, aabb.high.x, self.reciprocal.x, self.offset.x);
        let y = slab(aabb.low.y, aabb.high.y, self.reciprocal.y, self.offset.y);
        let z = slab(aabb.low.z, aabb.high.z, self.reciprocal.z, self.offset.z);
        Interval {
            enter: greater(greater(x.enter, y.enter), z.enter),
            exit: lesser(lesser(x.exit, y.exit), z.exit),
        }
    }
}

#[inline(always)]
fn slab(low: f32, high: f32, reciprocal: f32, offset: f32) -> Interval {
    let low = multiply_add(low, reciprocal, offset);
    let high = multiply_add(high, reciprocal, offset);
    Interval {
        enter: lesser(low, high),
        exit: greater(low, high),
    }
}

#[inline(always)]
fn reciprocal(component: f32) -> f32 {
    let slope = if component.abs() < LEAST_SLOPE {
        LEAST_SLOPE
    } else {
        component
    };
    1.0 / slope
}
