//! Slabs as in 1986.

use super::{BoxTest, EXIT_SLACK, Interval, parallel_slab};
use crate::aabb::Aabb;
use crate::arithmetic::{max, min};
use crate::ray::PreparedRay;
use glam::Vec3;

/// T. L. Kay and J. T. Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986: divide per slab, order the two distances,
/// intersect the intervals.
///
/// Deviation: the exit is rounded up (see [`EXIT_SLACK`]).
#[derive(Clone, Copy, Debug)]
pub struct KayKajiya {
    origin: Vec3,
    direction: Vec3,
}

impl BoxTest for KayKajiya {
    #[inline]
    fn prepare(ray: &PreparedRay) -> Self {
        KayKajiya {
            origin: ray.origin,
            direction: ray.direction,
        }
    }

    #[inline]
    fn interval(&self, aabb: &Aabb) -> Interval {
        let x = slab(self.origin.x, self.direction.x, aabb.low.x, aabb.high.x);
        let y = slab(self.origin.y, self.direction.y, aabb.low.y, aabb.high.y);
        let z = slab(self.origin.z, self.direction.z, aabb.low.z, aabb.high.z);
        Interval {
            enter: max(x.enter, max(y.enter, z.enter)),
            exit: min(x.exit, min(y.exit, z.exit)) * EXIT_SLACK,
        }
    }
}

#[inline]
fn slab(origin: f32, direction: f32, low: f32, high: f32) -> Interval {
    if direction == 0.0 {
        parallel_slab(origin, low, high)
    } else {
        let a = (low - origin) / direction;
        let b = (high - origin) / direction;
        Interval {
            enter: min(a, b),
            exit: max(a, b),
        }
    }
}
