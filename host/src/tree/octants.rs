//! The tree of sorted Morton codes: octants, halved along one axis after the other.

use super::binary::BinaryNode;
use super::items::Items;
use super::morton::MortonOrder;
use super::place::{PARALLEL, Place};
use super::sah::few;
use super::split::TRIALS;
use std::ops::Range;

/// Bits of a code an axis, if they fit.
const BITS: u32 = 14;

/// Builds the tree over all items in its place.
pub(super) fn build(items: Items, report: &(dyn Fn(usize) + Sync), place: Place<'_>) -> BinaryNode {
    let sorted = MortonOrder::new(items, BITS);
    cell(&sorted, report, 0..sorted.len(), place)
}

/// The subtree over a range of items. No deeper than a code and an index have bits: those of one code are halved.
fn cell(sorted: &MortonOrder, report: &(dyn Fn(usize) + Sync), range: Range<usize>, place: Place<'_>) -> BinaryNode {
    let count = range.len();
    if count <= TRIALS {
        // The best subtree over a few costs no more than any.
        let mut items = [sorted.item(range.start); TRIALS];
        for (item, place) in items.iter_mut().zip(range).skip(1) {
            *item = sorted.item(place);
        }
        return few(&mut items[..count], place);
    }
    let middle = sorted.middle(range.clone()).unwrap_or(range.start + count / 2);
    let (pair, first, second) = place.split(middle - range.start);
    let first = || cell(sorted, report, range.start..middle, first);
    let second = || cell(sorted, report, middle..range.end, second);
    if count < PARALLEL {
        return pair.fill((first(), second()));
    }
    let made = rayon::join(first, second);
    // Smaller subtrees have reported nothing.
    for part in [middle - range.start, range.end - middle] {
        if part < PARALLEL {
            report(part);
        }
    }
    pair.fill(made)
}
