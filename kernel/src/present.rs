//! The picture on the window's surface.

use glam::{Vec2, Vec4, Vec4Swizzles, vec2, vec4};
use oktant_shared::present::{Present, presented_color};
use spirv_std::spirv;

/// One triangle that covers the surface; three vertices, no buffers.
#[spirv(vertex(entry_point_name = "present_vertex"))]
pub fn present_vertex(#[spirv(vertex_index)] index: i32, #[spirv(position)] position: &mut Vec4) {
    let x = if index == 1 { 3.0 } else { -1.0 };
    let y = if index == 2 { 3.0 } else { -1.0 };
    *position = vec4(x, y, 0.0, 1.0);
}

/// The mean of each pixel's samples, linear RGB, with the overlay over it.
#[spirv(fragment(entry_point_name = "present_fragment"))]
pub fn present_fragment(
    #[spirv(frag_coord)] coordinates: Vec4,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] picture: &[Vec4],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] overlay: &[u32],
    #[spirv(uniform, descriptor_set = 0, binding = 2)] present: &Present,
    color: &mut Vec4,
) {
    let at: Vec2 = vec2(coordinates.xy().x, coordinates.xy().y);
    *color = presented_color(present, picture, overlay, at);
}
