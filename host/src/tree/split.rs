//! Parting items in two.

use super::bins::{Binning, Bins};
use super::items::{Bounds, Item};
use rayon::prelude::*;

/// Items parted in two.
pub(super) struct Split {
    /// Items of the first part.
    pub middle: usize,
    /// Bounds of the centres of both parts.
    pub centres: [Bounds; 2],
}

/// With more items, bins are filled by several threads.
const PARALLEL: usize = 1 << 14;

/// Along the best of the planes between `BINS` bins; `None` where all items are in one.
pub(super) fn by_bins<const BINS: usize>(items: &mut [Item], centres: Bounds) -> Option<Split> {
    let binning = Binning::<BINS>::new(centres);
    let plane = if items.len() > PARALLEL {
        items
            .par_chunks(PARALLEL)
            .map(|items| Bins::fill(items, &binning))
            .reduce_with(|a, b| a.and(&b))
            .and_then(|bins| bins.best())
    } else {
        Bins::fill(items, &binning).best()
    };
    plane.map(|plane| part(items, |item| binning.is_below(item, plane)))
}

/// Most items for [`by_trial`].
pub(super) const TRIALS: usize = 4;

/// Parts three or four items in the best of all ways; how many are in the first part.
pub(super) fn by_trial(items: &mut [Item]) -> usize {
    let set = if items.len() == 3 {
        best_set::<3>(items)
    } else {
        best_set::<4>(items)
    };
    let mut middle = 0;
    for i in 0..items.len() {
        if set >> i & 1 == 0 {
            items.swap(i, middle);
            middle += 1;
        }
    }
    middle
}

/// The second part of so many items, as a set of bits.
fn best_set<const COUNT: usize>(items: &[Item]) -> usize {
    let bounds: [Bounds; COUNT] = std::array::from_fn(|i| Bounds::of(&items[i]));
    // The last item is in the second part, some other in the first.
    let last = 1 << (COUNT - 1);
    let mut best = (f32::INFINITY, last);
    for set in last..2 * last - 1 {
        let mut sides = [Bounds::EMPTY; 2];
        for (i, bounds) in bounds.iter().enumerate() {
            let side = &mut sides[set >> i & 1];
            *side = side.and(*bounds);
        }
        let second = set.count_ones();
        let cost = sides[0].area() * (COUNT as u32 - second) as f32 + sides[1].area() * second as f32;
        if cost < best.0 {
            best = (cost, set);
        }
    }
    best.1
}

/// Moves the items that are `first` before the others. The order within the parts depends on nothing but their order.
fn part(items: &mut [Item], first: impl Fn(&Item) -> bool) -> Split {
    // Without a branch on what cannot be foreseen.
    let mut middle = 0;
    for i in 0..items.len() {
        let item = items[i];
        items.swap(i, middle);
        middle += usize::from(first(&item));
    }
    let (first, second) = items.split_at(middle);
    Split {
        middle,
        centres: [centres(first), centres(second)],
    }
}

/// The lower half along the axis on which the centres are spread most.
pub(super) fn halve(items: &mut [Item]) -> Split {
    let middle = items.len() / 2;
    let bounds = centres(items);
    let axis = (bounds.high - bounds.low).truncate().max_position();
    items.select_nth_unstable_by(middle, |a, b| {
        let (a, b) = ((a.centre()[axis], a.id()), (b.centre()[axis], b.id()));
        a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
    });
    let (first, second) = items.split_at(middle);
    Split {
        middle,
        centres: [centres(first), centres(second)],
    }
}

/// Bounds of the items' centres.
pub(super) fn centres(items: &[Item]) -> Bounds {
    let of_few = |items: &[Item]| {
        items.iter().fold(Bounds::EMPTY, |bounds, item| {
            let centre = item.centre();
            bounds.with(centre, centre)
        })
    };
    if items.len() > PARALLEL {
        let chunks = items.par_chunks(PARALLEL).map(of_few);
        chunks.reduce(|| Bounds::EMPTY, Bounds::and)
    } else {
        of_few(items)
    }
}
