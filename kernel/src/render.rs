//! The picture.

use glam::{UVec3, Vec3Swizzles, Vec4};
use oktant_shared::frame::Frame;
use oktant_shared::octree::Node;
use oktant_shared::render::render_pixel;
use oktant_shared::scene::Scene;
use oktant_shared::traversal::Standard;
use oktant_shared::triangle::{Triangle, Vertex};
use spirv_std::spirv;

/// Adds this pass's samples to each pixel of `picture`, row by row from the upper left; the first pass overwrites.
#[spirv(compute(threads(8, 8), entry_point_name = "render"))]
pub fn render(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[Node],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Triangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] vertices: &[Vertex],
    #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &Frame,
    #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] picture: &mut [Vec4],
) {
    let pixel = id.xy();
    if pixel.x < frame.camera.width && pixel.y < frame.camera.height {
        let scene = Scene {
            root: frame.root,
            nodes,
            references,
            triangles,
            vertices,
        };
        let color = render_pixel::<Standard>(frame, &scene, pixel);
        let index = (pixel.y * frame.camera.width + pixel.x) as usize;
        if frame.first_sample == 0 {
            picture[index] = color;
        } else {
            picture[index] += color;
        }
    }
}
