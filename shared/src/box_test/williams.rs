//! Slabs with reciprocals and signs made beforehand.

use super::{BoxTest, EXIT_SLACK, Interval, parallel_slab};
use crate::aabb::Aabb;
use crate::arithmetic::{max, min};
use crate::ray::PreparedRay;
use glam::Vec3;

/// A. Williams, S. Barrus, R. K. Morley, P. Shirley, "An efficient and robust ray-box intersection algorithm", JGT 10(1),
/// 2005: reciprocals and signs are computed once for each ray, the sign says which face is near.
///
/// Deviations: an axis along which the ray does not move is decided by comparison, for the paper's infinite reciprocal
/// gives NaN on a face and opens the box; the exit is rounded up (see [`EXIT_SLACK`]).
#[derive(Clone, Copy, Debug)]
pub struct Williams {
    origin: Vec3,
    /// Zero where the direction is.
    reciprocal: Vec3,
}

impl BoxTest for Williams {
    #[inline]
    fn prepare(ray: &PreparedRay) -> Self {
        Williams {
            origin: ray.origin,
            reciprocal: Vec3::new(
                reciprocal(ray.direction.x),
                reciprocal(ray.direction.y),
                reciprocal(ray.direction.z),
            ),
        }
    }

    #[inline]
    fn interval(&self, aabb: &Aabb) -> Interval {
        let x = slab(self.origin.x, self.reciprocal.x, aabb.low.x, aabb.high.x);
        let y = slab(self.origin.y, self.reciprocal.y, aabb.low.y, aabb.high.y);
        let z = slab(self.origin.z, self.reciprocal.z, aabb.low.z, aabb.high.z);
        Interval {
            enter: max(x.enter, max(y.enter, z.enter)),
            exit: min(x.exit, min(y.exit, z.exit)) * EXIT_SLACK,
        }
    }
}

#[inline]
fn reciprocal(component: f32) -> f32 {
    if component == 0.0 { 0.0 } else { 1.0 / component }
}

#[inline]
fn slab(origin: f32, reciprocal: f32, low: f32, high: f32) -> Interval {
    if reciprocal == 0.0 {
        parallel_slab(origin, low, high)
    } else {
        let backwards = reciprocal < 0.0;
        let near = if backwards { high } else { low };
        let far = if backwards { low } else { high };
        Interval {
            enter: (near - origin) * reciprocal,
            exit: (far - origin) * reciprocal,
        }
    }
}
