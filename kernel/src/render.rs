//! The picture, and what each pixel sees.

use glam::{UVec3, UVec4, Vec2, Vec4, uvec2};
use oktant_shared::adaptive::{Mark, of_entry, samples_at};
use oktant_shared::buffer::{load, store};
use oktant_shared::frame::Frame;
use oktant_shared::general::General;
use oktant_shared::light::Light;
use oktant_shared::material::Material;
use oktant_shared::plane::Plane;
use oktant_shared::render::{Pixel, hit_pixel, looks, render_sample};
use oktant_shared::sampling::Batch;
use oktant_shared::scene::{Appearance, Scene, World};
use oktant_shared::texture::Texture;
use oktant_shared::traversal::Standard;
use oktant_shared::triangle::Vertex;
use oktant_shared::variant::{EVERYTHING, MIRRORED, OPAQUE, PLAIN};
use spirv_std::spirv;

/// Workgroups of a row of a dispatch over a list: devices allow 65,535 along an axis.
const ROW: u32 = 32_768;
/// Invocations of a workgroup.
const GROUP: u32 = 128;

/// An entry point that looks at pixels: `$inputs` are its arguments beside the scene, `$body` what it does with `$frame` and
/// `$world`.
macro_rules! pixels {
    (
        $doc:literal, $entry:literal, $name:ident, { $($inputs:tt)+ },
        $frame:ident $world:ident $body:block
    ) => {
        #[doc = $doc]
        #[spirv(compute(threads(8, 16), entry_point_name = $entry))]
        pub fn $name(
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] nodes: &[UVec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] references: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] triangles: &[Vec4],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] ids: &[u32],
            #[spirv(uniform, descriptor_set = 1, binding = 0)] $frame: &Frame,
            #[spirv(storage_buffer, descriptor_set = 3, binding = 0)] vertices: &[Vertex],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 1)] coordinates: &[Vec2],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 2)] material_ids: &[u32],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 3)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 4)] lights: &[Light],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 5)] planes: &[Plane],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 6)] textures: &[Texture],
            #[spirv(storage_buffer, descriptor_set = 3, binding = 7)] texels: &[u32],
            $($inputs)+
        ) {
            let $world = World {
                scene: Scene {
                    root: $frame.root,
                    nodes,
                    references,
                    triangles,
                    ids,
                    parts: $frame.parts(),
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
            $body
        }
    };
}

/// An entry point that renders with a traversal what some needs have.
macro_rules! renders {
    ($doc:literal, $entry:literal, $name:ident, $traversal:ty, $needs:expr) => {
        pixels!(
            $doc, $entry, $name,
            {
                #[spirv(global_invocation_id)] id: UVec3,
                #[spirv(workgroup_id)] group: UVec3,
                #[spirv(local_invocation_index)] invocation: u32,
                #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] picture: &mut [Vec4],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] work: &mut [Vec4],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 2)] marks: &mut [Mark],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 3)] list: &[u32],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 4)] count: &[u32],
            },
            frame world {
                let size = frame.size();
                let mut pixel = uvec2(id.x, id.y + frame.first_row);
                let mut batch = Batch::of_frame(frame);
                let mut is_there = (pixel.x < size.x) & (pixel.y < size.y);
                if frame.is_listed != 0 {
                    let place = frame.first_listed + (group.y * ROW + group.x) * GROUP + invocation;
                    is_there = place < load(count, 0);
                    if is_there {
                        let (index, level) = of_entry(load(list, place));
                        pixel = uvec2(index % size.x, index / size.x);
                        batch = samples_at(level).among(frame);
                        is_there = batch.count != 0;
                    }
                }
                if is_there {
                    let index = pixel.y * size.x + pixel.x;
                    let mut number = 0;
                    loop {
                        let one = render_sample::<$traversal, { $needs }>(frame, &world, pixel, &batch, number);
                        add(frame, &batch, number, index, one, picture, work, marks);
                        number += 1;
                        if number >= looks(frame, &batch) {
                            break;
                        }
                    }
                }
            }
        );
    };
}

/// Adds what a look brought to the pixel, in memory: kept in registers, the sums would leave room for fewer threads while rays are
/// traced. The first pass overwrites, and so does each first pass over a list, but of the work. `work` and `marks` may hold
/// fewer pixels, or none.
fn add(
    frame: &Frame,
    batch: &Batch,
    number: u32,
    index: u32,
    pixel: Pixel,
    picture: &mut [Vec4],
    work: &mut [Vec4],
    marks: &mut [Mark],
) {
    let is_first = (batch.first == 0) & (number == 0);
    add_to(picture, index, is_first, pixel.sum);
    add_to(work, index, is_first & (frame.is_listed == 0), pixel.work);
    if index < marks.len() as u32 {
        let before = load(marks, index);
        let mark = if number == 0 {
            pixel.mark.after(before, batch)
        } else {
            before.and(&pixel.mark, batch, number)
        };
        store(marks, index, mark);
    }
}

fn add_to(sums: &mut [Vec4], index: u32, is_first: bool, term: Vec4) {
    if index < sums.len() as u32 {
        let before = if is_first { Vec4::ZERO } else { load(sums, index) };
        store(sums, index, before + term);
    }
}

renders!(
    "Adds this pass's samples to each pixel of `picture`, row by row from the upper left, what they cost to `work`, and what \
     adaptive sampling wants to know of them to `marks`; of the pixels that are listed, or of all: of scenes with no more \
     than one light and one plain material.",
    "render_plain",
    render_plain,
    Standard,
    PLAIN
);

renders!(
    "As `render_plain`, of scenes without mirrors and glass.",
    "render_opaque",
    render_opaque,
    Standard,
    OPAQUE
);

renders!(
    "As `render_plain`, of scenes without glass.",
    "render_mirrors",
    render_mirrors,
    Standard,
    MIRRORED
);

renders!(
    "As `render_plain`, of any scene.",
    "render",
    render,
    Standard,
    EVERYTHING
);

renders!(
    "As `render`, with the parts that the frame names.",
    "render_general",
    render_general,
    General,
    EVERYTHING
);

pixels!(
    "Writes the nearest hit of the first sample of each pixel to `hits`, row by row from the upper left.",
    "hits", hits,
    {
        #[spirv(global_invocation_id)] id: UVec3,
        #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] hits: &mut [UVec4],
    },
    frame world {
        let size = frame.size();
        let index = id.y * size.x + id.x;
        if (id.x < size.x) & (id.y < size.y) & (index < hits.len() as u32) {
            store(hits, index, hit_pixel::<Standard>(frame, &world, uvec2(id.x, id.y)).row());
        }
    }
);
