//! Building an octree, level by level.

use super::Octree;
use super::options::OctreeOptions;
use super::overlap::overlapped_children;
use super::prune::{CHILD_CHANCE, Cells, levels, pruned};
use super::root::{no_deeper, root};
use crate::build_error::BuildError;
use crate::hittable::Hittable;
use crate::mesh::Mesh;
use crate::progress::Progress;
use glam::{UVec3, Vec3};
use oktant_shared::octree::{CELL_MARGIN, INNER, Node, Root};
use rayon::prelude::*;

/// References of a tree that is yet to be pruned, in budgets: the first levels of what is large must leave room for what is small.
const UNPRUNED: usize = 4;

/// A cell that may yet be split.
struct Open {
    /// Its index among the nodes.
    node: u32,
    /// Its corner, in smallest cells from the root's.
    place: UVec3,
    /// Its references within the level's list.
    first: usize,
    count: usize,
}

/// A way to split a cell.
struct Split {
    /// Index of the cell among the open ones.
    cell: usize,
    /// References of each child.
    counts: [u32; 8],
    /// Sum of `counts`.
    total: usize,
}

pub(super) fn build(mesh: &Mesh, options: &OctreeOptions, progress: Progress<'_>) -> Result<Octree, BuildError> {
    let hittable = Hittable::of(mesh)?;
    let root = root(hittable.low, hittable.high, options.depth)?;
    // Nodes count references in 32 bits.
    let times = |count: usize, factor: usize| count.saturating_mul(factor).min(u32::MAX as usize);
    let budget = times(hittable.ids.len(), options.budget as usize);
    let count = hittable.ids.len() as u32;
    let cells = Levels {
        corners: &hittable.corners,
        root: &root,
        options,
        budget: if options.leaf.is_some() {
            budget
        } else {
            times(budget, UNPRUNED)
        },
        cells: Cells {
            nodes: vec![Node { first: 0, count }],
            counts: vec![count],
            references: Vec::new(),
        },
    }
    .split_all(hittable.ids, progress);
    let cells = match options.leaf {
        Some(_) => cells,
        None => pruned(cells, &options.costs, budget),
    };
    Ok(Octree {
        root: no_deeper(root, u32::from(levels(&cells.nodes).into_iter().max().unwrap_or(0))),
        nodes: cells.nodes,
        references: cells.references,
        degenerate: hittable.degenerate,
        duplicates: hittable.duplicates,
    })
}

/// The state of a build.
struct Levels<'a> {
    corners: &'a [[Vec3; 3]],
    root: &'a Root,
    options: &'a OctreeOptions,
    /// References at most.
    budget: usize,
    /// What is finished.
    cells: Cells,
}

