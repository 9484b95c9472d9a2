//! Where to part boxes: the surface area heuristic over a few planes an axis.

use super::items::{Bounds, Item};
use glam::{Vec4, vec4};

/// Floats near this number, 3 * 2^22, are integers; a small one that is added to it becomes the last bits.
const INTEGERS: f32 = 12_582_912.0;

/// Sorts boxes into `BINS` bins an axis, a power of two, by their centres.
#[derive(Clone, Copy)]
pub(super) struct Binning<const BINS: usize> {
    low: Vec4,
    scale: Vec4,
}

impl<const BINS: usize> Binning<BINS> {
    /// For boxes with centres (doubled, as [`Item::centre`]) in these bounds.
    pub fn new(centres: Bounds) -> Self {
        // Just below one bin too many, so that the highest centre is in the last bin.
        let scale = Vec4::splat(BINS as f32 * 0.999_99) / (centres.high - centres.low);
        Binning {
            low: centres.low,
            // An axis along which all centres are the same has one bin; an infinite scale times zero were no number.
            scale: vec4(finite(scale.x), finite(scale.y), finite(scale.z), 0.0),
        }
    }

    /// The item's bin on each axis.
    pub fn of(&self, item: &Item) -> [usize; 3] {
        let place = self.place(item);
        [place.x, place.y, place.z].map(|place| place.to_bits() as usize % BINS)
    }

    /// Whether the item is below the plane.
    pub fn is_below(&self, item: &Item, plane: Plane) -> bool {
        let bin = Vec4::splat(INTEGERS + plane.bin as f32);
        self.place(item).cmplt(bin).bitmask() >> plane.axis & 1 == 1
    }

    /// Its bins, above [`INTEGERS`].
    fn place(&self, item: &Item) -> Vec4 {
        // Rounds to the nearest integer; with half a bin less, down.
        (item.centre() - self.low) * self.scale - Vec4::splat(0.5) + Vec4::splat(INTEGERS)
    }
}

fn finite(scale: f32) -> f32 {
    if scale.is_finite() { scale } else { 0.0 }
}

/// Boxes and counts of the items in each bin of each axis.
#[derive(Clone)]
pub(super) struct Bins<const BINS: usize> {
    bounds: [[Bounds; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

/// A plane between bins: items in bins below `bin` on `axis` go to the first side.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub axis: usize,
    pub bin: usize,
}

impl<const BINS: usize> Bins<BINS> {
    /// What is in the bins after sorting these items into them.
    pub fn fill(items: &[Item], binning: &Binning<BINS>) -> Self {
        let mut all = Bins {
            bounds: [[Bounds::EMPTY; BINS]; 3],
            counts: [[0; BINS]; 3],
        };
        for item in items {
            for (axis, bin) in binning.of(item).into_iter().enumerate() {
                all.bounds[axis][bin] = all.bounds[axis][bin].with(item.low(), item.high());
                all.counts[axis][bin] += item.count();
            }
        }
        all
    }

    /// Both together; the order does not matter to the result.
    pub fn and(mut self, other: &Self) -> Self {
        for axis in 0..3 {
            for bin in 0..BINS {
                self.bounds[axis][bin] = self.bounds[axis][bin].and(other.bounds[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }

    /// The plane with the lowest sum of surface times number of both sides; of equal ones the first. `None` where all
    /// items are in one bin.
    pub fn best(&self) -> Option<Plane> {
        let mut best = None;
        let mut lowest = f32::INFINITY;
        for axis in 0..3 {
            let (bounds, counts) = (&self.bounds[axis], &self.counts[axis]);
            let mut above = [f32::INFINITY; BINS];
            let (mut sum, mut count) = (Bounds::EMPTY, 0);
            for bin in (1..BINS).rev() {
                sum = sum.and(bounds[bin]);
                count += counts[bin];
                // Nothing above: no split.
                if count > 0 {
                    above[bin] = sum.area() * count as f32;
                }
            }
            let (mut sum, mut count) = (Bounds::EMPTY, 0);
            for bin in 1..BINS {
                sum = sum.and(bounds[bin - 1]);
                count += counts[bin - 1];
                if count == 0 {
                    continue;
                }
                let cost = sum.area() * count as f32 + above[bin];
                if cost < lowest {
                    lowest = cost;
                    best = Some(Plane { axis, bin });
                }
            }
        }
        best
    }
}
