//! Functions of `oktant-shared` one by one, of which the program asks the device about its arithmetic.

use glam::{UVec3, Vec4, Vec4Swizzles, vec4};
use oktant_shared::aabb::Aabb;
use oktant_shared::arithmetic::{difference_of_products, fused_multiply_add, min, multiply_subtract};
use oktant_shared::box_test::{BoxTest, KayKajiya, Williams};
use oktant_shared::ray::{PreparedRay, Ray};
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
