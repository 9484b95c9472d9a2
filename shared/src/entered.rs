//! A ray where the scene begins.

use crate::arithmetic::{fused_multiply_add_vector, max};
use crate::box_test::{BoxTest, Interval};
use crate::hit::Hit;
use crate::ray::{PreparedRay, Ray};
use crate::scene::Scene;
use crate::slabs::Slabs;

/// A ray at the face of the cube around everything.
#[derive(Clone, Copy)]
pub struct Entered {
    /// The prepared ray, its origin advanced to shortly before the cube if that is far away.
    pub ray: PreparedRay,
    /// By how much the origin was advanced, in the prepared `t`.
    pub advance: f32,
    /// Whether the ray meets the cube within its limits.
    pub inside: bool,
}

/// Of the way to the root, the part that is not advanced: above the rounding error of the root's entry.
const KEPT_BACK: f32 = 1.0 / (1 << 20) as f32;

/// A ray that reaches the root within so many of its edge lengths is not advanced: its `t` resolves the cells anyway,
/// and a ray exactly through an edge stays so, where an advanced origin would be rounded off it.
pub const NEARBY: f32 = 4.0;

impl Entered {
    /// Prepares a ray and takes it to the cube, with the box test `B`.
    #[inline(always)]
    pub fn new<B: BoxTest>(scene: &Scene<'_>, ray: &Ray) -> Self {
        let ray = PreparedRay::new(ray);
        let interval = B::prepare_in(scene, &ray).interval(&scene.root.aabb());
        Self::within(scene, ray, interval)
    }

    /// The same by slabs. The cube is wider than what is in it by more than their rounding errors, but for rays from so far
    /// away that f32 does not tell where they pass.
    #[inline(always)]
    pub fn by_slabs(scene: &Scene<'_>, ray: &Ray) -> Self {
        let ray = PreparedRay::new(ray);
        let interval = Slabs::new(&ray).interval(&scene.root.aabb());
        Self::within(scene, ray, interval)
    }

    #[inline(always)]
    fn within(scene: &Scene<'_>, mut ray: PreparedRay, interval: Interval) -> Self {
        let Interval { enter, exit } = interval;
        let inside = ray.valid & (enter <= exit) & (exit >= ray.t_min) & (enter * (1.0 - KEPT_BACK) <= ray.t_max);
        // The prepared direction is 1 to 2 long along its main axis.
        let near_enter = enter * (1.0 - KEPT_BACK);
        let is_far = inside & (enter > NEARBY * scene.root.size());
        // A branch that a processor foresees: rays from nearby wait for none of this. On a GPU a choice costs less.
        #[cfg(not(target_arch = "spirv"))]
        if !is_far {
            return Entered {
                ray,
                advance: 0.0,
                inside,
            };
        }
        let advance = if is_far { near_enter } else { 0.0 };
        // Rounded once, the new origin is on the ray to the last place even if the old one is far away.
        ray.origin = fused_multiply_add_vector(advance, ray.direction, ray.origin);
        ray.t_min = max(ray.t_min - advance, 0.0);
        ray.t_max -= advance;
        Entered { ray, advance, inside }
    }

    /// What was found, in the `t` of the ray as it was given.
    #[inline(always)]
    pub fn left(&self, given: &Ray, best: Hit) -> Hit {
        if best.is_hit() {
            Hit {
                t: (best.t + self.advance) * self.ray.scale,
                ..best
            }
        } else {
            Hit::miss(given.t_max)
        }
    }
}
