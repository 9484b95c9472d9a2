//! A ray against all that there is: triangles and planes.

use crate::buffer::load;
use crate::frame::Frame;
use crate::hit::Hit;
use crate::plane::PLANE;
use crate::ray::Ray;
use crate::scene::World;
use crate::traversal::Traversal;

/// The nearest hit; of equal ones, a triangle comes before a plane. With `FULL` false there are no planes.
#[inline]
pub fn closest_hit<V: Traversal, const FULL: bool>(frame: &Frame, world: &World<'_>, ray: &Ray) -> Hit {
    if !FULL {
        return V::closest_hit(&world.scene, ray);
    }
    // Planes first: beyond them no triangle needs to be looked for.
    let mut plane = Hit::miss(ray.t_max);
    let mut i = 0;
    while i < frame.plane_count {
        let t = load(world.appearance.planes, i).crossing(ray);
        let is_nearer = if plane.is_hit() { t < plane.t } else { t <= plane.t };
        if t >= 0.0 && t >= ray.t_min && is_nearer {
            plane = Hit {
                t,
                triangle: PLANE | i,
                u: 0.0,
                v: 0.0,
            };
        }
        i += 1;
    }
    let hit = V::closest_hit(&world.scene, &Ray { t_max: plane.t, ..*ray });
    if hit.is_hit() { hit } else { plane }
}

/// Whether there is a hit. With `FULL` false there are no planes.
#[inline]
pub fn any_hit<V: Traversal, const FULL: bool>(frame: &Frame, world: &World<'_>, ray: &Ray) -> bool {
    if FULL {
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
