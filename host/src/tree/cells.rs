//! A wide tree straight from sorted Morton codes.

use super::morton::MortonOrder;
use super::pages::zeroed;
use super::preset::reporter;
use super::slots::{Placing, place};
use super::wide::{MAX_LEAF, WIDTH, WideChild, WideNode};
use crate::mesh::Mesh;
use crate::progress::Progress;
use bytemuck::Zeroable;
use glam::Vec3;
use oktant_shared::triangle::Triangle;
use rayon::prelude::*;
use std::ops::Range;

/// A tree of nodes of any form over the cells of Morton's curve, with its triangles: no binary tree comes before it, which
/// takes longer to write and read than all of this.
///
/// A node's children are what is left of its cell after the cell of the most triangles was halved seven times.
pub struct CellTree<N> {
    /// The nodes, the root first; children lie side by side behind their parents.
    pub nodes: Vec<N>,
    /// The triangles by slot.
    pub triangles: Vec<Triangle>,
    /// Their ids by slot.
    pub ids: Vec<u32>,
}

/// Most triangles of a leaf.
const LEAF: usize = MAX_LEAF as usize;
/// Subtrees of fewer triangles are built by one thread.
const PARALLEL: usize = 1 << 13;
/// From this level on cells are halved by number, so that no node is deeper than kernels go.
const HALVING_LEVEL: u32 = 20;

impl<N: Copy + Zeroable + Send + Sync> CellTree<N> {
    /// Builds the tree over sorted triangles; the same one whatever the number of threads. A node is what `encode` makes of
    /// its children; `shift` adds to the index of its first child that is a node.
    pub fn build(
        order: &MortonOrder,
        mesh: &Mesh,
        encode: impl Fn(&WideNode) -> N + Sync,
        shift: impl Fn(&mut N, u32) + Sync,
        progress: Progress<'_>,
    ) -> Self {
        let count = order.len();
        let (mut triangles, mut ids) = (zeroed(count), zeroed(count));
        let builder = Builder {
            mesh,
            order,
            encode,
            shift,
            report: &reporter(count, progress),
        };
        let slots = Slots {
            first: 0,
            triangles: &mut triangles,
            ids: &mut ids,
        };
        let (mut root, mut pieces) = builder.crown(0..count, 0, slots);
        (builder.shift)(&mut root.node, 1);
        let mut nodes = zeroed(1 + pieces.iter().map(|piece| piece.nodes.len()).sum::<usize>());
        nodes[0] = root.node;
        let mut below = &mut nodes[1..];
        let pairs: Vec<_> = pieces
            .drain(..)
            .map(|piece| {
                let (own, others) = std::mem::take(&mut below).split_at_mut(piece.nodes.len());
                below = others;
                (own, piece)
            })
            .collect();
        pairs.into_par_iter().for_each(|(own, piece)| {
            own.copy_from_slice(&piece.nodes);
            own.iter_mut().for_each(|node| (builder.shift)(node, 1 + piece.by));
        });
        CellTree { nodes, triangles, ids }
    }
}

/// Where the triangles of a subtree go.
struct Slots<'a> {
    /// The first of the slots.
    first: u32,
    triangles: &'a mut [Triangle],
    ids: &'a mut [u32],
}

impl<'a> Slots<'a> {
    /// The first so many, which are then gone.
    fn take(&mut self, count: usize) -> Slots<'a> {
        let (triangles, other_triangles) = std::mem::take(&mut self.triangles).split_at_mut(count);
        let (ids, other_ids) = std::mem::take(&mut self.ids).split_at_mut(count);
        let first = self.first;
        (self.first, self.triangles, self.ids) = (first + count as u32, other_triangles, other_ids);
        Slots { first, triangles, ids }
    }
}

/// The root of a subtree and the box around it.
#[derive(Clone, Copy)]
struct Made<N> {
    node: N,
    low: Vec3,
    high: Vec3,
}

/// Nodes that lie side by side.
struct Piece<N> {
    nodes: Vec<N>,
    /// What their children's indices lack.
    by: u32,
}

/// The children of a node.
struct Family<N> {
    /// What of the sorted triangles is in them.
    ranges: [Range<usize>; WIDTH],
    count: usize,
    /// Their roots, which leaves do not have, and boxes.
    made: [Made<N>; WIDTH],
}

impl<N> Family<N> {
    /// The children that are nodes.
    fn inner(&self) -> impl Iterator<Item = usize> + use<N> {
        let counts = self.ranges.each_ref().map(Range::len);
        (0..self.count).filter(move |child| counts[*child] > LEAF)
    }
}

/// What is known while a tree is built.
struct Builder<'a, E, S> {
    mesh: &'a Mesh,
    order: &'a MortonOrder,
    encode: E,
    shift: S,
    /// Told how many more triangles are finished.
    report: &'a (dyn Fn(usize) + Sync),
}

