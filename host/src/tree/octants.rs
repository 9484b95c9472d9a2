//! The tree of sorted Morton codes: octants, halved along one axis after the other.

use super::binary::BinaryNode;
use super::items::Item;
use super::morton::MortonOrder;
use super::place::{PARALLEL, Place};
use super::sah::few;
use super::split::TRIALS;
use std::ops::Range;

/// Builds the tree over all items in its place.
pub(super) fn build(
    sorted: &MortonOrder,
    items: &[Item],
    report: &(dyn Fn(usize) + Sync),
    place: Place<'_>,
) -> BinaryNode {
    cell(sorted, items, report, 0..sorted.len(), place)
}

/// The subtree over a range of items. No deeper than a code and an index have bits: those of one code are halved.
fn cell(
    sorted: &MortonOrder,
    items: &[Item],
    report: &(dyn Fn(usize) + Sync),
    range: Range<usize>,
    place: Place<'_>,
) -> BinaryNode {
    let count = range.len();
    if count <= TRIALS {
        // The best subtree over a few costs no more than any.
        let mut few_items = [items[range.start]; TRIALS];
        few_items[..count].copy_from_slice(&items[range]);
        return few(&mut few_items[..count], place);
    }
    let middle = sorted.middle(range.clone());
    let (pair, first, second) = place.split(middle - range.start);
    let first = || cell(sorted, items, report, range.start..middle, first);
    let second = || cell(sorted, items, report, middle..range.end, second);
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
