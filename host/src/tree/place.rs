//! Where the nodes and slots of a subtree go: known before it is built, for every leaf holds one triangle.

use super::binary::BinaryNode;
use super::items::Item;

/// Subtrees with fewer triangles are built by one thread.
pub(super) const PARALLEL: usize = 2048;

/// Where the nodes and slots of a subtree go.
pub(super) struct Place<'a> {
    /// The nodes below the subtree's root: two less than twice its triangles.
    nodes: &'a mut [BinaryNode],
    /// Index of the first of those in the tree.
    first_node: u32,
    /// Its triangles by slot.
    order: &'a mut [u32],
    /// The first of its slots.
    first_slot: u32,
    /// Level of its root.
    pub level: u32,
}

/// Where two children go.
pub(super) struct Pair<'a> {
    nodes: &'a mut [BinaryNode],
    first: u32,
}

impl<'a> Place<'a> {
    /// Of the whole tree but its root.
    pub fn new(nodes: &'a mut [BinaryNode], order: &'a mut [u32]) -> Self {
        Place {
            nodes,
            first_node: 1,
            order,
            first_slot: 0,
            level: 0,
        }
    }

    /// Triangles of the subtree.
    pub fn triangles(&self) -> usize {
        self.order.len()
    }

    /// The places of two children, and below each, the first with so many triangles.
    #[inline]
    pub fn split(self, triangles: usize) -> (Pair<'a>, Place<'a>, Place<'a>) {
        let (pair, below) = self.nodes.split_at_mut(2);
        let (first_nodes, second_nodes) = below.split_at_mut(2 * (triangles - 1));
        let (first_order, second_order) = self.order.split_at_mut(triangles);
        let pair = Pair {
            nodes: pair,
            first: self.first_node,
        };
        let first = Place {
            nodes: first_nodes,
            first_node: self.first_node + 2,
            order: first_order,
            first_slot: self.first_slot,
            level: self.level + 1,
        };
        let second = Place {
            nodes: second_nodes,
            first_node: self.first_node + 2 * triangles as u32,
            order: second_order,
            first_slot: self.first_slot + triangles as u32,
            level: self.level + 1,
        };
        (pair, first, second)
    }

    /// The leaf that is all there is of the subtree.
    #[inline]
    pub fn leaf(self, item: &Item) -> BinaryNode {
        self.order[0] = item.id();
        BinaryNode {
            low: item.low().truncate(),
            high: item.high().truncate(),
            first: self.first_slot,
            count: 1,
        }
    }
}

impl Pair<'_> {
    /// Writes the children; their parent.
    #[inline]
    pub fn fill(self, (first, second): (BinaryNode, BinaryNode)) -> BinaryNode {
        self.nodes[0] = first;
        self.nodes[1] = second;
        BinaryNode {
            low: first.low.min(second.low),
            high: first.high.max(second.high),
            first: self.first,
            count: 0,
        }
    }
}
