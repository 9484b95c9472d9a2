//! The binary tree.

use super::morton::MortonOrder;
use super::{BuildPreset, InvalidTree, each_once, preset};
use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::progress::Progress;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// No leaf of a [`BinaryTree`] is further from the root; the root's level is 0.
pub const MAX_BINARY_DEPTH: u32 = 96;

/// A node of a [`BinaryTree`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BinaryNode {
    /// Lowest coordinates of the corners of its triangles, scene units.
    pub low: Vec3,
    /// Of an inner node, index of its first child, which the second follows; of a leaf, its first slot.
    pub first: u32,
    /// Highest coordinates of the corners of its triangles, scene units.
    pub high: Vec3,
    /// Of a leaf, its triangles; of an inner node, 0.
    pub count: u32,
}

const _: () = assert!(size_of::<BinaryNode>() == 32);

impl BinaryNode {
    /// Whether it has children.
    pub fn is_inner(&self) -> bool {
        self.count == 0
    }

    /// Half the surface of its box.
    pub fn area(&self) -> f32 {
        let size = self.high - self.low;
        size.x * (size.y + size.z) + size.y * size.z
    }
}

/// A tree of boxes with two children each.
///
/// The root is node 0. Behind the two children of a node lie all nodes below the first child, then all below the
/// second; the slots of a subtree lie side by side. As built, every leaf holds one triangle.
#[derive(Debug)]
pub struct BinaryTree {
    /// The nodes, the root first.
    pub nodes: Vec<BinaryNode>,
    /// The triangle in each slot.
    pub order: Vec<u32>,
    /// Triangles left out because they have no area.
    pub degenerate: u32,
}

impl BinaryTree {
    /// Builds the tree of a mesh; the same one for the same mesh, whatever the number of threads.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to build it from.
    pub fn build(mesh: &Mesh, preset: BuildPreset, progress: Progress<'_>) -> Result<Self, BuildError> {
        Ok(Self::of(&MortonOrder::new(mesh)?, mesh, preset, progress))
    }

    /// Builds the tree of a mesh whose triangles are sorted.
    pub fn of(sorted: &MortonOrder, mesh: &Mesh, preset: BuildPreset, progress: Progress<'_>) -> Self {
        let (nodes, order) = preset::build(preset, sorted, mesh, progress);
        BinaryTree {
            nodes,
            order,
            degenerate: sorted.degenerate,
        }
    }

    /// Checks the rules of the layout, and that each of so many triangles is in the tree once or was left out.
    ///
    /// # Errors
    /// The first broken rule.
    pub fn validate(&self, mesh: &Mesh) -> Result<(), InvalidTree> {
        let invalid = |rule: String| Err(InvalidTree(rule));
        each_once(&self.order, self.degenerate, mesh.triangles.len())?;
        let (mut next_slot, mut next_node) = (0, 1);
        // First child last, so that it comes first.
        let mut open = vec![(0_usize, 0_u32)];
        while let Some((index, level)) = open.pop() {
            let Some(node) = self.nodes.get(index) else {
                return invalid(format!("node {index} is out of range"));
            };
            if level > MAX_BINARY_DEPTH {
                return invalid(format!("node {index} is on level {level}"));
            }
            let (low, high);
            if node.is_inner() {
                let first = node.first as usize;
                if first != next_node || first + 2 > self.nodes.len() {
                    return invalid(format!("the children of node {index} are at {first}, not {next_node}"));
                }
                next_node += 2;
                let [a, b] = [self.nodes[first], self.nodes[first + 1]];
                (low, high) = (a.low.min(b.low), a.high.max(b.high));
                open.extend([(first + 1, level + 1), (first, level + 1)]);
            } else {
                if node.first != next_slot || (next_slot + node.count) as usize > self.order.len() {
                    return invalid(format!(
                        "the slots of node {index} are at {}, not {next_slot}",
                        node.first
                    ));
                }
                let slots = node.first as usize..(node.first + node.count) as usize;
                next_slot += node.count;
                let corners = self.order[slots].iter().flat_map(|&id| mesh.triangles[id as usize]);
                (low, high) = corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), corner| {
                    let corner = mesh.positions[corner as usize];
                    (low.min(corner), high.max(corner))
                });
            }
            if (low, high) != (node.low, node.high) {
                return invalid(format!("the box of node {index} is not the smallest"));
            }
        }
        if next_slot as usize != self.order.len() || next_node != self.nodes.len() {
            return invalid("it has nodes or slots that nothing leads to".into());
        }
        Ok(())
    }
}
