//! Writing the nodes and slots of a wide tree, in parallel, each at its place.

use super::binary::BinaryTree;
use super::collapse::{CollapseOptions, Decisions, children, decide};
use super::flatten::flatten;
use super::pages::zeroed;
use super::slots::{Placing, place};
use super::wide::{WIDTH, WideChild, WideNode};
use bytemuck::Zeroable;
use glam::Vec3;

/// The arrays of a wide tree whose nodes are of any form.
#[derive(Clone, Debug)]
pub struct WideArrays<N> {
    /// The nodes, the root first; behind the children of a node all nodes below the first of them, and so on.
    pub nodes: Vec<N>,
    /// The triangle in each slot: behind those of a node's leaves all those of its first child that is a node, and so
    /// on.
    pub order: Vec<u32>,
}

impl BinaryTree {
    /// Makes a wide tree of it whose nodes are what `encode` makes of each.
    pub fn to_wide<N: Zeroable + Send>(
        &self,
        options: &CollapseOptions,
        encode: impl Fn(&WideNode) -> N + Sync,
    ) -> WideArrays<N> {
        let mut decisions = decide(self, options);
        let (arrays, deepest) = self.written(&decisions, options.placing, &encode);
        if deepest <= options.levels {
            return arrays;
        }
        flatten(self, &mut decisions, options.levels);
        self.written(&decisions, options.placing, &encode).0
    }

    /// The wide tree as it was decided, and its deepest level.
    fn written<N: Zeroable + Send>(
        &self,
        decisions: &Decisions,
        placing: Placing,
        encode: &(impl Fn(&WideNode) -> N + Sync),
    ) -> (WideArrays<N>, u32) {
        let count = decisions.of(&self.nodes[0]).nodes.max(1) as usize;
        let mut nodes = zeroed(count);
        let mut order = zeroed(self.order.len());
        let (root, below) = nodes.split_at_mut(1);
        let writer = Writer {
            tree: self,
            decisions,
            placing,
            encode,
        };
        let deepest = writer.subtree(
            0,
            &mut root[0],
            Place {
                nodes: below,
                first_node: 1,
                order: &mut order,
                first_triangle: 0,
            },
        );
        (WideArrays { nodes, order }, deepest)
    }
}

/// Where the nodes and triangles below a node go.
struct Place<'a, N> {
    nodes: &'a mut [N],
    /// Index of the first of the nodes.
    first_node: u32,
    order: &'a mut [u32],
    /// Slot of the first of the triangles.
    first_triangle: u32,
}

struct Writer<'a, E> {
    tree: &'a BinaryTree,
    decisions: &'a Decisions,
    placing: Placing,
    encode: &'a E,
}

/// Subtrees with fewer triangles are written by one thread.
const PARALLEL: usize = 4096;

