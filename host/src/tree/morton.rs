//! Items in the order of Morton codes.

use super::items::{Item, Items};
use super::pages::Pages;
use super::radix;
use glam::Vec4;
use rayon::prelude::*;
use std::ops::Range;

/// Items that are worked on at a time.
const BLOCK: usize = 1 << 13;
/// Most bits of a code an axis: more than single precision tells apart in [0, 1) are of no use.
const MOST_BITS: u32 = 21;

/// Items along Morton's curve, by the centres of their boxes.
pub(super) struct MortonOrder {
    /// Ascending codes, and in the lowest bits the indices of the items, ascending where codes are equal.
    words: Vec<u64>,
    /// Bits of an index.
    rest: u32,
    /// In that order.
    items: Pages<Item>,
}

impl MortonOrder {
    /// Sorts items by codes of up to so many bits an axis; less where the codes and the indices of the
    /// items do not fit into 64 bits together.
    pub fn new(items: Items, bits: u32) -> Self {
        let Items { items, bounds, .. } = items;
        let rest = usize::BITS - (items.len() - 1).leading_zeros();
        let bits = bits.min(MOST_BITS).min((u64::BITS - rest) / 3);
        let size = (bounds.high - bounds.low).truncate().max_element();
        // A cube of cells; of centres doubled.
        let scale = Vec4::splat(0.5 * (1_u32 << bits) as f32 / size);
        let last = (1_u32 << bits) - 1;
        let low = bounds.low + bounds.low;
        let word = |(index, item): (usize, &Item)| {
            let cell = ((item.centre() - low) * scale).truncate().as_uvec3();
            let code = spread(cell.x.min(last)) | spread(cell.y.min(last)) << 1 | spread(cell.z.min(last)) << 2;
            code << rest | index as u64
        };
        let words = items.par_iter().enumerate().with_min_len(BLOCK).map(word).collect();
        let words = radix::sorted(words, rest, 3 * bits);
        // Fetched from all over memory at once, not one by one when they are needed.
        let mut sorted = Pages::<Item>::zeroed(items.len());
        let pairs = sorted.par_iter_mut().zip(&words).with_min_len(BLOCK);
        pairs.for_each(|(item, word)| *item = items[(word & ((1 << rest) - 1)) as usize]);
        MortonOrder {
            words,
            rest,
            items: sorted,
        }
    }

    /// Number of items.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// The item at a place in the order.
    pub fn item(&self, place: usize) -> Item {
        self.items[place]
    }

    /// Where the items of the upper half of a range's smallest cell begin; `None` where all codes are the same.
    pub fn middle(&self, range: Range<usize>) -> Option<usize> {
        let words = &self.words[range.clone()];
        let (first, last) = (words[0] >> self.rest, words[words.len() - 1] >> self.rest);
        if first == last {
            return None;
        }
        // The highest bit that differs is set in the upper half.
        let bit = self.rest + (first ^ last).ilog2();
        Some(range.start + words.partition_point(|word| word >> bit & 1 == 0))
    }
}

/// Two zeros between any two of the lowest 21 bits.
fn spread(x: u32) -> u64 {
    let x = u64::from(x);
    let x = (x | x << 32) & 0x1f_0000_0000_ffff;
    let x = (x | x << 16) & 0x1f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}
