//! Which nodes of a binary tree become children of a wide tree, at the least cost.

use super::BuildPreset;
use super::binary::{BinaryNode, BinaryTree};
use super::pages::zeroed;
use super::slots::Placing;
use super::wide::{MAX_LEAF, WIDTH};
use crate::costs::Costs;
use bytemuck::{Pod, Zeroable};
use oktant_shared::octants::MAX_LEVEL;

/// How a binary tree is made into a wide one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollapseOptions {
    /// Most triangles of a leaf, 1 to [`MAX_LEAF`].
    pub leaf: u32,
    /// What the surface area heuristic counts with.
    pub costs: Costs,
    /// How well children are put into slots.
    pub placing: Placing,
    /// Most wide nodes for each triangle. Where the cheapest tree has more, as of triangles whose boxes overlap much, fuller nodes
    /// are preferred, so far as that helps.
    pub nodes: f32,
    /// Deepest level of a wide node, if at least a third of [`super::MAX_BINARY_DEPTH`] less one; the root's is 0.
    pub levels: u32,
}

impl CollapseOptions {
    /// What a preset makes of it.
    pub fn of(preset: BuildPreset) -> Self {
        CollapseOptions {
            placing: match preset {
                BuildPreset::Fast | BuildPreset::Balanced => Placing::Greedy,
                BuildPreset::Quality => Placing::Best,
            },
            ..CollapseOptions::default()
        }
    }
}

impl Default for CollapseOptions {
    fn default() -> Self {
        CollapseOptions {
            leaf: 3,
            costs: Costs::OCTANTS,
            placing: Placing::default(),
            // With 128 bytes a node and 52 a triangle, 71.2 bytes in all.
            nodes: 0.15,
            levels: MAX_LEVEL,
        }
    }
}

/// What the cheapest wide tree makes of a binary node.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct Decision {
    /// For 2 to 8 children that may stand for the node, three bits each, the lowest for 2: how many of them are for
    /// its first child; 0 where one less is as good. [`LEAF`]: alone, it becomes a leaf.
    packed: u32,
    /// Wide nodes in its place, if it is one child.
    pub nodes: u32,
    /// Its triangles.
    pub triangles: u32,
}

const LEAF: u32 = 1 << 31;

impl Decision {
    fn of_leaf(node: &BinaryNode) -> Self {
        Decision {
            packed: LEAF,
            nodes: 0,
            triangles: node.count,
        }
    }

    /// Whether it becomes a leaf if it is one child.
    pub fn is_leaf(&self) -> bool {
        self.packed & LEAF != 0
    }

    /// How many of `children`, 2 to [`WIDTH`], are for its first child; 0 where one less is as good.
    fn share(&self, children: usize) -> usize {
        (self.packed >> (3 * (children - 2)) & 7) as usize
    }

    /// Has so many children for its first and its second child, where it may have as many or more.
    pub fn open(&mut self, first: usize, second: usize) {
        self.packed = (first as u32) << (3 * (first + second - 2));
    }
}

/// What a subtree costs and how many wide nodes it takes, by the number of children, less one, that may stand for it.
/// The last are for the children of a wide node of its own.
#[derive(Clone, Copy)]
struct Table {
    costs: [f32; WIDTH],
    nodes: [u32; WIDTH],
    triangles: u32,
}

impl Table {
    /// Children that can stand for it.
    fn most(&self) -> usize {
        (self.triangles as usize).min(WIDTH - 1)
    }
}

/// The decisions for all nodes of a tree.
pub(super) struct Decisions(Vec<Decision>);

impl Decisions {
    /// What is made of a node.
    #[inline]
    pub fn of(&self, node: &BinaryNode) -> Decision {
        if node.is_inner() {
            // Children lie in pairs behind the root, so that each inner node has a pair of its own.
            self.0[node.first as usize / 2]
        } else {
            Decision::of_leaf(node)
        }
    }

    /// The same of a node with children, to change it.
    pub fn of_mut(&mut self, node: &BinaryNode) -> &mut Decision {
        &mut self.0[node.first as usize / 2]
    }
}

/// So many nodes are never too many.
const FEW: f32 = 64.0;
/// What a place in a node that no triangle takes costs at first where nodes are to be fuller, and at most, in parts of visiting
/// the node.
const UNFILLED: f32 = 0.01;
const MOST_UNFILLED: f32 = 0.5;

/// Decides for every node.
///
/// Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017, section
/// 3: C(n, i), bottom-up.
pub(super) fn decide(tree: &BinaryTree, options: &CollapseOptions) -> Decisions {
    let mut decisions = zeroed(tree.nodes.len() / 2);
    let most = (options.nodes * tree.order.len() as f32).max(FEW);
    let mut optimiser = Optimiser {
        nodes: &tree.nodes,
        leaf: options.leaf.clamp(1, MAX_LEAF),
        costs: options.costs,
        unfilled: 0.0,
    };
    loop {
        let table = optimiser.subtree(0, &mut decisions, 0);
        if table.nodes[0] as f32 <= most || optimiser.unfilled >= MOST_UNFILLED {
            break;
        }
        optimiser.unfilled = (2.0 * optimiser.unfilled).max(UNFILLED);
    }
    // The root becomes a node even if it were cheaper as a leaf.
    if let Some(root) = decisions.first_mut()
        && root.is_leaf()
    {
        root.packed &= !LEAF;
        root.nodes = 1;
    }
    Decisions(decisions)
}

