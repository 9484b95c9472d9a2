//! Entry points of oktant's GPU kernel, compiled to SPIR-V by rust-gpu.
#![cfg_attr(target_arch = "spirv", no_std)]

use glam::{UVec3, Vec4};
use spirv_std::spirv;

/// Writes `a[i] * b[i] + c[i]`, component by component, to `result[i]`.
///
/// Tests read from it whether a driver rounds once (a fused multiply-add) or twice.
#[spirv(compute(threads(64)))]
pub fn probe_fused_multiply_add(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] a: &[Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] b: &[Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] c: &[Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] result: &mut [Vec4],
) {
    let index = id.x as usize;
    if index < result.len() && index < a.len() && index < b.len() && index < c.len() {
        result[index] = a[index] * b[index] + c[index];
    }
}
