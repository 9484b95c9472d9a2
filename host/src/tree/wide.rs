//! The wide tree.

use super::binary::BinaryTree;
use super::collapse::CollapseOptions;
use super::{BuildPreset, InvalidTree, each_once};
use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Progress;
use glam::Vec3;

/// Most children of a node.
pub const WIDTH: usize = 8;
/// Most triangles of a leaf: those of eight then have numbers of five bits.
pub const MAX_LEAF: u32 = 4;

/// What is in a slot of a [`WideNode`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WideChild {
    /// Nothing; its box is empty, from plus to minus infinity.
    #[default]
    Empty,
    /// Triangles, in the slots from `first` on.
    Leaf {
        /// The first slot in [`WideTree::order`].
        first: u32,
        /// Triangles, 1 to [`MAX_LEAF`].
        count: u32,
    },
    /// The node of this index.
    Inner(u32),
}

/// A node of a [`WideTree`]: up to eight children with their boxes.
///
/// A child lies in the slot of the octant in which it is, as seen from the node's centre: bit 0 of the slot's number is
/// the upper half of x, bit 1 of y, bit 2 of z. A ray whose direction is negative along the axes of the bits of `o`
/// meets them front to back, as well as it may be, in the order `0 ^ o, 1 ^ o, ..., 7 ^ o`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WideNode {
    /// Lowest coordinates of the children, by axis and slot, scene units.
    pub low: [[f32; WIDTH]; 3],
    /// Highest coordinates of the children, by axis and slot, scene units.
    pub high: [[f32; WIDTH]; 3],
    /// What is in each slot.
    pub children: [WideChild; WIDTH],
    /// Index of the first of the children that are nodes; they lie side by side in the order of their slots.
    pub first_node: u32,
    /// The first slot of the triangles of children that are leaves; they lie side by side in the order of those.
    pub first_triangle: u32,
}

impl WideNode {
    /// A node without children.
    pub const EMPTY: WideNode = WideNode {
        low: [[f32::INFINITY; WIDTH]; 3],
        high: [[f32::NEG_INFINITY; WIDTH]; 3],
        children: [WideChild::Empty; WIDTH],
        first_node: 0,
        first_triangle: 0,
    };

    /// The box of the child in a slot.
    pub fn child_box(&self, slot: usize) -> (Vec3, Vec3) {
        let corner = |corners: &[[f32; WIDTH]; 3]| Vec3::new(corners[0][slot], corners[1][slot], corners[2][slot]);
        (corner(&self.low), corner(&self.high))
    }

    /// The smallest box round all children.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        (0..WIDTH)
            .map(|slot| self.child_box(slot))
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), child| {
                (low.min(child.0), high.max(child.1))
            })
    }
}

/// A tree of nodes with up to [`WIDTH`] children; the root is node 0.
#[derive(Clone, Debug)]
pub struct WideTree {
    /// The nodes, the root first.
    pub nodes: Vec<WideNode>,
    /// The triangle in each slot.
    pub order: Vec<u32>,
    /// Triangles left out because they have no area.
    pub degenerate: u32,
}

impl WideTree {
    /// Builds the tree of a mesh; the same one for the same mesh, whatever the number of threads.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to build it from.
    pub fn build(
        mesh: &Mesh,
        preset: BuildPreset,
        options: &CollapseOptions,
        progress: Progress<'_>,
    ) -> Result<Self, BuildError> {
        Ok(Self::of(&BinaryTree::build(mesh, preset, progress)?, options))
    }

    /// Makes a wide tree of a binary one.
    pub fn of(tree: &BinaryTree, options: &CollapseOptions) -> Self {
        let arrays = tree.to_wide(options, WideNode::EMPTY, |node| *node);
        WideTree {
            nodes: arrays.nodes,
            order: arrays.order,
            degenerate: tree.degenerate,
        }
    }

    /// Checks the rules of the layout, that boxes are the smallest, that no node is beyond level `depth` (the root's is
    /// 0), and that each triangle of the mesh is in the tree once or was left out.
    ///
    /// # Errors
    /// The first broken rule.
    pub fn validate(&self, mesh: &Mesh, depth: u32) -> Result<(), InvalidTree> {
        let invalid = |rule: String| Err(InvalidTree(rule));
        each_once(&self.order, self.degenerate, mesh.triangles.len())?;
        let (mut nodes, mut triangles) = (1, 0);
        let mut open = vec![(0_u32, 0)];
        while let Some((index, level)) = open.pop() {
            let Some(node) = self.nodes.get(index as usize) else {
                return invalid(format!("node {index} is out of range"));
            };
            if level > depth {
                return invalid(format!("node {index} is on level {level}"));
            }
            let (mut next_node, mut next_triangle) = (node.first_node, node.first_triangle);
            if next_node != nodes || next_triangle != triangles {
                return invalid(format!(
                    "the children of node {index} are not behind those of the one before"
                ));
            }
            for (slot, child) in node.children.iter().enumerate() {
                let smallest = match *child {
                    WideChild::Empty => (Vec3::INFINITY, Vec3::NEG_INFINITY),
                    WideChild::Leaf { first, count } => {
                        if first != next_triangle || !(1..=MAX_LEAF).contains(&count) {
                            return invalid(format!("slot {slot} of node {index} has {count} triangles at {first}"));
                        }
                        next_triangle += count;
                        let Some(ids) = self.order.get(first as usize..next_triangle as usize) else {
                            return invalid(format!("slot {slot} of node {index} is beyond all triangles"));
                        };
                        let corners = ids.iter().flat_map(|&id| mesh.triangles[id as usize]);
                        corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), corner| {
                            let corner = mesh.positions[corner as usize];
                            (low.min(corner), high.max(corner))
                        })
                    }
                    WideChild::Inner(child) => {
                        if child != next_node {
                            return invalid(format!("slot {slot} of node {index} is node {child}, not {next_node}"));
                        }
                        next_node += 1;
                        let Some(child) = self.nodes.get(child as usize) else {
                            return invalid(format!("node {child} is out of range"));
                        };
                        child.bounds()
                    }
                };
                if smallest != node.child_box(slot) {
                    return invalid(format!("the box of slot {slot} of node {index} is not the smallest"));
                }
            }
            open.extend((node.first_node..next_node).rev().map(|child| (child, level + 1)));
            (nodes, triangles) = (next_node, next_triangle);
        }
        if nodes as usize != self.nodes.len() || triangles as usize != self.order.len() {
            return invalid("it has nodes or slots that nothing leads to".into());
        }
        Ok(())
    }
}
