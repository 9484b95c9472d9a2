//! A ray against the eight boxes of a node.

use crate::arithmetic::{greater_integer, halves, lesser_integer, multiply_add};
use crate::buffer::load;
use crate::slabs::Slabs;
use glam::{UVec4, Vec3};

/// Bit `slot` for each child of the node at `at` whose box the ray meets between `t_min` and `limit`, neither of which is
/// negative. `frame` are the node's first words: corner and sizes of its raster.
#[inline(always)]
pub(super) fn met(slabs: &Slabs, nodes: &[UVec4], at: u32, frame: UVec4, t_min: f32, limit: f32) -> u32 {
    // Low faces lie before high ones; a ray against the axis meets those first.
    let (x, y, z) = (slabs.octant & 1, slabs.octant >> 1 & 1, slabs.octant >> 2 & 1);
    let near_x = load(nodes, at + 2 + x);
    let far_x = load(nodes, at + 3 - x);
    let near_y = load(nodes, at + 4 + y);
    let far_y = load(nodes, at + 5 - y);
    let near_z = load(nodes, at + 6 + z);
    let far_z = load(nodes, at + 7 - z);
    let raster = Raster {
        // Exact: the sizes are powers of two.
        size: Vec3::new(
            f32::from_bits((frame.w & 0xff) << 23) * slabs.reciprocal.x,
            f32::from_bits((frame.w >> 8 & 0xff) << 23) * slabs.reciprocal.y,
            f32::from_bits((frame.w >> 16 & 0xff) << 23) * slabs.reciprocal.z,
        ),
        start: Vec3::new(
            multiply_add(f32::from_bits(frame.x), slabs.reciprocal.x, slabs.offset.x),
            multiply_add(f32::from_bits(frame.y), slabs.reciprocal.y, slabs.offset.y),
            multiply_add(f32::from_bits(frame.z), slabs.reciprocal.z, slabs.offset.z),
        ),
        t_min: t_min.to_bits() as i32,
        limit: limit.to_bits() as i32,
    };
    raster.two([near_x.x, near_y.x, near_z.x], [far_x.x, far_y.x, far_z.x], 1)
        | raster.two([near_x.y, near_y.y, near_z.y], [far_x.y, far_y.y, far_z.y], 4)
        | raster.two([near_x.z, near_y.z, near_z.z], [far_x.z, far_y.z, far_z.z], 16)
        | raster.two([near_x.w, near_y.w, near_z.w], [far_x.w, far_y.w, far_z.w], 64)
}

/// A node's raster as a ray sees it.
struct Raster {
    /// From one end of it to the other, in `t`.
    size: Vec3,
    /// Where the raster begins.
    start: Vec3,
    /// The bits of the limits of `t`.
    t_min: i32,
    limit: i32,
}

impl Raster {
    /// `bit` for the first and the next higher bit for the second of two children whose faces, in halves of a word across
    /// x, y and z, are met.
    #[inline(always)]
    fn two(&self, near: [u32; 3], far: [u32; 3], bit: u32) -> u32 {
        let (near_x, near_y, near_z) = (halves(near[0]), halves(near[1]), halves(near[2]));
        let (far_x, far_y, far_z) = (halves(far[0]), halves(far[1]), halves(far[2]));
        let first = self.is_met(
            Vec3::new(near_x.x, near_y.x, near_z.x),
            Vec3::new(far_x.x, far_y.x, far_z.x),
        );
        let second = self.is_met(
            Vec3::new(near_x.y, near_y.y, near_z.y),
            Vec3::new(far_x.y, far_y.y, far_z.y),
        );
        (if first { bit } else { 0 }) | (if second { bit << 1 } else { 0 })
    }

    /// Numbers that are not negative have the order of their bits, and those of a negative one are a negative integer: as
    /// neither limit is negative, integers are as good, and some GPUs compare three of them at once.
    #[inline(always)]
    fn is_met(&self, near: Vec3, far: Vec3) -> bool {
        let at = |face: f32, size: f32, start: f32| multiply_add(face, size, start).to_bits() as i32;
        let enter_x = at(near.x, self.size.x, self.start.x);
        let enter_y = at(near.y, self.size.y, self.start.y);
        let enter_z = at(near.z, self.size.z, self.start.z);
        let exit_x = at(far.x, self.size.x, self.start.x);
        let exit_y = at(far.y, self.size.y, self.start.y);
        let exit_z = at(far.z, self.size.z, self.start.z);
        let enter = greater_integer(greater_integer(greater_integer(enter_x, enter_y), enter_z), self.t_min);
        let exit = lesser_integer(lesser_integer(lesser_integer(exit_x, exit_y), exit_z), self.limit);
        enter <= exit
    }
}
