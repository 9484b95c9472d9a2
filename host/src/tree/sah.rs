//! Top-down builds by the surface area heuristic.

use super::binary::{BinaryNode, MAX_BINARY_DEPTH};
use super::items::{Bounds, Item};
use super::place::{PARALLEL, Place};
use super::split::{Split, TRIALS, by_bins, by_trial, halve};

/// From this level on items are halved whatever it costs: 2^32 of them reach [`MAX_BINARY_DEPTH`] then.
const HALVING_LEVEL: u32 = MAX_BINARY_DEPTH - 32;

/// How finely planes are tried.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// Items from which on there are 32 bins an axis.
    pub many: usize,
    /// Items from which on there are 16 bins an axis; below there are 8.
    pub some: usize,
}

/// A build by the surface area heuristic.
pub(super) struct Heuristic<'a> {
    pub effort: Effort,
    /// Told how many more triangles are finished.
    pub report: &'a (dyn Fn(usize) + Sync),
}

impl Heuristic<'_> {
    /// Builds the subtree over some items, in their place, with bounds of their centres.
    pub fn subtree(&self, items: &mut [Item], bounds: Bounds, place: Place<'_>) -> BinaryNode {
        let count = items.len();
        if count <= TRIALS {
            return few(items, place);
        }
        let split = self.split(items, bounds, place.level);
        let (first_items, second_items) = items.split_at_mut(split.middle);
        let (pair, first, second) = place.split(split.middle);
        let made = if count >= PARALLEL {
            let made = rayon::join(
                || self.subtree(first_items, split.centres[0], first),
                || self.subtree(second_items, split.centres[1], second),
            );
            // Smaller subtrees have reported nothing.
            for part in [split.middle, count - split.middle] {
                if part < PARALLEL {
                    (self.report)(part);
                }
            }
            made
        } else {
            (
                self.subtree(first_items, split.centres[0], first),
                self.subtree(second_items, split.centres[1], second),
            )
        };
        pair.fill(made)
    }

    fn split(&self, items: &mut [Item], bounds: Bounds, level: u32) -> Split {
        let count = items.len();
        if level >= HALVING_LEVEL {
            return halve(items);
        }
        if count >= self.effort.many {
            by_bins::<32>(items, bounds)
        } else if count >= self.effort.some {
            by_bins::<16>(items, bounds)
        } else {
            by_bins::<8>(items, bounds)
        }
        .unwrap_or_else(|| halve(items))
    }
}

/// The best subtree over at most [`TRIALS`] items.
pub(super) fn few(items: &mut [Item], place: Place<'_>) -> BinaryNode {
    if let [item] = items {
        return place.leaf(item);
    }
    let middle = if items.len() == 2 { 1 } else { by_trial(items) };
    let (first_items, second_items) = items.split_at_mut(middle);
    let (pair, first, second) = place.split(middle);
    pair.fill((few(first_items, first), few(second_items, second)))
}