impl<E> Writer<'_, E> {
    /// Writes the wide node in the place of a binary one, and all below it; how many levels these have.
    fn subtree<N: Send>(&self, index: u32, node: &mut N, place: Place<'_, N>) -> u32
    where
        E: Fn(&WideNode) -> N + Sync,
    {
        let (wide, inner) = self.node(index, place.first_node, place.first_triangle, place.order);
        *node = (self.encode)(&wide);
        let inner = &inner.indices[..inner.count];
        let leaves = wide_leaf_triangles(&wide);
        let (own, nodes) = place.nodes.split_at_mut(inner.len());
        self.below(
            inner,
            own,
            Place {
                nodes,
                first_node: place.first_node + inner.len() as u32,
                order: &mut place.order[leaves as usize..],
                first_triangle: place.first_triangle + leaves,
            },
        )
    }

    /// Writes the nodes in the places of some binary ones, and all below them; how many levels they have in all.
    fn below<N: Send>(&self, inner: &[u32], own: &mut [N], place: Place<'_, N>) -> u32
    where
        E: Fn(&WideNode) -> N + Sync,
    {
        match inner {
            [] => 0,
            [index] => 1 + self.subtree(*index, &mut own[0], place),
            _ => {
                let (first, second) = inner.split_at(inner.len() / 2);
                let (first_own, second_own) = own.split_at_mut(first.len());
                let of = |index: &u32| self.decisions.of(&self.tree.nodes[*index as usize]);
                let nodes: u32 = first.iter().map(|index| of(index).nodes - 1).sum();
                let triangles: u32 = first.iter().map(|index| of(index).triangles).sum();
                let large = place.order.len() >= PARALLEL;
                let (first_nodes, second_nodes) = place.nodes.split_at_mut(nodes as usize);
                let (first_order, second_order) = place.order.split_at_mut(triangles as usize);
                let first_place = Place {
                    nodes: first_nodes,
                    first_node: place.first_node,
                    order: first_order,
                    first_triangle: place.first_triangle,
                };
                let second_place = Place {
                    nodes: second_nodes,
                    first_node: place.first_node + nodes,
                    order: second_order,
                    first_triangle: place.first_triangle + triangles,
                };
                let first = || self.below(first, first_own, first_place);
                let second = || self.below(second, second_own, second_place);
                let (first, second) = if large {
                    rayon::join(first, second)
                } else {
                    (first(), second())
                };
                first.max(second)
            }
        }
    }

    /// The wide node in the place of a binary one; writes the slots of its leaves.
    fn node(&self, index: u32, first_node: u32, first_triangle: u32, order: &mut [u32]) -> (WideNode, Children) {
        let (binary, decisions) = (&self.tree.nodes, self.decisions);
        let mut all = Children::default();
        children(binary, decisions, index, &mut |child| all.push(child));
        let parent = &binary[index as usize];
        let found = &all.indices[..all.count];
        let mut centres = [Vec3::ZERO; WIDTH];
        for (centre, child) in centres.iter_mut().zip(found) {
            let child = &binary[*child as usize];
            *centre = child.low * 0.5 + child.high * 0.5;
        }
        let slots = place(
            self.placing,
            parent.low * 0.5 + parent.high * 0.5,
            &centres[..found.len()],
        );
        let mut wide = WideNode {
            first_node,
            first_triangle,
            ..WideNode::EMPTY
        };
        let mut inner = Children::default();
        let mut written = 0;
        for (slot, child) in slots.into_iter().enumerate() {
            let Some(child) = child else { continue };
            let child = found[child as usize];
            let node = &binary[child as usize];
            let decision = decisions.of(node);
            for axis in 0..3 {
                wide.low[axis][slot] = node.low[axis];
                wide.high[axis][slot] = node.high[axis];
            }
            if decision.is_leaf() {
                let source = first_slot(&self.tree.nodes, child) as usize;
                let count = decision.triangles as usize;
                order[written..written + count].copy_from_slice(&self.tree.order[source..source + count]);
                wide.children[slot] = WideChild::Leaf {
                    first: first_triangle + written as u32,
                    count: decision.triangles,
                };
                written += count;
            } else {
                wide.children[slot] = WideChild::Inner(first_node + inner.count as u32);
                inner.push(child);
            }
        }
        (wide, inner)
    }
}

/// Binary nodes that stand for the children of a wide one.
#[derive(Default)]
struct Children {
    indices: [u32; WIDTH],
    count: usize,
}

impl Children {
    fn push(&mut self, index: u32) {
        self.indices[self.count] = index;
        self.count += 1;
    }
}

/// The first slot of a binary subtree.
fn first_slot(nodes: &[super::BinaryNode], mut index: u32) -> u32 {
    while nodes[index as usize].is_inner() {
        index = nodes[index as usize].first;
    }
    nodes[index as usize].first
}

fn wide_leaf_triangles(node: &WideNode) -> u32 {
    node.children
        .iter()
        .map(|child| {
            if let WideChild::Leaf { count, .. } = child {
                *count
            } else {
                0
            }
        })
        .sum()
}
