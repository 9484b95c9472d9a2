//! The words of the plain bounding volume hierarchy.

use crate::tree::{BinaryNode, BinaryTree};
use glam::{UVec4, Vec3};
use oktant_shared::bvh2::{COUNT_BITS, LEAF, NODE_VECTORS};

/// Most triangles of a leaf.
const MAX_LEAF: u32 = 4;

/// What becomes of a binary node.
#[derive(Clone, Copy)]
struct Plan {
    /// First slot of its triangles.
    first: u32,
    /// How many it has.
    triangles: u32,
    /// What a ray through it is expected to cost, in tests of a box or triangle, times its surface.
    cost: f32,
    is_leaf: bool,
    /// Its index among the nodes that stay inner ones.
    place: u32,
}

/// The nodes of a tree as [`oktant_shared::bvh2::Bvh2`] reads them. Subtrees that are cheaper as leaves become such.
pub(super) fn words(tree: &BinaryTree) -> Vec<UVec4> {
    let plans = plans(&tree.nodes);
    let link = |index: usize| {
        let plan = &plans[index];
        if plan.is_leaf {
            LEAF | plan.first << COUNT_BITS | plan.triangles
        } else {
            plan.place
        }
    };
    let mut words = Vec::new();
    if plans[0].is_leaf {
        // The other half of a root that is a leaf is an empty one.
        words.extend(half(&tree.nodes[0], link(0)));
        words.extend(half(&tree.nodes[0], LEAF));
        return words;
    }
    words.reserve(plans.len() / 2 * NODE_VECTORS as usize);
    let mut is_kept = vec![false; plans.len()];
    is_kept[0] = true;
    for (index, node) in tree.nodes.iter().enumerate() {
        if is_kept[index] && !plans[index].is_leaf {
            let first = node.first as usize;
            is_kept[first..first + 2].fill(true);
            words.extend(half(&tree.nodes[first], link(first)));
            words.extend(half(&tree.nodes[first + 1], link(first + 1)));
        }
    }
    words
}

fn plans(nodes: &[BinaryNode]) -> Vec<Plan> {
    let mut plans = vec![
        Plan {
            first: 0,
            triangles: 0,
            cost: 0.0,
            is_leaf: true,
            place: 0
        };
        nodes.len()
    ];
    // Children come behind their parents.
    for (index, node) in nodes.iter().enumerate().rev() {
        let mut plan = Plan {
            first: node.first,
            triangles: node.count,
            cost: node.area() * node.count as f32,
            is_leaf: true,
            place: 0,
        };
        if node.is_inner() {
            let [a, b] = [plans[node.first as usize], plans[node.first as usize + 1]];
            plan.first = a.first;
            plan.triangles = a.triangles + b.triangles;
            // Two boxes cost what a triangle does.
            let as_inner = node.area() + a.cost + b.cost;
            let as_leaf = node.area() * plan.triangles as f32;
            plan.is_leaf = plan.triangles <= MAX_LEAF && as_leaf <= as_inner;
            plan.cost = if plan.is_leaf { as_leaf } else { as_inner };
        }
        plans[index] = plan;
    }
    // What is below a leaf has no place.
    let mut inner = 0;
    let mut is_below_leaf = vec![false; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        if node.is_inner() {
            let below = is_below_leaf[index] || plans[index].is_leaf;
            is_below_leaf[node.first as usize..node.first as usize + 2].fill(below);
            if !below {
                plans[index].place = inner;
                inner += 1;
            }
        }
    }
    plans
}

fn half(node: &BinaryNode, link: u32) -> [UVec4; 2] {
    let bits = |corner: Vec3, word| UVec4::new(corner.x.to_bits(), corner.y.to_bits(), corner.z.to_bits(), word);
    [bits(node.low, link), bits(node.high, 0)]
}
