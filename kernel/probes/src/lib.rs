//! Functions of `oktant-shared` one by one, so that tests can compare the two sides.
//!
//! A module of its own: whatever is in the kernel is in every copy of the program.
#![cfg_attr(target_arch = "spirv", no_std)]

use glam::{UVec3, Vec4, vec4};
use oktant_shared::color::{linear_color, srgb_from_linear};
use oktant_shared::hit::Hit;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::secondary_origin::secondary_origin;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{BaldwinWeber, MollerTrumbore, Plucker, TriangleTest, Watertight};
use spirv_std::spirv;

macro_rules! probe_triangle_test {
    ($name:ident, $entry:literal, $test:ty) => {
        /// Of a ray and a triangle: `t`, `u`, `v` in the prepared ray, and 1 where they cross, else all 0.
        #[spirv(compute(threads(64), entry_point_name = $entry))]
        pub fn $name(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] results: &mut [Vec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] rays: &[Ray],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Triangle],
        ) {
            let index = id.x as usize;
            if index < results.len() && index < rays.len() && index < triangles.len() {
                let ray = PreparedRay::new(&rays[index]);
                let crossing = <$test>::prepare(&ray).crossing(&triangles[index]);
                results[index] = if crossing.crosses {
                    vec4(crossing.t, crossing.u, crossing.v, 1.0)
                } else {
                    Vec4::ZERO
                };
            }
        }
    };
}

probe_triangle_test!(probe_moller_trumbore, "probe_moller_trumbore", MollerTrumbore);
probe_triangle_test!(probe_watertight, "probe_watertight", Watertight);
probe_triangle_test!(probe_baldwin_weber, "probe_baldwin_weber", BaldwinWeber);
probe_triangle_test!(probe_plucker, "probe_plucker", Plucker);

/// Of a triangle and a hit: where a ray starts that leaves on the side of +Z.
#[spirv(compute(threads(64), entry_point_name = "probe_secondary_origin"))]
pub fn probe_secondary_origin(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] results: &mut [Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] hits: &[Hit],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Triangle],
) {
    let index = id.x as usize;
    if index < results.len() && index < hits.len() && index < triangles.len() {
        results[index] = secondary_origin(&triangles[index], &hits[index], glam::Vec3::Z).extend(0.0);
    }
}

/// Of the bits of `x` as a colour: linear RGB, and the sRGB code of its red.
#[spirv(compute(threads(64), entry_point_name = "probe_color"))]
pub fn probe_color(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] results: &mut [Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] colors: &[u32],
) {
    let index = id.x as usize;
    if index < results.len() && index < colors.len() {
        let linear = linear_color(colors[index]);
        results[index] = linear.extend(srgb_from_linear(linear.x));
    }
}
