//! Functions of `oktant-shared` one by one, so that tests can compare the two sides.

use glam::{UVec3, Vec4, Vec4Swizzles, vec4};
use oktant_shared::aabb::Aabb;
use oktant_shared::arithmetic::{difference_of_products, fused_multiply_add, min, multiply_subtract};
use oktant_shared::box_test::{BoxTest, KayKajiya, Williams};
use oktant_shared::color::{linear_color, srgb_from_linear};
use oktant_shared::hit::Hit;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::secondary_origin::secondary_origin;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{BaldwinWeber, MollerTrumbore, Plucker, TriangleTest, Watertight};
use spirv_std::spirv;

/// Of `(a, b, c, d)`: `fma(a, b, c)`, `a b - c d`, `c - a b` and the smaller of `a` and `b`.
#[spirv(compute(threads(64), entry_point_name = "probe_arithmetic"))]
pub fn probe_arithmetic(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] results: &mut [Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] operands: &[Vec4],
) {
    let index = id.x as usize;
    if index < results.len() && index < operands.len() {
        let o = operands[index];
        results[index] = vec4(
            fused_multiply_add(o.x, o.y, o.z),
            difference_of_products(o.x, o.y, o.z, o.w),
            multiply_subtract(o.x, o.y, o.z),
            min(o.x, o.y),
        );
    }
}

/// Of a ray and a box (two rows, `xyz` of each a corner): enter and exit by Kay-Kajiya, then by Williams.
#[spirv(compute(threads(64), entry_point_name = "probe_box_tests"))]
pub fn probe_box_tests(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] results: &mut [Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] rays: &[Ray],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] boxes: &[[Vec4; 2]],
) {
    let index = id.x as usize;
    if index < results.len() && index < rays.len() && index < boxes.len() {
        let ray = PreparedRay::new(&rays[index]);
        let corners = boxes[index];
        let aabb = Aabb {
            low: corners[0].xyz(),
            high: corners[1].xyz(),
        };
        let kay_kajiya = KayKajiya::prepare(&ray).interval(&aabb);
        let williams = Williams::prepare(&ray).interval(&aabb);
        results[index] = vec4(kay_kajiya.enter, kay_kajiya.exit, williams.enter, williams.exit);
    }
}

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
