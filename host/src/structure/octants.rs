//! The words of the octree of tight boxes.

use crate::tree::{WideChild, WideNode};
use glam::{UVec4, uvec4};
use oktant_shared::octants::{MARGIN, NODE_VECTORS};
use oktant_shared::octree::Root;

/// Exponent of the finest raster; finer ones would not be normal numbers.
const LEAST_EXPONENT: i32 = -126;

/// By how much boxes within a cube must be wider, scene units.
pub(super) fn margin(root: &Root) -> f32 {
    let largest = root.low.abs().max(root.high.abs()).max_element();
    MARGIN * (largest + 10.0 * root.size())
}

/// A node as [`oktant_shared::octants::Octants`] reads it, its boxes wider by a margin.
pub(super) fn words(node: &WideNode, margin: f32) -> [UVec4; NODE_VECTORS as usize] {
    let (low, high) = node.bounds();
    let (low, high) = (low - margin, high + margin);
    let mut inner = 0;
    let mut meta = [0_u8; 8];
    for (slot, child) in node.children.iter().enumerate() {
        match child {
            WideChild::Empty => {}
            WideChild::Inner(_) => inner |= 1 << slot,
            WideChild::Leaf { first, count } => meta[slot] = (*count << 5 | (first - node.first_triangle)) as u8,
        }
    }
    let mut exponents = [0; 4];
    exponents[3] = inner;
    let mut faces = [UVec4::ZERO; 6];
    for axis in 0..3 {
        let raster = Raster::new(low[axis], high[axis]);
        exponents[axis] = (raster.exponent + 127) as u8;
        let mut lows = [0; 8];
        let mut highs = [0; 8];
        for slot in 0..8 {
            // An empty one's box is turned inside out and met seldom; were it met, nothing would be in it.
            let is_empty = node.children[slot] == WideChild::Empty;
            let low = f64::from(node.low[axis][slot]) - f64::from(margin);
            let high = f64::from(node.high[axis][slot]) + f64::from(margin);
            // The second number of a word has the first one in its lower half.
            let (low_before, high_before) = if slot % 2 == 0 {
                (0, 0)
            } else {
                (lows[slot - 1], highs[slot - 1])
            };
            lows[slot] = if is_empty {
                ONE
            } else {
                raster.face_below(low, low_before)
            };
            highs[slot] = if is_empty {
                0
            } else {
                raster.face_above(high, high_before)
            };
        }
        faces[2 * axis] = in_halves(lows);
        faces[2 * axis + 1] = in_halves(highs);
    }
    let [a, b, c, d, e, f, g, h] = meta;
    [
        uvec4(
            low.x.to_bits(),
            low.y.to_bits(),
            low.z.to_bits(),
            u32::from_le_bytes(exponents),
        ),
        uvec4(
            node.first_node,
            node.first_triangle,
            u32::from_le_bytes([a, b, c, d]),
            u32::from_le_bytes([e, f, g, h]),
        ),
        faces[0],
        faces[1],
        faces[2],
        faces[3],
        faces[4],
        faces[5],
    ]
}

/// Adds to the index of a node's first child that is a node.
pub(super) fn move_children(node: &mut [UVec4; NODE_VECTORS as usize], by: u32) {
    node[1].x += by;
}

/// The raster of a node along an axis, from its low corner.
struct Raster {
    corner: f64,
    /// It is two to this power long.
    exponent: i32,
    /// Its lengths in a scene unit.
    lengths: f64,
}

impl Raster {
    /// The shortest one that reaches from one coordinate to another.
    fn new(low: f32, high: f32) -> Self {
        let corner = f64::from(low);
        let length = f64::from(high) - corner;
        // The logarithm to the base of two, rounded down.
        let mut exponent = ((length.to_bits() >> 52) as i32 - 1023).max(LEAST_EXPONENT);
        if power_of_two(exponent) < length {
            exponent += 1;
        }
        Raster {
            corner,
            exponent,
            lengths: power_of_two(-exponent),
        }
    }

    /// The upper half of the last face that is not above a coordinate, of those that have this lower half.
    fn face_below(&self, coordinate: f64, lower: u32) -> u32 {
        let at = ((coordinate - self.corner) * self.lengths).clamp(0.0, 1.0);
        let nearest = at as f32;
        // Of numbers that are not negative, those before have lower bits.
        let bits = nearest.to_bits() - u32::from(f64::from(nearest) > at);
        let upper = bits >> 16;
        // Below the first there is only what a GPU takes for zero.
        if lower > bits & 0xffff {
            upper.saturating_sub(1)
        } else {
            upper
        }
    }

    /// The upper half of the first face that is not below a coordinate, of those that have this lower half.
    fn face_above(&self, coordinate: f64, lower: u32) -> u32 {
        let at = ((coordinate - self.corner) * self.lengths).clamp(f64::from(f32::MIN_POSITIVE), 1.0);
        let nearest = at as f32;
        let bits = nearest.to_bits() + u32::from(f64::from(nearest) < at);
        (bits >> 16) + u32::from(lower < bits & 0xffff)
    }
}

/// The upper half of 1.
const ONE: u32 = 0x3f80;

/// Two to the power of an exponent between -1022 and 1023.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

fn in_halves(faces: [u32; 8]) -> UVec4 {
    let [a, b, c, d, e, f, g, h] = faces;
    uvec4(a | b << 16, c | d << 16, e | f << 16, g | h << 16)
}
