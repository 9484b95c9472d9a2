//! Items in the order of Morton codes.

use super::items::{Bounds, Item};
use super::pages::zeroed;
use super::radix;
use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::octree::{LARGEST_EXTENT, SMALLEST_EXTENT, duplicates, has_area};
use glam::{UVec3, Vec3, Vec4};
use rayon::prelude::*;
use std::ops::Range;

/// Items that are worked on at a time.
const BLOCK: usize = 1 << 13;
/// Bits of a code an axis, if they fit.
const BITS: u32 = 14;
/// More triangles of one code than this are sorted by codes of their own,
const CROWD: usize = 8;
/// of so many bits an axis.
const FINE_BITS: u32 = 21;

/// The triangles of a mesh that a ray can hit along Morton's curve, by the centres of their boxes.
pub struct MortonOrder {
    /// Ascending codes, and in the lowest bits the ids of the triangles.
    words: Vec<u64>,
    /// Bits of an id.
    rest: u32,
    /// Triangles without area, which are left out.
    pub degenerate: u32,
    /// Lowest coordinates of corners of the others, scene units.
    pub low: Vec3,
    /// Highest coordinates of those.
    pub high: Vec3,
}

impl MortonOrder {
    /// Sorts the triangles of a mesh.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to sort.
    pub fn new(mesh: &Mesh) -> Result<Self, BuildError> {
        let blocks = mesh.triangles.par_chunks(BLOCK).map(|triangles| {
            let (mut bounds, mut count) = (Bounds::EMPTY, 0);
            for triangle in triangles {
                let corners = mesh.corners(triangle);
                if has_area(&corners) {
                    bounds = bounds.and(Bounds::of(&Item::new(0, corners)));
                    count += 1;
                }
            }
            (bounds, count)
        });
        let (bounds, count) = blocks.reduce(|| (Bounds::EMPTY, 0), |a, b| (a.0.and(b.0), a.1 + b.1));
        if count == 0 {
            return Err(BuildError::NoArea);
        }
        let size = (bounds.high - bounds.low).truncate().max_element();
        let extent = (bounds.high - bounds.low).truncate().as_dvec3().max_element();
        if !(f64::from(SMALLEST_EXTENT)..=f64::from(LARGEST_EXTENT)).contains(&extent) {
            return Err(BuildError::Extent(extent as f32));
        }
        let degenerate = (mesh.triangles.len() - count) as u32;
        // One id more than there are, so that no word is all ones.
        let rest = usize::BITS - mesh.triangles.len().leading_zeros();
        let bits = BITS.min((u64::BITS - rest) / 3);
        // A cube of cells; of centres doubled.
        let scale = Vec4::splat(0.5 * (1_u32 << bits) as f32 / size);
        let last = (1_u32 << bits) - 1;
        let low = bounds.low + bounds.low;
        let word = |id: usize, corners: [Vec3; 3]| {
            let cell = ((Item::new(0, corners).centre() - low) * scale).truncate().as_uvec3();
            code(cell.min(UVec3::splat(last))) << rest | id as u64
        };
        let mut words: Vec<u64> = zeroed(mesh.triangles.len());
        let blocks = words.par_chunks_mut(BLOCK).zip(mesh.triangles.par_chunks(BLOCK));
        blocks.enumerate().for_each(|(block, (words, triangles))| {
            for (id, (place, triangle)) in (block * BLOCK..).zip(words.iter_mut().zip(triangles)) {
                let corners = mesh.corners(triangle);
                *place = if degenerate == 0 || has_area(&corners) {
                    word(id, corners)
                } else {
                    u64::MAX
                };
            }
        });
        if degenerate > 0 {
            words.retain(|word| *word != u64::MAX);
        }
        let mut words = radix::sorted(words, rest, 3 * bits);
        words
            .par_chunk_by_mut(|a, b| a >> rest == b >> rest)
            .filter(|words| words.len() > CROWD)
            .for_each(|words| {
                refine(words, rest, |id| {
                    Item::new(0, mesh.corners(&mesh.triangles[id])).centre()
                })
            });
        Ok(MortonOrder {
            words,
            rest,
            degenerate,
            low: bounds.low.truncate(),
            high: bounds.high.truncate(),
        })
    }

    /// The triangles' boxes in that order.
    pub(super) fn items(&self, mesh: &Mesh) -> Vec<Item> {
        // Fetched from all over memory at once, not one by one when they are needed.
        let mut items = zeroed(self.len());
        items
            .par_iter_mut()
            .enumerate()
            .with_min_len(BLOCK)
            .for_each(|(place, item)| {
                let id = self.id(place);
                *item = Item::new(id, mesh.corners(&mesh.triangles[id as usize]));
            });
        items
    }

    /// The triangle at a place.
    pub(super) fn id(&self, place: usize) -> u32 {
        (self.words[place] & ((1 << self.rest) - 1)) as u32
    }

