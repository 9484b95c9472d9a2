//! A ray against the eight boxes of a node.

use crate::arithmetic::{greater, lesser, multiply_add};
use crate::buffer::load;
use crate::slabs::Slabs;
use glam::{UVec4, Vec3};

/// Bit `slot` for each child of the node at `at` whose box the ray meets between `t_min` and `limit`. `frame` are the
/// node's first words: corner and steps of its raster.
#[inline(always)]
pub(super) fn met(slabs: &Slabs, nodes: &[UVec4], at: u32, frame: UVec4, t_min: f32, limit: f32) -> u32 {
    let x = nearer_first(load(nodes, at + 2), slabs.octant & 1 != 0);
    let y = nearer_first(load(nodes, at + 3), slabs.octant & 2 != 0);
    let z = nearer_first(load(nodes, at + 4), slabs.octant & 4 != 0);
    // Exact: the steps are powers of two.
    let step = Vec3::new(
        f32::from_bits((frame.w & 0xff) << 23) * slabs.reciprocal.x,
        f32::from_bits((frame.w >> 8 & 0xff) << 23) * slabs.reciprocal.y,
        f32::from_bits((frame.w >> 16 & 0xff) << 23) * slabs.reciprocal.z,
    );
    let start = Vec3::new(
        multiply_add(f32::from_bits(frame.x), slabs.reciprocal.x, slabs.offset.x),
        multiply_add(f32::from_bits(frame.y), slabs.reciprocal.y, slabs.offset.y),
        multiply_add(f32::from_bits(frame.z), slabs.reciprocal.z, slabs.offset.z),
    );
    let four = |near: Vec3Words, far: Vec3Words, first: u32| {
        let one = |shift: u32, bit: u32| {
            let enter = greater(
                greater(
                    multiply_add(byte(near.x, shift), step.x, start.x),
                    multiply_add(byte(near.y, shift), step.y, start.y),
                ),
                greater(multiply_add(byte(near.z, shift), step.z, start.z), t_min),
            );
            let exit = lesser(
                lesser(
                    multiply_add(byte(far.x, shift), step.x, start.x),
                    multiply_add(byte(far.y, shift), step.y, start.y),
                ),
                lesser(multiply_add(byte(far.z, shift), step.z, start.z), limit),
            );
            if enter <= exit { bit } else { 0 }
        };
        one(0, first) | one(8, first << 1) | one(16, first << 2) | one(24, first << 3)
    };
    let (near_low, far_low) = (
        Vec3Words { x: x.x, y: y.x, z: z.x },
        Vec3Words { x: x.z, y: y.z, z: z.z },
    );
    let (near_high, far_high) = (
        Vec3Words { x: x.y, y: y.y, z: z.y },
        Vec3Words { x: x.w, y: y.w, z: z.w },
    );
    four(near_low, far_low, 1) | four(near_high, far_high, 16)
}

/// Faces of four boxes across each axis, a byte each.
#[derive(Clone, Copy)]
struct Vec3Words {
    x: u32,
    y: u32,
    z: u32,
}

#[inline(always)]
fn byte(word: u32, shift: u32) -> f32 {
    (word >> shift & 0xff) as f32
}

/// Swaps low and high faces.
#[inline(always)]
fn nearer_first(faces: UVec4, is_reversed: bool) -> UVec4 {
    let (a, b, c, d) = (faces.x, faces.y, faces.z, faces.w);
    UVec4::new(
        if is_reversed { c } else { a },
        if is_reversed { d } else { b },
        if is_reversed { a } else { c },
        if is_reversed { b } else { d },
    )
}
