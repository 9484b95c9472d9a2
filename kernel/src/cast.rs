//! Arrays of rays.

use glam::{UVec3, UVec4, Vec4};
use oktant_shared::buffer::store;
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use oktant_shared::scene::Scene;
use oktant_shared::traversal::Traversal;
use spirv_std::spirv;

/// Threads of a workgroup, and workgroups of a row of a dispatch: devices allow 65,535 along an axis.
const ROW: u32 = 64 * 32_768;

macro_rules! cast {
    ($name:ident, $entry:literal, $traversal:ty, $query:ident, $doc:literal) => {
        #[doc = $doc]
        #[spirv(compute(threads(64), entry_point_name = $entry))]
        pub fn $name(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[UVec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Vec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] ids: &[u32],
            #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &Frame,
            #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] hits: &mut [UVec4],
            #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] rays: &[Vec4],
        ) {
            let index = id.y * ROW + id.x;
            if (index < hits.len() as u32) & (2 * index + 1 < rays.len() as u32) {
                let scene = Scene {
                    root: frame.root,
                    nodes,
                    references,
                    triangles,
                    ids,
                    parts: 0,
                };
                let hit = $query::<$traversal>(&scene, &Ray::of_rows(rays, index));
                store(hits, index, hit.row());
            }
        }
    };
}

fn closest<V: Traversal>(scene: &Scene<'_>, ray: &Ray) -> Hit {
    scene.identified(V::closest_hit(scene, ray))
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

macro_rules! cast_all {
    ($($traversal:ident $triangle:ident $box_test:ident $closest:ident $any:ident
        $closest_name:literal $any_name:literal $kind:ty;)+) => {$(
        cast!($closest, $closest_name, $kind, closest, "Writes the nearest hit of each ray.");
        cast!($any, $any_name, $kind, any, "Writes for each ray triangle 0 if anything is hit, else a miss.");
    )+};
}

oktant_shared::offered_parts!(cast_all);