/// Calls `child` for the nodes that become the children of the wide node in the place of `index`: at most [`WIDTH`].
pub(super) fn children(nodes: &[BinaryNode], decisions: &Decisions, index: u32, child: &mut impl FnMut(u32)) {
    if nodes[index as usize].is_inner() {
        distribute(nodes, decisions, index, WIDTH, child);
    } else {
        child(index);
    }
}

fn distribute(nodes: &[BinaryNode], decisions: &Decisions, index: u32, mut count: usize, child: &mut impl FnMut(u32)) {
    let node = &nodes[index as usize];
    let decision = decisions.of(node);
    while count > 1 {
        let share = decision.share(count);
        if share > 0 {
            let first = node.first;
            distribute(nodes, decisions, first, share, child);
            distribute(nodes, decisions, first + 1, count - share, child);
            return;
        }
        count -= 1;
    }
    child(index);
}

/// Levels whose subtrees are worth a thread: many more than there are threads, for they differ in size.
const PARALLEL_LEVELS: u32 = 10;

struct Optimiser<'a> {
    nodes: &'a [BinaryNode],
    leaf: u32,
    costs: Costs,
    /// Cost of a place in a node that no triangle takes.
    unfilled: f32,
}

impl Optimiser<'_> {
    /// Makes the decisions for the inner nodes of the subtree of the node `index`.
    fn subtree(&self, index: u32, decisions: &mut [Decision], level: u32) -> Table {
        let node = &self.nodes[index as usize];
        let area = node.area();
        if !node.is_inner() {
            return Table {
                costs: [area * self.costs.triangle * node.count as f32; WIDTH],
                nodes: [0; WIDTH],
                triangles: node.count,
            };
        }
        let second = &self.nodes[node.first as usize + 1];
        let (own, below) = decisions.split_at_mut(1);
        // Behind the children lie the pairs below the first, then those below the second.
        let middle = if second.is_inner() {
            (second.first - node.first) as usize / 2 - 1
        } else {
            below.len()
        };
        let (first_below, second_below) = below.split_at_mut(middle);
        let mut first = || self.subtree(node.first, first_below, level + 1);
        let mut second = || self.subtree(node.first + 1, second_below, level + 1);
        let (a, b) = if level < PARALLEL_LEVELS {
            rayon::join(first, second)
        } else {
            (first(), second())
        };
        let mut table = Table {
            costs: [0.0; WIDTH],
            nodes: [0; WIDTH],
            triangles: a.triangles + b.triangles,
        };
        own[0] = self.join(area, &a, &b, &mut table);
        table
    }

    /// The table of a node over two subtrees.
    #[inline]
    fn join(&self, area: f32, a: &Table, b: &Table, table: &mut Table) -> Decision {
        let Table {
            costs,
            nodes,
            triangles,
        } = table;
        let mut packed = 0;
        // No more children than triangles.
        let (most_a, most_b) = (a.most(), b.most());
        let most = (most_a + most_b).min(WIDTH);
        for children in 2..=most {
            let (mut lowest, mut share) = (f32::INFINITY, 0);
            for first in children.saturating_sub(most_b).max(1)..=most_a.min(children - 1) {
                let cost = a.costs[first - 1] + b.costs[children - first - 1];
                if cost < lowest {
                    (lowest, share) = (cost, first);
                }
            }
            costs[children - 1] = lowest;
            nodes[children - 1] = a.nodes[share - 1] + b.nodes[children - share - 1];
            packed |= (share as u32) << (3 * (children - 2));
        }
        for children in most..WIDTH {
            costs[children] = costs[most - 1];
            nodes[children] = nodes[most - 1];
        }
        if most < WIDTH {
            // A wide node is opened even where it were as cheap not to be.
            let share = packed >> (3 * (most - 2)) & 7;
            packed |= share << (3 * (WIDTH - 2));
        }
        let unfilled = (WIDTH as u32).saturating_sub(*triangles) as f32;
        let as_node = area * self.costs.node * (1.0 + self.unfilled * unfilled) + costs[WIDTH - 1];
        let as_leaf = area * self.costs.triangle * *triangles as f32;
        (costs[0], nodes[0]) = (as_node, nodes[WIDTH - 1] + 1);
        if *triangles <= self.leaf && as_leaf <= as_node {
            (costs[0], nodes[0]) = (as_leaf, 0);
            packed |= LEAF;
        }
        // As many children as may be, or one less, whichever is cheaper.
        for children in 2..WIDTH {
            if costs[children - 1] >= costs[children - 2] {
                costs[children - 1] = costs[children - 2];
                nodes[children - 1] = nodes[children - 2];
                packed &= !(7 << (3 * (children - 2)));
            }
        }
        Decision {
            packed,
            nodes: nodes[0],
            triangles: *triangles,
        }
    }
}
