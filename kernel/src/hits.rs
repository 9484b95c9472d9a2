//! What each pixel sees.

use glam::{UVec3, Vec3Swizzles};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::octree::Node;
use oktant_shared::render::hit_pixel;
use oktant_shared::scene::Scene;
use oktant_shared::traversal::Standard;
use oktant_shared::triangle::{Triangle, Vertex};
use spirv_std::spirv;

/// Writes the nearest hit of the first sample of each pixel to `hits`, row by row from the upper left.
#[spirv(compute(threads(8, 8), entry_point_name = "hits"))]
pub fn hits(
    #[spirv(global_invocation_id)] id: UVec3,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[Node],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Triangle],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] vertices: &[Vertex],
    #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &Frame,
    #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] hits: &mut [Hit],
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
        let index = (pixel.y * frame.camera.width + pixel.x) as usize;
        hits[index] = hit_pixel::<Standard>(frame, &scene, pixel);
    }
}
