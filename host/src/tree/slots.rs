//! Which child goes into which slot.

use super::wide::WIDTH;
use glam::{Vec3, Vec4, vec4};

/// How well children are placed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Placing {
    /// The child furthest towards a corner first.
    #[default]
    Greedy,
    /// The best of all ways.
    Best,
}

/// The child in each slot, as an index into `children`; these are the centres of their boxes, as is the parent's.
///
/// The sum of how far the children lie towards the corner of their slot from the parent's centre is to be large: Ylitie,
/// Karras and Laine 2017, section 3, who find the best by the auction algorithm. The corners are not normalised.
pub(super) fn place(placing: Placing, parent: Vec3, children: &[Vec3]) -> [Option<u8>; WIDTH] {
    let mut offsets = [Vec3::ZERO; WIDTH];
    for (offset, child) in offsets.iter_mut().zip(children) {
        *offset = *child - parent;
    }
    let offsets = &offsets[..children.len()];
    match placing {
        Placing::Greedy => greedy(offsets),
        Placing::Best => best(offsets),
    }
}

/// A value for each slot, or for each child.
#[derive(Clone, Copy)]
struct Eight([Vec4; 2]);

/// Below every score.
const LEAST: f32 = -1e38;

/// [`LEAST`] at one index, zeros elsewhere.
const MARKS: [Eight; WIDTH] = {
    let mut marks = [Eight([Vec4::ZERO; 2]); WIDTH];
    let mut index = 0;
    while index < WIDTH {
        let mut lanes = [0.0; 4];
        lanes[index % 4] = LEAST;
        marks[index].0[index / 4] = Vec4::from_array(lanes);
        index += 1;
    }
    marks
};

impl Eight {
    fn plus(self, other: &Eight) -> Self {
        Eight([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }

    /// Index of a value that is the highest but for its last three bits.
    fn highest(self) -> usize {
        const BITS: u32 = WIDTH as u32 - 1;
        // The bits become the index.
        let marked = |half: usize| {
            let lanes = self.0[half].to_array();
            let mark = |lane: usize| f32::from_bits(lanes[lane].to_bits() & !BITS | (4 * half + lane) as u32);
            vec4(mark(0), mark(1), mark(2), mark(3))
        };
        (marked(0).max(marked(1)).max_element().to_bits() & BITS) as usize
    }
}

/// How far a child with this offset from the centre lies towards the corner of each slot.
fn scores(offset: Vec3) -> Eight {
    let Vec3 { x, y, z } = offset;
    let plane = vec4(-x - y, x - y, y - x, x + y);
    Eight([plane - Vec4::splat(z), plane + Vec4::splat(z)])
}

/// The child that is furthest towards a corner first, then the next.
fn greedy(offsets: &[Vec3]) -> [Option<u8>; WIDTH] {
    let mut all = [LEAST; WIDTH];
    for (reach, offset) in all.iter_mut().zip(offsets) {
        *reach = offset.abs().element_sum();
    }
    let mut reaches = Eight([Vec4::from_slice(&all), Vec4::from_slice(&all[4..])]);
    let mut slots = [None; WIDTH];
    let mut occupied = Eight([Vec4::ZERO; 2]);
    for _ in offsets {
        let child = reaches.highest();
        reaches = reaches.plus(&MARKS[child]);
        let slot = scores(offsets[child]).plus(&occupied).highest();
        occupied = occupied.plus(&MARKS[slot]);
        slots[slot] = Some(child as u8);
    }
    slots
}

/// By dynamic programming over the sets of slots that the first children occupy.
fn best(offsets: &[Vec3]) -> [Option<u8>; WIDTH] {
    const SETS: usize = 1 << WIDTH;
    let mut highest = [f32::NEG_INFINITY; SETS];
    let mut last = [0_u8; SETS];
    highest[0] = 0.0;
    let count = offsets.len();
    let mut all = [[0.0; WIDTH]; WIDTH];
    for (all, offset) in all.iter_mut().zip(offsets) {
        let Eight([low, high]) = scores(*offset);
        all[..4].copy_from_slice(&low.to_array());
        all[4..].copy_from_slice(&high.to_array());
    }
    let mut chosen = (f32::NEG_INFINITY, 0);
    for set in 0..SETS {
        let child = set.count_ones() as usize;
        if child == count {
            if highest[set] > chosen.0 {
                chosen = (highest[set], set);
            }
            continue;
        }
        if child > count {
            continue;
        }
        for slot in (0..WIDTH).filter(|slot| set >> slot & 1 == 0) {
            let with = set | 1 << slot;
            let score = highest[set] + all[child][slot];
            if score > highest[with] {
                highest[with] = score;
                last[with] = slot as u8;
            }
        }
    }
    let mut slots = [None; WIDTH];
    let mut set = chosen.1;
    for child in (0..count).rev() {
        let slot = last[set] as usize;
        slots[slot] = Some(child as u8);
        set ^= 1 << slot;
    }
    slots
}

#[cfg(test)]
mod tests {
    use super::*;

    fn total(offsets: &[Vec3], slots: &[Option<u8>; WIDTH]) -> f32 {
        let placed = slots
            .iter()
            .enumerate()
            .filter_map(|(slot, child)| child.map(|child| (slot, child)));
        placed
            .map(|(slot, child)| {
                let Eight([low, high]) = scores(offsets[child as usize]);
                if slot < 4 { low[slot] } else { high[slot - 4] }
            })
            .sum()
    }

    #[test]
    fn children_in_all_octants_are_in_the_slots_of_their_octants() {
        // In an order that is not that of the slots.
        let octants = [5, 2, 7, 0, 3, 6, 1, 4_usize];
        let offsets = octants.map(|octant| {
            let side = |axis: usize| if octant >> axis & 1 == 1 { 1.5 } else { -0.5 };
            Vec3::new(side(0), side(1), side(2))
        });
        for slots in [greedy(&offsets), best(&offsets)] {
            for (child, octant) in octants.into_iter().enumerate() {
                assert_eq!(slots[octant], Some(child as u8));
            }
        }
    }

    #[test]
    fn every_child_is_placed_once_and_no_way_beats_the_best() {
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 23) as f32 - 1.0
        };
        let mut differ = 0;
        for round in 0..1_000 {
            let all: [Vec3; WIDTH] = std::array::from_fn(|_| Vec3::new(random(), random(), random()));
            let offsets = &all[..1 + round % WIDTH];
            for slots in [greedy(offsets), best(offsets)] {
                let mut children: Vec<u8> = slots.into_iter().flatten().collect();
                children.sort_unstable();
                assert!(children.into_iter().eq(0..offsets.len() as u8));
            }
            let (quick, highest) = (total(offsets, &greedy(offsets)), total(offsets, &best(offsets)));
            assert!(quick <= highest + 1e-4, "{quick} {highest}");
            differ += u32::from(quick < highest - 1e-4);
        }
        assert!(differ > 0, "the rounds are too easy");
    }
}
