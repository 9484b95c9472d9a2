//! Arrays of rays.

use glam::UVec3;
use oktant_shared::box_test::{KayKajiya, Williams};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::octree::Node;
use oktant_shared::ray::Ray;
use oktant_shared::revelles::Revelles;
use oktant_shared::scene::Scene;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{MollerTrumbore, Watertight};
use spirv_std::spirv;

/// Threads of a workgroup, and workgroups of a row of a dispatch: devices allow 65,535 along an axis.
const ROW: u32 = 64 * 32_768;

macro_rules! cast {
    ($name:ident, $entry:literal, $traversal:ty, $query:ident, $doc:literal) => {
        #[doc = $doc]
        #[spirv(compute(threads(64), entry_point_name = $entry))]
        pub fn $name(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[Node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Triangle],
            #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &Frame,
            #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] hits: &mut [Hit],
            #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] rays: &[Ray],
        ) {
            let index = (id.y * ROW + id.x) as usize;
            if index < hits.len() && index < rays.len() {
                let scene = Scene {
                    root: frame.root,
                    nodes,
                    references,
                    triangles,
                };
                hits[index] = $query::<$traversal>(&scene, &rays[index]);
            }
        }
    };
}

fn closest<V: Traversal>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    V::closest_hit(scene, ray)
}

/// A hit at 0 on triangle 0, or a miss.
fn any<V: Traversal>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    if V::any_hit(scene, ray) {
        Hit {
            t: 0.0,
            triangle: 0,
            ..Hit::miss(0.0)
        }
    } else {
        Hit::miss(ray.t_max)
    }
}

cast!(
    closest_kay_kajiya_watertight,
    "closest_kay_kajiya_watertight",
    Revelles<KayKajiya, Watertight>,
    closest,
    "Writes the nearest hit of each ray."
);
cast!(
    any_kay_kajiya_watertight,
    "any_kay_kajiya_watertight",
    Revelles<KayKajiya, Watertight>,
    any,
    "Writes for each ray triangle 0 if anything is hit, else a miss."
);
cast!(
    closest_williams_moller_trumbore,
    "closest_williams_moller_trumbore",
    Revelles<Williams, MollerTrumbore>,
    closest,
    "Writes the nearest hit of each ray."
);
cast!(
    any_williams_moller_trumbore,
    "any_williams_moller_trumbore",
    Revelles<Williams, MollerTrumbore>,
    any,
    "Writes for each ray triangle 0 if anything is hit, else a miss."
);
