//! The words of the octree of tight boxes.

use crate::tree::{WideChild, WideNode};
use glam::{UVec4, uvec4};
use oktant_shared::octants::{MARGIN, NODE_VECTORS};
use oktant_shared::octree::Root;

/// Largest number of steps of a node's raster along an axis.
const STEPS: f64 = 255.0;
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
    let mut faces = [UVec4::ZERO; 3];
    for axis in 0..3 {
        let (corner, exponent) = raster(low[axis], high[axis]);
        exponents[axis] = (exponent + 127) as u8;
        let step = 2.0_f64.powi(exponent);
        let mut lows = [0; 8];
        let mut highs = [0; 8];
        for slot in 0..8 {
            if node.children[slot] == WideChild::Empty {
                // Turned inside out, it is met seldom; were it met, nothing would be in it.
                (lows[slot], highs[slot]) = (u8::MAX, 0);
            } else {
                let low = (f64::from(node.low[axis][slot]) - f64::from(margin) - corner) / step;
                let high = (f64::from(node.high[axis][slot]) + f64::from(margin) - corner) / step;
                (lows[slot], highs[slot]) = (low.floor() as u8, high.ceil().min(STEPS) as u8);
            }
        }
        let (lows, highs) = (halves(lows), halves(highs));
        faces[axis] = uvec4(lows[0], lows[1], highs[0], highs[1]);
    }
    let meta = halves(meta);
    [
        uvec4(
            low.x.to_bits(),
            low.y.to_bits(),
            low.z.to_bits(),
            u32::from_le_bytes(exponents),
        ),
        uvec4(node.first_node, node.first_triangle, meta[0], meta[1]),
        faces[0],
        faces[1],
        faces[2],
    ]
}

/// The corner and the exponent of the finest raster that reaches from one coordinate to another.
fn raster(low: f32, high: f32) -> (f64, i32) {
    let (low, high) = (f64::from(low), f64::from(high));
    let mut exponent = (((high - low) / STEPS).log2().ceil().max(f64::from(LEAST_EXPONENT))) as i32;
    // The logarithm may be off by a rounding.
    while ((high - low) / 2.0_f64.powi(exponent)).ceil() > STEPS {
        exponent += 1;
    }
    (low, exponent)
}

fn halves(bytes: [u8; 8]) -> [u32; 2] {
    let [a, b, c, d, e, f, g, h] = bytes;
    [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h])]
}
