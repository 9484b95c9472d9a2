//! Rounds of adaptive sampling: which pixels are to be traced anew.

use glam::{UVec3, Vec4, uvec2};
use oktant_shared::adaptive::{Choice, Known, Mark, UNKNOWN, choose, entry};
use oktant_shared::buffer::{get, place, put, store};
use oktant_shared::frame::Frame;
use spirv_std::arch::{atomic_i_add, workgroup_memory_barrier_with_group_sync};
use spirv_std::memory::{Scope, Semantics};
use spirv_std::spirv;

/// Invocations of a workgroup: they share a stretch of the list.
const GROUP: u32 = 64;

/// Decides about each pixel, writes those that are interpolated into `picture` and `marks`, and adds those that are to be
/// traced to the first `count[0]` of `list`.
#[spirv(compute(threads(8, 8), entry_point_name = "choose_pixels"))]
pub fn choose_pixels(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(local_invocation_index)] invocation: u32,
    #[spirv(workgroup)] listed: &mut [u32; GROUP as usize],
    #[spirv(workgroup)] first: &mut [u32; 1],
    #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &Frame,
    #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] picture: &mut [Vec4],
    #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] marks: &mut [Mark],
    #[spirv(storage_buffer, descriptor_set = 2, binding = 2)] list: &mut [u32],
    #[spirv(storage_buffer, descriptor_set = 2, binding = 3)] count: &mut [u32],
) {
    let size = frame.size();
    let index = id.y * size.x + id.x;
    let mut choice = Choice::NOTHING;
    if (id.x < size.x) & (id.y < size.y) {
        let known = Known { marks, sums: picture };
        choice = choose(frame, &known, uvec2(id.x, id.y));
    }
    if choice.is_interpolated {
        store(picture, index, choice.sum);
        store(marks, index, choice.mark);
    }
    let is_listed = if choice.level == UNKNOWN { 0 } else { 1 };
    put(listed, invocation, is_listed);
    workgroup_memory_barrier_with_group_sync();
    // Each counts those before it: a sum in a tree would need more barriers than it saves loads.
    let mut before = 0;
    let mut other = 0;
    loop {
        before += if other < invocation { get(listed, other) } else { 0 };
        other += 1;
        if other == GROUP {
            break;
        }
    }
    let all = before + is_listed;
    if (invocation == GROUP - 1) & (all != 0) {
        // SAFETY: `count` has one element, and only this changes it. naga wants the sum to be made after the loop.
        let start = unsafe {
            atomic_i_add::<u32, { Scope::QueueFamily as u32 }, { Semantics::NONE.bits() }>(place(count, 0), all)
        };
        put(first, 0, start);
    }
    workgroup_memory_barrier_with_group_sync();
    if is_listed != 0 {
        store(list, get(first, 0) + before, entry(index, choice.level));
    }
}
