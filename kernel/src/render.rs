//! The picture, and what each pixel sees.

use glam::{UVec3, UVec4, Vec4, uvec2};
use oktant_shared::adaptive::Mark;
use oktant_shared::buffer::{load, store};
use oktant_shared::general::General;
use oktant_shared::pixels;
use oktant_shared::render::{Pixel, hit_pixel, looks, render_sample};
use oktant_shared::sampling::Batch;
use oktant_shared::traversal::Standard;
use oktant_shared::variant::{EVERYTHING, MIRRORED, OPAQUE, PLAIN};

/// An entry point that renders with a traversal what some needs have.
macro_rules! renders {
    ($doc:literal, $entry:literal, $name:ident, $traversal:ty, $needs:expr) => {
        pixels!(
            $doc, $entry, $name,
            {
                #[spirv(global_invocation_id)] id: UVec3,
                #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] picture: &mut [Vec4],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] work: &mut [Vec4],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 2)] marks: &mut [Mark],
            },
            frame world {
                let size = frame.size();
                let pixel = uvec2(id.x, id.y + frame.first_row);
                if (pixel.x < size.x) & (pixel.y < size.y) {
                    let batch = Batch::of_frame(frame);
                    let index = pixel.y * size.x + pixel.x;
                    let mut number = 0;
                    loop {
                        let one = render_sample::<$traversal, { $needs }>(frame, &world, pixel, &batch, number);
                        add(&batch, number, index, one, picture, work, marks);
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
/// traced. The first pass overwrites. `work` and `marks` may hold fewer pixels, or none.
fn add(
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
    add_to(work, index, is_first, pixel.work);
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
     adaptive sampling wants to know of them to `marks`: of scenes with no more than one light and one plain material.",
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
