//! A ray against all that there is: triangles and planes.

use crate::buffer::load;
use crate::frame::Frame;
use crate::hit::Hit;
use crate::plane::{PLANE, Plane};
use crate::ray::Ray;
use crate::scene::World;
use crate::traversal::Traversal;
use crate::variant::PLANES;

/// The nearest hit; of equal ones, a triangle comes before a plane. Planes are looked at only if `NEEDS` has them.
#[inline]
pub fn closest_hit<V: Traversal, const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Ray) -> Hit {
    if NEEDS & PLANES == 0 {
        return V::closest_hit(&world.scene, ray);
    }
    // Planes first: beyond them no triangle needs to be looked for.
    let plane = nearest_plane(world.appearance.planes, frame.plane_count, ray);
    let hit = V::closest_hit(&world.scene, &Ray { t_max: plane.t, ..*ray });
    if hit.is_hit() { hit } else { plane }
}

/// The nearest hit on the first `count` planes; a miss has the ray's `t_max`.
#[inline]
pub fn nearest_plane(planes: &[Plane], count: u32, ray: &Ray) -> Hit {
    let mut nearest = Hit::miss(ray.t_max);
    let mut i = 0;
    while i < count {
        let t = load(planes, i).crossing(ray);
        let is_nearer = if nearest.is_hit() {
            t < nearest.t
        } else {
            t <= nearest.t
        };
        if t >= 0.0 && t >= ray.t_min && is_nearer {
            nearest = Hit {
                t,
                triangle: PLANE | i,
                u: 0.0,
                v: 0.0,
            };
        }
        i += 1;
    }
    nearest
}

/// Whether there is a hit. Planes are looked at only if `NEEDS` has them.
#[inline]
pub fn any_hit<V: Traversal, const NEEDS: u32>(frame: &Frame, world: &World<'_>, ray: &Ray) -> bool {
    if NEEDS & PLANES != 0 {
        let mut i = 0;
        while i < frame.plane_count {
            let t = load(world.appearance.planes, i).crossing(ray);
            if t >= 0.0 && t >= ray.t_min && t <= ray.t_max {
                return true;
            }
            i += 1;
        }
    }
    V::any_hit(&world.scene, ray)
}
