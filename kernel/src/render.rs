//! The picture, and what each pixel sees.

use glam::{UVec3, UVec4, Vec2, Vec4, uvec2};
use oktant_shared::buffer::{load, store};
use oktant_shared::frame::Frame;
use oktant_shared::general::General;
use oktant_shared::hit::Hit;
use oktant_shared::light::Light;
use oktant_shared::material::Material;
use oktant_shared::plane::Plane;
use oktant_shared::render::{Pixel, hit_pixel, render_pixel};
use oktant_shared::scene::{Appearance, Scene, World};
use oktant_shared::texture::Texture;
use oktant_shared::traversal::Standard;
use oktant_shared::triangle::Vertex;
use spirv_std::spirv;

/// An entry point that looks at a pixel: `$of` makes a value from the frame, the world and the pixel, `$store` puts it
/// into the output.
macro_rules! pixels {
    (
        $doc:literal, $entry:literal, $name:ident, $of:expr,
        { $($binding:literal $output:ident: $kind:ty),+ } $store:expr
    ) => {
        #[doc = $doc]
        #[spirv(compute(threads(8, 8), entry_point_name = $entry))]
        pub fn $name(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[UVec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Vec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] ids: &[u32],
            #[spirv(uniform, descriptor_set = 1, binding = 0)] frame: &Frame,
            $(#[spirv(storage_buffer, descriptor_set = 2, binding = $binding)] $output: &mut [$kind],)+
            #[spirv(storage_buffer, descriptor_set = 3, binding = 0)] vertices: &[Vertex],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 1)] coordinates: &[Vec2],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 2)] material_ids: &[u32],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 3)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 4)] lights: &[Light],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 5)] planes: &[Plane],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 6)] textures: &[Texture],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 7)] texels: &[u32],
        ) {
            let pixel = uvec2(id.x, id.y + frame.first_row);
            let size = frame.size();
            if (pixel.x < size.x) & (pixel.y < size.y) {
                let world = World {
                    scene: Scene {
                        root: frame.root,
                        nodes,
                        references,
                        triangles,
                        ids,
                        parts: frame.parts(),
                    },
                    appearance: Appearance {
                        vertices,
                        coordinates,
                        material_ids,
                        materials,
                        lights,
                        planes,
                        textures,
                        texels,
                    },
                };
                let index = pixel.y * size.x + pixel.x;
                $store(frame, index, $of(frame, &world, pixel), $($output),+);
            }
        }
    };
}

/// Adds to the pixel; the first pass overwrites. `work` may hold fewer pixels, or none.
fn add(frame: &Frame, index: u32, pixel: Pixel, picture: &mut [Vec4], work: &mut [Vec4]) {
    add_to(picture, index, frame.first_sample == 0, pixel.sum);
    add_to(work, index, frame.first_sample == 0, pixel.work);
}

fn add_to(sums: &mut [Vec4], index: u32, is_first: bool, term: Vec4) {
    if index < sums.len() as u32 {
        let before = if is_first { Vec4::ZERO } else { load(sums, index) };
        store(sums, index, before + term);
    }
}

fn put(_: &Frame, index: u32, hit: Hit, hits: &mut [UVec4]) {
    if index < hits.len() as u32 {
        store(hits, index, hit.row());
    }
}

pixels!(
    "Adds this pass's samples to each pixel of `picture`, row by row from the upper left, and what they cost to `work`: \
     of scenes with no more than one light and one plain material.",
    "render_plain",
    render_plain,
    render_pixel::<Standard, false>,
    { 0 picture: Vec4, 1 work: Vec4 } add
);

pixels!(
    "Adds this pass's samples to each pixel of `picture`, row by row from the upper left, and what they cost to `work`: \
     of any scene.",
    "render",
    render,
    render_pixel::<Standard, true>,
    { 0 picture: Vec4, 1 work: Vec4 } add
);

pixels!(
    "Writes the nearest hit of the first sample of each pixel to `hits`, row by row from the upper left.",
    "hits",
    hits,
    hit_pixel::<Standard>,
    { 0 hits: UVec4 } put
);

pixels!(
    "As `render`, with the parts that the frame names.",
    "render_general",
    render_general,
    render_pixel::<General, true>,
    { 0 picture: Vec4, 1 work: Vec4 } add
);
