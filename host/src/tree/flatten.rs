//! Keeping a wide tree within the levels for which kernels have a stack.

use super::binary::{BinaryNode, BinaryTree};
use super::collapse::{Decisions, children};
use super::wide::WIDTH;

/// Changes decisions so that no wide node is beyond the level `deepest`; the root's is 0.
///
/// The cheapest tree is kept wherever it stays above. On the way to what would be deeper, a wide node opens the tallest of
/// its children instead, until it has eight: that takes three levels of the binary tree at least, for seven openings are all
/// nodes of the first three levels. So the [`super::MAX_BINARY_DEPTH`] levels of a binary tree become 32 at most, and `deepest`
/// may be anything from 31 on.
///
/// It is needed where triangles are so small that f32 holds no surface of their boxes, and any tree costs the same.
pub(super) fn flatten(tree: &BinaryTree, decisions: &mut Decisions, deepest: u32) {
    let mut flattening = Flattening {
        heights: vec![0; tree.nodes.len() / 2],
        levels: vec![0; tree.nodes.len() / 2],
        nodes: &tree.nodes,
        decisions,
        deepest,
    };
    flattening.measure();
    flattening.node(0, 0);
}

struct Flattening<'a> {
    nodes: &'a [BinaryNode],
    decisions: &'a mut Decisions,
    deepest: u32,
    /// Of each binary node that becomes no leaf, the levels of such nodes from it down, by its pair of children.
    heights: Vec<u8>,
    /// The same of the wide nodes in its place in the cheapest tree, less one.
    levels: Vec<u8>,
}

impl Flattening<'_> {
    /// Fills heights and levels.
    fn measure(&mut self) {
        // Children are behind their parents.
        for index in (0..self.nodes.len() as u32).rev() {
            if self.is_leaf(index) {
                continue;
            }
            let pair = self.pair(index);
            let first = self.nodes[index as usize].first;
            self.heights[pair] = 1 + self.height(first).max(self.height(first + 1));
            let mut levels = 0;
            children(self.nodes, self.decisions, index, &mut |child| {
                if !self.is_leaf(child) {
                    levels = levels.max(1 + self.levels[self.pair(child)]);
                }
            });
            self.levels[pair] = levels;
        }
    }

    /// Whether a binary node becomes a leaf if it is one child.
    fn is_leaf(&self, index: u32) -> bool {
        self.decisions.of(&self.nodes[index as usize]).is_leaf()
    }

    /// The place of what is known of a node with children.
    fn pair(&self, index: u32) -> usize {
        self.nodes[index as usize].first as usize / 2
    }

    fn height(&self, index: u32) -> u8 {
        if self.is_leaf(index) {
            0
        } else {
            self.heights[self.pair(index)]
        }
    }

    /// Decides for the wide node in the place of a binary one, and for all below it; how many these are.
    fn node(&mut self, index: u32, level: u32) -> u32 {
        if level + u32::from(self.levels[self.pair(index)]) <= self.deepest {
            return self.decisions.of(&self.nodes[index as usize]).nodes;
        }
        let mut opened = vec![index];
        let first = self.nodes[index as usize].first;
        let mut found = vec![first, first + 1];
        while found.len() < WIDTH {
            let tallest = (0..found.len())
                .max_by_key(|&i| self.height(found[i]))
                .expect("there are two");
            if self.height(found[tallest]) == 0 {
                break;
            }
            let first = self.nodes[found[tallest] as usize].first;
            opened.push(found[tallest]);
            found[tallest] = first;
            found.push(first + 1);
        }
        self.share(index, &opened);
        let mut nodes = 1;
        for child in found {
            if !self.is_leaf(child) {
                nodes += self.node(child, level + 1);
            }
        }
        self.decisions.of_mut(&self.nodes[index as usize]).nodes = nodes;
        nodes
    }

    /// Writes down which nodes are opened from one down; how many children it has then.
    fn share(&mut self, index: u32, opened: &[u32]) -> usize {
        if !opened.contains(&index) {
            return 1;
        }
        let node = &self.nodes[index as usize];
        let first = self.share(node.first, opened);
        let second = self.share(node.first + 1, opened);
        self.decisions.of_mut(node).open(first, second);
        first + second
    }
}
