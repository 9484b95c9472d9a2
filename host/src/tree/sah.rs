//! Top-down builds by the surface area heuristic.

use super::binary::{BinaryNode, MAX_BINARY_DEPTH};
use super::items::{Bounds, Item};
use super::place::{PARALLEL, Place};
use super::split::{Split, TRIALS, by_bins, by_trial, centres, halve};

/// From this level on items are halved whatever it costs: 2^24 of them, and as many in each, do not reach
/// [`MAX_BINARY_DEPTH`] then.
const HALVING_LEVEL: u32 = MAX_BINARY_DEPTH - 52;

/// Most triangles of a subtree over which boxes are no longer kept together.
const OPEN: usize = 1 << 13;

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
    /// What the items that are built over stand for, if they are boxes around others. Subtrees of up to [`OPEN`] triangles
    /// are built over those: what was put together is parted wherever it is best.
    pub within: Option<&'a [Item]>,
    /// Told how many more triangles are finished.
    pub report: &'a (dyn Fn(usize) + Sync),
}

impl Heuristic<'_> {
    /// Builds the subtree over some items, in their place, with bounds of their centres.
    pub fn subtree(&self, items: &mut [Item], bounds: Bounds, place: Place<'_>) -> BinaryNode {
        if let Some(within) = self.within
            && (items.len() == 1 || place.triangles() <= OPEN)
        {
            let mut inside = Vec::with_capacity(place.triangles());
            for item in items {
                inside.extend_from_slice(&within[item.id() as usize..][..item.count() as usize]);
            }
            let bounds = centres(&inside);
            return Heuristic { within: None, ..*self }.subtree(&mut inside, bounds, place);
        }
        if self.within.is_none() && items.len() <= TRIALS {
            return few(items, place);
        }
        let split = self.split(items, bounds, place.level);
        let (first_items, second_items) = items.split_at_mut(split.middle);
        let triangles = self.triangles(first_items);
        let parts = [triangles, place.triangles() - triangles];
        let (pair, first, second) = place.split(triangles);
        if parts[0] + parts[1] < PARALLEL {
            return pair.fill((
                self.subtree(first_items, split.centres[0], first),
                self.subtree(second_items, split.centres[1], second),
            ));
        }
        let made = rayon::join(
            || self.subtree(first_items, split.centres[0], first),
            || self.subtree(second_items, split.centres[1], second),
        );
        // Smaller subtrees have reported nothing.
        for part in parts {
            if part < PARALLEL {
                (self.report)(part);
            }
        }
        pair.fill(made)
    }

    /// How many triangles some items stand for.
    fn triangles(&self, items: &[Item]) -> usize {
        if self.within.is_some() {
            items.iter().map(|item| item.count() as usize).sum()
        } else {
            items.len()
        }
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
