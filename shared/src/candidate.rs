//! A triangle that a traversal has come upon.

use crate::buffer::load;
use crate::hit::Hit;
use crate::ray::PreparedRay;
use crate::scene::Scene;
use crate::triangle_test::{Crossing, TriangleTest};

/// Puts the crossing with the triangle at `slot` into `best` if it is at `t_min` or beyond and nearer, or as near and of
/// a lower id.
#[inline(always)]
pub fn nearer<T: TriangleTest>(scene: &Scene<'_>, test: &T, slot: u32, t_min: f32, best: &mut Hit) {
    nearer_of(scene, test.crossing_at(scene, slot), slot, t_min, best);
}

/// [`nearer`] where the crossing is known.
#[inline(always)]
pub fn nearer_of(scene: &Scene<'_>, crossing: Crossing, slot: u32, t_min: f32, best: &mut Hit) {
    if crossing.crosses & (crossing.t >= t_min) & (crossing.t <= best.t) {
        let mut wins = (crossing.t < best.t) | !best.is_hit();
        if !wins {
            wins = load(scene.ids, slot) < load(scene.ids, best.triangle);
        }
        if wins {
            *best = Hit {
                t: crossing.t,
                triangle: slot,
                u: crossing.u,
                v: crossing.v,
            };
        }
    }
}

/// Whether the ray crosses the triangle at `slot` within its limits.
#[inline(always)]
pub fn within<T: TriangleTest>(scene: &Scene<'_>, test: &T, slot: u32, ray: &PreparedRay) -> bool {
    is_within(test.crossing_at(scene, slot), ray)
}

/// [`within`] where the crossing is known.
#[inline(always)]
pub fn is_within(crossing: Crossing, ray: &PreparedRay) -> bool {
    crossing.crosses & (crossing.t >= ray.t_min) & (crossing.t <= ray.t_max)
}
