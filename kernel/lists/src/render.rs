//! The listed pixels of the picture.

use crate::group::{Found, OfEach, Stretch, owner, start, summed};
use glam::{UVec3, UVec4, Vec4, uvec2};
use oktant_shared::adaptive::{LIST_GROUP, Mark, pixels_of_group};
use oktant_shared::buffer::{get, load, put};
use oktant_shared::general::General;
use oktant_shared::pixels;
use oktant_shared::pixels::ROW;
use oktant_shared::render::render_sample;
use oktant_shared::traversal::Standard;
use oktant_shared::variant::{EVERYTHING, MIRRORED, OPAQUE, PLAIN};
use spirv_std::arch::workgroup_memory_barrier_with_group_sync as wait;

/// An entry point that renders listed pixels with a traversal what some needs have.
macro_rules! renders_listed {
    ($doc:literal, $entry:literal, $name:ident, $traversal:ty, $needs:expr) => {
        pixels!(
            $doc, $entry, $name,
            {
                #[spirv(workgroup_id)] group: UVec3,
                #[spirv(local_invocation_index)] invocation: u32,
                #[spirv(workgroup)] ends: &mut OfEach<u32>,
                #[spirv(workgroup)] sums: &mut OfEach<Vec4>,
                #[spirv(workgroup)] costs: &mut OfEach<Vec4>,
                #[spirv(workgroup)] found_marks: &mut OfEach<UVec4>,
                #[spirv(storage_buffer, descriptor_set = 2, binding = 0)] picture: &mut [Vec4],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 1)] work: &mut [Vec4],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 2)] marks: &mut [Mark],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 3)] list: &[u32],
                #[spirv(storage_buffer, descriptor_set = 2, binding = 4)] count: &[u32],
            },
            frame world {
                let first = frame.first_listed + (group.y * ROW + group.x) * pixels_of_group(frame);
                let stretch = Stretch { frame, list, count, first };
                // The same for the whole workgroup, as the number of turns is: all of it comes to where it waits, or none.
                if first < load(count, 0) {
                    put(ends, invocation, stretch.looks(invocation));
                    wait();
                    let end = summed(frame, ends, invocation);
                    wait();
                    put(ends, invocation, end);
                    wait();
                    let all = get(ends, LIST_GROUP - 1);
                    let mut found = Found { sums, costs, marks: found_marks };
                    let mut turn = 0;
                    loop {
                        let look = turn + invocation;
                        if look < all {
                            let place = owner(ends, look);
                            let number = look - start(ends, place);
                            let listed = stretch.pixel(place);
                            let size = frame.size();
                            let pixel = uvec2(listed.index % size.x, listed.index / size.x);
                            let one = render_sample::<$traversal, { $needs }>(frame, &world, pixel, &listed.batch, number);
                            found.put(invocation, one);
                        }
                        wait();
                        found.add(&stretch, ends, turn, invocation, picture, work, marks);
                        turn += LIST_GROUP;
                        wait();
                        if turn >= all {
                            break;
                        }
                    }
                }
            }
        );
    };
}

renders_listed!(
    "Adds this pass's samples to the pixels of `picture` that the first `count[0]` entries of `list` name, from `first_listed` on, \
     what they cost to `work`, and what adaptive sampling wants to know of them to `marks`: of scenes with no more than one \
     light and one plain material.",
    "render_listed_plain",
    render_listed_plain,
    Standard,
    PLAIN
);

renders_listed!(
    "As `render_listed_plain`, of scenes without mirrors and glass.",
    "render_listed_opaque",
    render_listed_opaque,
    Standard,
    OPAQUE
);

renders_listed!(
    "As `render_listed_plain`, of scenes without glass.",
    "render_listed_mirrors",
    render_listed_mirrors,
    Standard,
    MIRRORED
);

renders_listed!(
    "As `render_listed_plain`, of any scene.",
    "render_listed",
    render_listed,
    Standard,
    EVERYTHING
);

renders_listed!(
    "As `render_listed`, with the parts that the frame names.",
    "render_listed_general",
    render_listed_general,
    General,
    EVERYTHING
);
