//! Arrays of rays on a GPU: what an invocation or a workgroup does, and the entry points of all combinations that are
//! offered.
//!
//! rust-gpu names an entry point by the path of its function, so [`cast_standard`](crate::cast_standard) and
//! [`cast_others`](crate::cast_others) make them at the root of a crate. They are in modules of their own, because a driver
//! reads all of a module before it makes a pipeline, and most scenes need the first alone.

use crate::brute::{Tile, Together, Workgroup};
use crate::buffer::store;
use crate::hit::Hit;
use crate::pixels::ROW;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::traversal::Traversal;
use glam::{UVec3, UVec4, Vec4};

/// Threads of a workgroup.
const LINE: u32 = 64;

/// An entry point that takes `$inputs` beside the buffers, and calls `$cast` with `$arguments`, the scene, the rays and where
/// the hits go.
#[doc(hidden)]
#[macro_export]
macro_rules! cast {
    ($doc:literal, $name:ident, { $($inputs:tt)* } $cast:ident, $kind:ty, $($arguments:ident)+) => {
        #[doc = $doc]
        #[spirv_std::spirv(compute(threads(64)))]
        pub fn $name(
            $($inputs)*
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[glam::UVec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[glam::Vec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] ids: &[u32],
            #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &$crate::frame::Frame,
            #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] hits: &mut [glam::UVec4],
            #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] rays: &[glam::Vec4],
        ) {
            let scene = $crate::scene::Scene {
                root: frame.root,
                nodes,
                references,
                triangles,
                ids,
                parts: 0,
            };
            $crate::cast::$cast::<$kind>($($arguments,)+ &scene, rays, hits);
        }
    };
}

/// The entry points of a combination: by [`Brute`](crate::brute::Brute) the rays of a workgroup together, by all others
/// each ray on its own.
#[doc(hidden)]
#[macro_export]
macro_rules! cast_with {
    (Brute, $kind:ty, $doc:literal, $name:ident, $alone:ident $together:ident) => {
        $crate::cast!($doc, $name, {
            #[spirv(workgroup_id)] group: glam::UVec3,
            #[spirv(local_invocation_index)] invocation: u32,
            #[spirv(workgroup)] tile: &mut $crate::brute::Tile,
        } $together, $kind, group invocation tile);
    };
    ($traversal:ident, $kind:ty, $doc:literal, $name:ident, $alone:ident $together:ident) => {
        $crate::cast!($doc, $name, {
            #[spirv(global_invocation_id)] id: glam::UVec3,
        } $alone, $kind, id);
    };
}

/// Whether there is a ray at an index, and a place for its hit.
fn is_there(index: u32, rays: &[Vec4], hits: &[UVec4]) -> bool {
    (index < hits.len() as u32) & (2 * index + 1 < rays.len() as u32)
}

/// Writes the nearest hit of the invocation's ray.
pub fn closest<V: Traversal>(id: UVec3, scene: &Scene<'_>, rays: &[Vec4], hits: &mut [UVec4]) {
    let index = id.y * (ROW * LINE) + id.x;
    if is_there(index, rays, hits) {
        let hit = V::closest_hit(scene, &Ray::of_rows(rays, index));
        store(hits, index, scene.identified(hit).row());
    }
}

/// Writes a hit on triangle 0 if the invocation's ray hits anything, else a miss.
pub fn any<V: Traversal>(id: UVec3, scene: &Scene<'_>, rays: &[Vec4], hits: &mut [UVec4]) {
    let index = id.y * (ROW * LINE) + id.x;
    if is_there(index, rays, hits) {
        let ray = Ray::of_rows(rays, index);
        store(hits, index, answer(V::any_hit(scene, &ray), &ray).row());
    }
}

/// A hit at 0 on triangle 0, or a miss.
fn answer(is_hit: bool, ray: &Ray) -> Hit {
    if is_hit {
        Hit {
            t: 0.0,
            triangle: 0,
            ..Hit::miss(0.0)
        }
    } else {
        Hit::miss(ray.t_max)
    }
}

/// As [`closest`], the rays of a workgroup together.
pub fn closest_together<V: Together>(
    group: UVec3,
    invocation: u32,
    tile: &mut Tile,
    scene: &Scene<'_>,
    rays: &[Vec4],
    hits: &mut [UVec4],
) {
    let first = (group.y * ROW + group.x) * LINE;
    // The same for the whole workgroup: all of it waits in there, or none.
    if is_there(first, rays, hits) {
        let index = first + invocation;
        let is_there = is_there(index, rays, hits);
        // Beyond the end the first ray once more, for nobody.
        let ray = Ray::of_rows(rays, if is_there { index } else { first });
        let hit = V::closest_hit_together(scene, &ray, Workgroup::<LINE> { tile, invocation });
        if is_there {
            store(hits, index, scene.identified(hit).row());
        }
    }
}

/// As [`any`], the rays of a workgroup together.
pub fn any_together<V: Together>(
    group: UVec3,
    invocation: u32,
    tile: &mut Tile,
    scene: &Scene<'_>,
    rays: &[Vec4],
    hits: &mut [UVec4],
) {
    let first = (group.y * ROW + group.x) * LINE;
    // As above.
    if is_there(first, rays, hits) {
        let index = first + invocation;
        let is_there = is_there(index, rays, hits);
        let ray = Ray::of_rows(rays, if is_there { index } else { first });
        let is_hit = V::any_hit_together(scene, &ray, Workgroup::<LINE> { tile, invocation });
        if is_there {
            store(hits, index, answer(is_hit, &ray).row());
        }
    }
}

/// The entry points of the default parts, the first of [`offered_parts`](crate::offered_parts).
#[macro_export]
macro_rules! cast_standard {
    ($traversal:ident $triangle:ident $box_test:ident $closest:ident $any:ident $kind:ty; $($others:tt)*) => {
        $crate::cast_both!($traversal $closest $any $kind);
    };
}

/// The entry points of all others.
#[macro_export]
macro_rules! cast_others {
    (
        $first:ident $first_triangle:ident $first_box_test:ident $first_closest:ident $first_any:ident $first_kind:ty;
        $($traversal:ident $triangle:ident $box_test:ident $closest:ident $any:ident $kind:ty;)+
    ) => {
        $($crate::cast_both!($traversal $closest $any $kind);)+
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! cast_both {
    ($traversal:ident $closest:ident $any:ident $kind:ty) => {
        $crate::cast_with!($traversal, $kind, "Writes the nearest hit of each ray.", $closest, closest closest_together);
        $crate::cast_with!(
            $traversal, $kind, "Writes for each ray triangle 0 if anything is hit, else a miss.", $any, any any_together
        );
    };
}
