//! Making a finished tree better by taking subtrees out and putting them where they cost less.

use super::binary::{BinaryNode, MAX_BINARY_DEPTH};
use super::items::Bounds;
use super::pages::zeroed;
use crate::progress::Progress;

/// Times that the largest nodes are reinserted.
const ROUNDS: usize = 3;
/// One of so many nodes is reinserted in a round.
const PART: usize = 2;
/// Reinsertions between two reports of progress.
const REPORT: usize = 1 << 10;

/// Reinserts the nodes of largest surface, one after the other, each where the sum of surfaces becomes smallest. `None`
/// where the tree would become too deep.
///
/// After Bittner, Hapala and Havran, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies", 2013, with the
/// search of Meister and Bittner, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", 2018; here one
/// after the other, so that the result does not depend on the number of threads.
pub(super) fn improve(
    nodes: &[BinaryNode],
    order: &[u32],
    progress: Progress<'_>,
) -> Option<(Vec<BinaryNode>, Vec<u32>)> {
    let mut tree = Loose::new(nodes);
    let count = (nodes.len() / PART).max(nodes.len().min(1000));
    for round in 0..ROUNDS {
        let mut largest: Vec<(f32, u32)> = (1..nodes.len() as u32)
            .map(|index| (tree.nodes[index as usize].area(), index))
            .collect();
        let descending = |a: &(f32, u32), b: &(f32, u32)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        if count < largest.len() {
            largest.select_nth_unstable_by(count, descending);
            largest.truncate(count);
        }
        largest.sort_unstable_by(descending);
        for (done, (_, index)) in largest.into_iter().enumerate() {
            if done % REPORT == 0 {
                progress("optimising", (round * count + done) as f32 / (ROUNDS * count) as f32);
            }
            if let Some(goal) = tree.find(index) {
                tree.reinsert(index, goal);
            }
        }
    }
    tree.laid_out(order)
}

/// A tree whose pairs of children lie anywhere behind the root.
struct Loose {
    nodes: Vec<BinaryNode>,
    /// The parent of each pair of children.
    parents: Vec<u32>,
    /// What is yet to be searched; kept for its memory.
    open: Vec<(u32, f32)>,
}

/// The other child of the same parent.
fn sibling(index: u32) -> u32 {
    // Pairs begin at odd indices.
    ((index - 1) ^ 1) + 1
}

fn bounds(node: &BinaryNode) -> Bounds {
    Bounds {
        low: node.low.extend(0.0),
        high: node.high.extend(0.0),
    }
}

impl Loose {
    fn new(nodes: &[BinaryNode]) -> Self {
        let mut parents = vec![0; nodes.len() / 2];
        for (index, node) in nodes.iter().enumerate().filter(|(_, node)| node.is_inner()) {
            parents[node.first as usize / 2] = index as u32;
        }
        Loose {
            nodes: nodes.to_vec(),
            parents,
            open: Vec::new(),
        }
    }

    fn parent(&self, index: u32) -> u32 {
        self.parents[(index as usize - 1) / 2]
    }

    fn bounds(&self, index: u32) -> Bounds {
        bounds(&self.nodes[index as usize])
    }

    /// The node that is best to become the sibling of `index`; `None` where nothing is better than what is.
    fn find(&mut self, index: u32) -> Option<u32> {
        let own = self.bounds(index);
        let area = own.area();
        let mut best = (0.0, None);
        // The ancestor below which is searched, on the side where the node is not; and what taking the node out saves
        // below that ancestor.
        let mut below = index;
        let mut pivot = self.parent(index);
        let mut saved = self.bounds(pivot).area();
        // The box of what remains below the ancestor.
        let mut rest = Bounds::EMPTY;
        loop {
            let other = sibling(below);
            self.open.push((other, saved));
            while let Some((candidate, saved)) = self.open.pop() {
                if saved - area <= best.0 {
                    continue;
                }
                let node = &self.nodes[candidate as usize];
                let with = bounds(node).and(own).area();
                let gain = saved - with;
                if gain > best.0 {
                    best = (gain, Some(candidate));
                }
                if node.is_inner() {
                    let saved = gain + node.area();
                    self.open.extend([(node.first + 1, saved), (node.first, saved)]);
                }
            }
            if pivot == 0 {
                return best.1.filter(|goal| *goal != sibling(index));
            }
            rest = rest.and(self.bounds(other));
            if below != index {
                saved += self.bounds(pivot).area() - rest.area();
            }
            below = pivot;
            pivot = self.parent(pivot);
        }
    }

    /// Makes a node the sibling of `goal`, which is neither its parent nor its sibling nor below it.
    fn reinsert(&mut self, index: u32, goal: u32) {
        let (parent, other) = (self.parent(index), sibling(index));
        // The sibling takes the parent's place, and the place of the sibling is free.
        self.put(parent, self.nodes[other as usize]);
        if parent != 0 {
            self.refit(self.parent(parent));
        }
        self.put(other, self.nodes[goal as usize]);
        self.nodes[goal as usize] = BinaryNode {
            first: index.min(other),
            count: 0,
            ..self.nodes[goal as usize]
        };
        self.parents[(index as usize - 1) / 2] = goal;
        self.refit(goal);
    }

    fn put(&mut self, index: u32, node: BinaryNode) {
        self.nodes[index as usize] = node;
        if node.is_inner() {
            self.parents[node.first as usize / 2] = index;
        }
    }

    /// Fits the boxes of a node and those above it to their children.
    fn refit(&mut self, mut index: u32) {
        loop {
            let first = self.nodes[index as usize].first as usize;
            let [a, b] = [self.nodes[first], self.nodes[first + 1]];
            let node = &mut self.nodes[index as usize];
            (node.low, node.high) = (a.low.min(b.low), a.high.max(b.high));
            if index == 0 {
                return;
            }
            index = self.parent(index);
        }
    }

    /// The nodes and slots in the order of a [`super::BinaryTree`].
    fn laid_out(&self, order: &[u32]) -> Option<(Vec<BinaryNode>, Vec<u32>)> {
        let mut nodes = zeroed(self.nodes.len());
        let mut slots = Vec::with_capacity(order.len());
        let mut next = 1;
        // From where, to where, level. The first child last, so that it comes first.
        let mut open = vec![(0, 0, 0)];
        while let Some((from, to, level)) = open.pop() {
            if level > MAX_BINARY_DEPTH {
                return None;
            }
            let node: &BinaryNode = &self.nodes[from];
            let first = if node.is_inner() {
                let from = node.first as usize;
                open.extend([(from + 1, next + 1, level + 1), (from, next, level + 1)]);
                next += 2;
                next - 2
            } else {
                let source = node.first as usize;
                let first = slots.len();
                slots.extend_from_slice(&order[source..source + node.count as usize]);
                first
            };
            nodes[to] = BinaryNode {
                first: first as u32,
                ..*node
            };
        }
        Some((nodes, slots))
    }
}