impl<N: Copy + Zeroable + Send, E: Fn(&WideNode) -> N + Sync, S: Fn(&mut N, u32) + Sync> Builder<'_, E, S> {
    /// Makes the subtree over a range, in parallel; the nodes below its root piece by piece.
    fn crown(&self, range: Range<usize>, level: u32, mut slots: Slots<'_>) -> (Made<N>, Vec<Piece<N>>) {
        let triangles = range.len();
        if triangles < PARALLEL {
            let mut nodes = Vec::with_capacity(triangles / 7);
            let root = self.subtree(range, level, slots, &mut nodes);
            (self.report)(triangles);
            return (root, vec![Piece { nodes, by: 0 }]);
        }
        let first_slot = slots.first;
        let mut family = self.family(range, level, &mut slots);
        (self.report)(slots.first as usize - first_slot as usize);
        let tasks: Vec<_> = family
            .inner()
            .map(|child| {
                let range = family.ranges[child].clone();
                let slots = slots.take(range.len());
                (child, range, slots)
            })
            .collect();
        let made: Vec<_> = tasks
            .into_par_iter()
            .with_max_len(1)
            .map(|(child, range, slots)| (child, self.crown(range, level + 1, slots)))
            .collect();
        let mut next = made.len() as u32;
        let mut below = Vec::new();
        for (child, (mut root, pieces)) in made {
            (self.shift)(&mut root.node, next);
            family.made[child] = root;
            let by = next;
            for piece in pieces {
                next += piece.nodes.len() as u32;
                below.push(Piece {
                    by: by + piece.by,
                    ..piece
                });
            }
        }
        let mut nodes = Vec::new();
        let root = self.close(&family, first_slot, &mut nodes, 0);
        let mut pieces = vec![Piece { nodes, by: 0 }];
        pieces.append(&mut below);
        (root, pieces)
    }

    /// Makes the subtree over a range; the nodes below its root are appended to others.
    fn subtree(&self, range: Range<usize>, level: u32, mut slots: Slots<'_>, nodes: &mut Vec<N>) -> Made<N> {
        let first_slot = slots.first;
        let mut family = self.family(range, level, &mut slots);
        let first_node = nodes.len();
        nodes.resize(first_node + family.inner().count(), N::zeroed());
        for child in family.inner() {
            let range = family.ranges[child].clone();
            let slots = slots.take(range.len());
            family.made[child] = self.subtree(range, level + 1, slots, nodes);
        }
        self.close(&family, first_slot, nodes, first_node)
    }

    /// The children of a node over a range; of these, the leaves are made.
    fn family(&self, range: Range<usize>, level: u32, slots: &mut Slots<'_>) -> Family<N> {
        let mut family = Family {
            ranges: Default::default(),
            count: 1,
            made: [Made {
                node: N::zeroed(),
                low: Vec3::INFINITY,
                high: Vec3::NEG_INFINITY,
            }; WIDTH],
        };
        family.ranges[0] = range;
        while family.count < WIDTH {
            let (mut largest, mut most) = (0, 0);
            for (child, range) in family.ranges.iter().enumerate() {
                if range.len() > most {
                    (largest, most) = (child, range.len());
                }
            }
            if most == 1 {
                break;
            }
            let range = family.ranges[largest].clone();
            let middle = if level < HALVING_LEVEL {
                self.order.middle(range.clone())
            } else {
                range.start + most / 2
            };
            family.ranges[largest].end = middle;
            family.ranges[family.count] = middle..range.end;
            family.count += 1;
        }
        for child in 0..family.count {
            let range = family.ranges[child].clone();
            if range.len() <= LEAF {
                let made = &mut family.made[child];
                let slots = slots.take(range.len());
                for (place, (row, own_id)) in range.zip(slots.triangles.iter_mut().zip(slots.ids)) {
                    let id = self.order.id(place);
                    let triangle = self.mesh.triangle(id);
                    made.low = made.low.min(triangle.a).min(triangle.b).min(triangle.c);
                    made.high = made.high.max(triangle.a).max(triangle.b).max(triangle.c);
                    (*row, *own_id) = (triangle, id);
                }
            }
        }
        family
    }

    /// Makes a node of its children, and puts their roots at `first_node` or behind all nodes.
    fn close(&self, family: &Family<N>, first_slot: u32, nodes: &mut Vec<N>, first_node: usize) -> Made<N> {
        nodes.resize(nodes.len().max(first_node + family.inner().count()), N::zeroed());
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let mut centres = [Vec3::ZERO; WIDTH];
        let mut firsts = [0; WIDTH];
        let mut next_slot = first_slot;
        for (child, made) in family.made[..family.count].iter().enumerate() {
            (low, high) = (low.min(made.low), high.max(made.high));
            centres[child] = made.low * 0.5 + made.high * 0.5;
            firsts[child] = next_slot;
            if family.ranges[child].len() <= LEAF {
                next_slot += family.ranges[child].len() as u32;
            }
        }
        let mut wide = WideNode {
            first_node: first_node as u32,
            first_triangle: first_slot,
            ..WideNode::EMPTY
        };
        let mut next = first_node;
        let places = place(Placing::Greedy, low * 0.5 + high * 0.5, &centres[..family.count]);
        for (slot, child) in places.into_iter().enumerate() {
            let Some(child) = child.map(usize::from) else { continue };
            let made = &family.made[child];
            for axis in 0..3 {
                wide.low[axis][slot] = made.low[axis];
                wide.high[axis][slot] = made.high[axis];
            }
            let count = family.ranges[child].len();
            wide.children[slot] = if count <= LEAF {
                WideChild::Leaf {
                    first: firsts[child],
                    count: count as u32,
                }
            } else {
                nodes[next] = made.node;
                next += 1;
                WideChild::Inner(next as u32 - 1)
            };
        }
        Made {
            node: (self.encode)(&wide),
            low,
            high,
        }
    }
}