    /// Number of items.
    pub(super) fn len(&self) -> usize {
        self.words.len()
    }

    /// Where the items of the upper half of a range's smallest cell begin, else of the second half of the range.
    pub(super) fn middle(&self, range: Range<usize>) -> usize {
        range.start + middle(&self.words[range], self.rest)
    }

    /// Ids of triangles that lie exactly on one with a lower id, ascending.
    pub fn duplicates(&self, mesh: &Mesh) -> Vec<u32> {
        // The centres of their boxes are in one cell.
        let words = &self.words;
        let same = |a: usize, b: usize| words[a] >> self.rest == words[b] >> self.rest;
        let is_crowded = |&at: &usize| at > 0 && same(at - 1, at) || at + 1 < words.len() && same(at, at + 1);
        let blocks = (0..words.len().div_ceil(BLOCK)).into_par_iter();
        let crowded: Vec<u32> = blocks
            .flat_map_iter(|block| {
                let places = block * BLOCK..words.len().min((block + 1) * BLOCK);
                places.filter(is_crowded).map(|at| self.id(at))
            })
            .collect();
        let duplicates = duplicates(mesh, &crowded);
        let mut ids: Vec<u32> = duplicates.into_iter().map(|at| crowded[at as usize]).collect();
        ids.sort_unstable();
        ids
    }

    /// Puts together what is in one cell where it is few, reordering the items there: boxes around those from the place
    /// that is their number on.
    pub(super) fn clusters(&self, items: &mut [Item], most: usize) -> Vec<Item> {
        clusters(&self.words, items, 0, self.rest, most)
    }
}

/// Where the words of the upper half of the smallest cell around all begin, else of the second half.
fn middle(words: &[u64], rest: u32) -> usize {
    if is_one(words, rest) {
        return words.len() / 2;
    }
    // The highest bit that differs is set in the upper half.
    let bit = (words[0] ^ words[words.len() - 1]).ilog2();
    words.partition_point(|word| word >> bit & 1 == 0)
}

/// Sorts words of one code along a finer curve of their own: what is small in a large scene has few cells.
fn refine(words: &mut [u64], rest: u32, centre: impl Fn(usize) -> Vec4) {
    let centre = |word: &u64| centre((word & ((1 << rest) - 1)) as usize);
    let (low, high) = words
        .iter()
        .map(centre)
        .fold((Vec4::INFINITY, Vec4::NEG_INFINITY), |(low, high), centre| {
            (low.min(centre), high.max(centre))
        });
    let size = (high - low).truncate().max_element().max(f32::MIN_POSITIVE);
    let last = (1_u32 << FINE_BITS) - 1;
    words.sort_by_cached_key(|word| {
        let cell = ((centre(word) - low) / size * last as f32).truncate().as_uvec3();
        (code(cell.min(UVec3::splat(last))), *word)
    });
}

/// The code of a cell.
fn code(cell: UVec3) -> u64 {
    spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2
}

/// Whether all codes are the same.
fn is_one(words: &[u64], rest: u32) -> bool {
    words[0] >> rest == words[words.len() - 1] >> rest
}

/// Items that are clustered by one thread.
const PARALLEL: usize = 1 << 13;
/// An item whose box has this part of its cluster's surface is a cluster of its own: it would make it too large.
const LARGE: f32 = 0.25;

/// Clusters of up to so many items that are in one cell, or of as many as have one code; `words` are the items', `first` is
/// the place of the first.
fn clusters(words: &[u64], items: &mut [Item], first: u32, rest: u32, most: usize) -> Vec<Item> {
    if items.len() > PARALLEL && !is_one(words, rest) {
        let middle = middle(words, rest);
        let (below, above) = words.split_at(middle);
        let (items_below, items_above) = items.split_at_mut(middle);
        let (mut all, mut others) = rayon::join(
            || clusters(below, items_below, first, rest, most),
            || clusters(above, items_above, first + middle as u32, rest, most),
        );
        all.append(&mut others);
        return all;
    }
    let mut all = Vec::with_capacity(4 * items.len() / most);
    let mut open: Vec<Range<usize>> = std::iter::once(0..items.len()).collect();
    while let Some(range) = open.pop() {
        if range.len() > most && !is_one(&words[range.clone()], rest) {
            let middle = range.start + middle(&words[range.clone()], rest);
            open.extend([middle..range.end, range.start..middle]);
            continue;
        }
        let first = first + range.start as u32;
        let items = &mut items[range];
        let largest = LARGE * Bounds::of(&Item::round(0, items)).area();
        let mut own = 0;
        for i in 0..items.len() {
            if Bounds::of(&items[i]).area() >= largest {
                items.swap(i, own);
                all.push(Item::round(first + own as u32, &items[own..own + 1]));
                own += 1;
            }
        }
        if own < items.len() {
            all.push(Item::round(first + own as u32, &items[own..]));
        }
    }
    all
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
