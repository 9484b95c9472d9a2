//! Figures of trees: what a ray is expected to cost, and how full they are.

use super::binary::BinaryTree;
use super::wide::{WideChild, WideTree};
use crate::costs::Costs;
use glam::Vec3;

/// Figures of a [`BinaryTree`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinaryFigures {
    /// Expected cost of a ray that passes through the root's box: nodes and triangles, weighted by the part of all
    /// rays that meet them.
    pub cost: f64,
    /// Nodes.
    pub nodes: usize,
    /// Level of the deepest leaf; the root's is 0.
    pub depth: u32,
    /// Triangles per leaf.
    pub triangles: f64,
}

/// Figures of a [`WideTree`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WideFigures {
    /// Expected cost of a ray that passes through the root's box.
    pub cost: f64,
    /// Nodes.
    pub nodes: usize,
    /// Level of the deepest node; the root's is 0.
    pub depth: u32,
    /// Children per node.
    pub children: f64,
    /// Triangles per leaf.
    pub triangles: f64,
}

fn area((low, high): (Vec3, Vec3)) -> f64 {
    let size = (high - low).as_dvec3();
    size.x * (size.y + size.z) + size.y * size.z
}

impl BinaryTree {
    /// Counts what there is.
    pub fn figures(&self, costs: &Costs) -> BinaryFigures {
        let mut levels = vec![0_u32; self.nodes.len()];
        let (mut sum, mut depth, mut leaves) = (0.0, 0, 0_usize);
        for (index, node) in self.nodes.iter().enumerate() {
            let area = area((node.low, node.high));
            depth = depth.max(levels[index]);
            if node.is_inner() {
                sum += area * f64::from(costs.node);
                let level = levels[index] + 1;
                levels[node.first as usize..node.first as usize + 2].fill(level);
            } else {
                sum += area * f64::from(costs.triangle) * f64::from(node.count);
                leaves += 1;
            }
        }
        BinaryFigures {
            cost: sum / area((self.nodes[0].low, self.nodes[0].high)),
            nodes: self.nodes.len(),
            depth,
            triangles: self.order.len() as f64 / leaves as f64,
        }
    }
}

impl WideTree {
    /// Counts what there is.
    pub fn figures(&self, costs: &Costs) -> WideFigures {
        let mut levels = vec![0_u32; self.nodes.len()];
        let root = area(self.nodes[0].bounds());
        let (mut sum, mut depth, mut leaves, mut children) = (root * f64::from(costs.node), 0, 0_usize, 0_usize);
        for (index, node) in self.nodes.iter().enumerate() {
            depth = depth.max(levels[index]);
            for (slot, child) in node.children.iter().enumerate() {
                let area = area(node.child_box(slot));
                match *child {
                    WideChild::Empty => continue,
                    WideChild::Leaf { count, .. } => {
                        leaves += 1;
                        sum += area * f64::from(costs.triangle) * f64::from(count);
                    }
                    WideChild::Inner(child) => {
                        sum += area * f64::from(costs.node);
                        levels[child as usize] = levels[index] + 1;
                    }
                }
                children += 1;
            }
        }
        WideFigures {
            cost: sum / root,
            nodes: self.nodes.len(),
            depth,
            children: children as f64 / self.nodes.len() as f64,
            triangles: self.order.len() as f64 / leaves as f64,
        }
    }
}