impl Levels<'_> {
    fn split_all(mut self, ids: Vec<u32>, progress: Progress<'_>) -> Cells {
        let mut list = ids;
        let mut open = vec![Open {
            node: 0,
            place: UVec3::ZERO,
            first: 0,
            count: list.len(),
        }];
        for level in 0..=self.root.depth {
            if open.is_empty() {
                break;
            }
            progress("building", level as f32 / (self.root.depth + 1) as f32);
            (open, list) = self.split_level(open, list, self.root.depth - level);
        }
        progress("building", 1.0);
        self.cells
    }

    /// Whether splitting a cell may be worth it.
    fn may_split(&self, cell: &Open) -> bool {
        match self.options.leaf {
            Some(leaf) => cell.count > leaf as usize,
            // A split costs at least a step more.
            None => self.options.costs.triangle * cell.count as f32 > self.options.costs.node,
        }
    }

    /// Splits those cells of a level that are worth it, finishes the others, and returns the children with their list.
    /// The cells' edges are `2^size` smallest cells long.
    fn split_level(&mut self, open: Vec<Open>, list: Vec<u32>, size: u32) -> (Vec<Open>, Vec<u32>) {
        let masks = self.masks(&open, &list, size);
        let mut splits = self.paying(&open, &masks, size);
        self.keep_budget(&open, &list, &mut splits);

        let mut next = Vec::with_capacity(splits.len() * 4);
        let mut kept = vec![true; open.len()];
        let mut length = 0;
        for split in &splits {
            let cell = &open[split.cell];
            kept[split.cell] = false;
            let first = self.cells.nodes.len() as u32;
            self.cells.nodes[cell.node as usize] = Node { first, count: INNER };
            for (child, count) in split.counts.iter().enumerate() {
                let child = child as u32;
                self.cells.nodes.push(Node { first: 0, count: 0 });
                self.cells.counts.push(*count);
                if *count > 0 {
                    let upper = UVec3::new(child & 1, child >> 1 & 1, child >> 2);
                    next.push(Open {
                        node: first + child,
                        place: cell.place + (upper << (size - 1)),
                        first: length,
                        count: *count as usize,
                    });
                    length += *count as usize;
                }
            }
        }
        for (cell, kept) in open.iter().zip(&kept) {
            if *kept {
                self.cells.nodes[cell.node as usize] = Node {
                    first: self.cells.references.len() as u32,
                    count: cell.count as u32,
                };
                self.cells
                    .references
                    .extend_from_slice(&list[cell.first..cell.first + cell.count]);
            }
        }
        (next, scatter(&open, &list, &masks, &splits, length))
    }

    /// For each entry of the list, the children of its cell that it overlaps; nothing at the last level.
    fn masks(&self, open: &[Open], list: &[u32], size: u32) -> Vec<u8> {
        let mut masks = vec![0_u8; list.len()];
        if size == 0 {
            return masks;
        }
        let half = self.root.cell * (1_u32 << (size - 1)) as f32;
        let margin = self.root.size() * CELL_MARGIN;
        // Cells differ in size, so the list is cut into even pieces and each finds the cells it covers.
        const PIECE: usize = 4096;
        masks.par_chunks_mut(PIECE).enumerate().for_each(|(piece, masks)| {
            let begin = piece * PIECE;
            let mut cell = open.partition_point(|cell| cell.first <= begin) - 1;
            for (mask, i) in masks.iter_mut().zip(begin..) {
                if i >= open[cell].first + open[cell].count {
                    cell += 1;
                }
                if self.may_split(&open[cell]) {
                    let place = open[cell].place;
                    let corner = Vec3::new(place.x as f32, place.y as f32, place.z as f32);
                    let center = self.root.low + corner * self.root.cell + half;
                    *mask = overlapped_children(&self.corners[list[i] as usize], center, half, margin);
                }
            }
        });
        masks
    }

    /// The splits that lower the expected cost of a ray through the cell; with a limit of references, all beyond it.
    ///
    /// J. D. MacDonald and K. S. Booth, "Heuristics for ray tracing using space subdivision", The Visual Computer 6, 1990: a ray
    /// passes through a child with the probability that its surface has of the cell's.
    fn paying(&self, open: &[Open], masks: &[u8], size: u32) -> Vec<Split> {
        if size == 0 {
            return Vec::new();
        }
        let costs = &self.options.costs;
        open.par_iter()
            .enumerate()
            .filter(|(_, cell)| self.may_split(cell))
            .filter_map(|(index, cell)| {
                let mut counts = [0_u32; 8];
                for mask in &masks[cell.first..cell.first + cell.count] {
                    for (child, count) in counts.iter_mut().enumerate() {
                        *count += u32::from(mask >> child & 1);
                    }
                }
                let total = counts.iter().sum::<u32>() as usize;
                let pays =
                    costs.node + costs.triangle * (CHILD_CHANCE * total as f32) < costs.triangle * cell.count as f32;
                (self.options.leaf.is_some() || pays).then_some(Split {
                    cell: index,
                    counts,
                    total,
                })
            })
            .collect()
    }

    /// Drops the splits that multiply references most, until all fit the budget.
    fn keep_budget(&self, open: &[Open], list: &[u32], splits: &mut Vec<Split>) {
        let grown = |split: &Split| split.total.saturating_sub(open[split.cell].count);
        let mut references = self.cells.references.len() + list.len() + splits.iter().map(grown).sum::<usize>();
        if references <= self.budget {
            return;
        }
        let growth = |split: &Split| split.total as f32 / open[split.cell].count as f32;
        splits.sort_by(|a, b| growth(a).total_cmp(&growth(b)).then(a.cell.cmp(&b.cell)));
        while references > self.budget {
            let Some(split) = splits.pop() else { break };
            references -= grown(&split);
        }
        splits.sort_by_key(|split| split.cell);
    }
}

/// The lists of the children, in the order of the splits, child by child, each in the order of its parent's.
fn scatter(open: &[Open], list: &[u32], masks: &[u8], splits: &[Split], length: usize) -> Vec<u32> {
    let mut next = vec![0_u32; length];
    let mut pieces = Vec::with_capacity(splits.len());
    let mut rest = next.as_mut_slice();
    for split in splits {
        let (piece, after) = rest.split_at_mut(split.total);
        pieces.push((split, piece));
        rest = after;
    }
    pieces.into_par_iter().for_each(|(split, piece)| {
        let cell = &open[split.cell];
        let mut cursors = [0_usize; 8];
        let mut sum = 0;
        for (cursor, count) in cursors.iter_mut().zip(split.counts) {
            *cursor = sum;
            sum += count as usize;
        }
        for i in cell.first..cell.first + cell.count {
            let mut mask = masks[i];
            while mask != 0 {
                let child = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                piece[cursors[child]] = list[i];
                cursors[child] += 1;
            }
        }
    });
    next
}
