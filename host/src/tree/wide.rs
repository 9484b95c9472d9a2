//! The wide tree.

use super::binary::BinaryTree;
use super::cells::CellTree;
use super::collapse::CollapseOptions;
use super::morton::MortonOrder;
use super::{BuildPreset, InvalidTree, each_once};
use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Progress;
use bytemuck::Zeroable;
use glam::Vec3;

/// Most children of a node.
pub const WIDTH: usize = 8;
/// Most triangles of a leaf: those of eight then have numbers of five bits.
pub const MAX_LEAF: u32 = 4;
/// The triangles of a node's leaves have so many places.
const MAX_PLACE: u32 = WIDTH as u32 * MAX_LEAF;

/// What is in a slot of a [`WideNode`].
#[repr(u32)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Zeroable)]
pub enum WideChild {
    /// Nothing; its box is empty, from plus to minus infinity.
    #[default]
    Empty = 0,
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
#[derive(Clone, Copy, Debug, PartialEq, Zeroable)]
pub struct WideNode {
    /// Lowest coordinates of the children, by axis and slot, scene units.
    pub low: [[f32; WIDTH]; 3],
    /// Highest coordinates of the children, by axis and slot, scene units.
    pub high: [[f32; WIDTH]; 3],
    /// What is in each slot.
    pub children: [WideChild; WIDTH],
    /// Index of the first of the children that are nodes; they lie side by side in the order of their slots.
    pub first_node: u32,
    /// The first slot of the triangles of children that are leaves; they lie side by side.
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

    /// Adds to the indices of the children that are nodes.
    fn move_children(&mut self, by: u32) {
        self.first_node += by;
        for child in &mut self.children {
            if let WideChild::Inner(index) = child {
                *index += by;
            }
        }
    }

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
    /// Builds the tree of a mesh as rays are traced through it; the same one for the same mesh, whatever the number of
    /// threads.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to build it from.
    pub fn build(mesh: &Mesh, preset: BuildPreset, progress: Progress<'_>) -> Result<Self, BuildError> {
        let sorted = MortonOrder::new(mesh)?;
        if preset != BuildPreset::Fast {
            let tree = BinaryTree::of(&sorted, mesh, preset, progress);
            return Ok(Self::of(&tree, &CollapseOptions::of(preset)));
        }
        let cells = CellTree::build(&sorted, mesh, |node| *node, WideNode::move_children, progress);
        Ok(WideTree {
            nodes: cells.nodes,
            order: cells.ids,
            degenerate: sorted.degenerate,
        })
    }

    /// Makes a wide tree of a binary one.
    pub fn of(tree: &BinaryTree, options: &CollapseOptions) -> Self {
        let arrays = tree.to_wide(options, |node| *node);
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
        let (mut reached, mut triangles) = (1, vec![false; self.order.len()]);
        let mut open = vec![(0_u32, 0)];
        while let Some((index, level)) = open.pop() {
            let Some(node) = self.nodes.get(index as usize) else {
                return invalid(format!("node {index} is out of range"));
            };
            if level > depth {
                return invalid(format!("node {index} is on level {level}"));
            }
            let mut next_node = node.first_node;
            for (slot, child) in node.children.iter().enumerate() {
                let smallest = match *child {
                    WideChild::Empty => (Vec3::INFINITY, Vec3::NEG_INFINITY),
                    WideChild::Leaf { first, count } => {
                        let place = first.wrapping_sub(node.first_triangle);
                        if place >= MAX_PLACE || !(1..=MAX_LEAF).contains(&count) {
                            return invalid(format!("slot {slot} of node {index} has {count} triangles at {first}"));
                        }
                        let slots = first as usize..(first + count) as usize;
                        let Some(own) = triangles.get_mut(slots.clone()) else {
                            return invalid(format!("slot {slot} of node {index} is beyond all triangles"));
                        };
                        if own.contains(&true) {
                            return invalid(format!("slot {slot} of node {index} holds triangles of another"));
                        }
                        own.fill(true);
                        let corners = self.order[slots].iter().flat_map(|&id| mesh.triangles[id as usize]);
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
            if node.first_node <= index && next_node > node.first_node {
                return invalid(format!("the children of node {index} are not behind it"));
            }
            reached += (next_node - node.first_node) as usize;
            open.extend((node.first_node..next_node).map(|child| (child, level + 1)));
        }
        if reached != self.nodes.len() || triangles.contains(&false) {
            return invalid("it has nodes or slots that nothing leads to, or two things lead to".into());
        }
        Ok(())
    }
}
