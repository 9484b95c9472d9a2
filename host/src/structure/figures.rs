//! Figures of a structure.

use glam::UVec4;
use oktant_shared::grid::{FIRST_CELL, Raster};
use oktant_shared::octree::Node;
use oktant_shared::parts::TraversalKind;
use oktant_shared::{bvh2, octants};

/// What a structure consists of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures {
    /// Level of the deepest leaf or node; the root's is 0.
    pub depth: u32,
    /// Nodes with children.
    pub inner: usize,
    /// Leaves that hold triangles.
    pub filled: usize,
    /// Places for children that hold nothing.
    pub empty: usize,
    /// Triangles of all leaves, one that is in several as often.
    pub references: usize,
    /// Leaves by number of references: `histogram[i]` have `2^(i-1) < n <= 2^i`, the first have one.
    pub histogram: Vec<usize>,
    /// References of the fullest leaf.
    pub fullest: u32,
    /// Of the octree: leaves that a ray through the root is expected to pass through if nothing ends it, by the surfaces of
    /// cells.
    pub expected_steps: f64,
    /// Of the octree: triangles that it tests on this way.
    pub expected_tests: f64,
}

impl Figures {
    /// Counts what there is in the nodes of a valid structure.
    pub fn new(traversal: TraversalKind, nodes: &[UVec4]) -> Self {
        let mut figures = Figures::default();
        // Nodes to look at, and their levels.
        let mut open = vec![(0_u32, 0_u32)];
        while let Some((index, level)) = open.pop() {
            match traversal {
                TraversalKind::Octree => {
                    let node = Node::at(nodes, index);
                    if node.is_inner() {
                        figures.inner += 1;
                        open.extend((0..8).map(|child| (node.first + child, level + 1)));
                    } else {
                        figures.leaf(node.count, level);
                        // A child's surface is a quarter of its parent's.
                        let chance = 0.25_f64.powi(level as i32);
                        figures.expected_steps += chance;
                        figures.expected_tests += chance * f64::from(node.count);
                    }
                }
                TraversalKind::Octants | TraversalKind::Compact => {
                    figures.inner += 1;
                    let at = (index * octants::NODE_VECTORS) as usize;
                    let (inner, links) = (nodes[at].w >> 24, nodes[at + 1]);
                    open.extend((0..inner.count_ones()).map(|child| (links.x + child, level + 1)));
                    for slot in (0..8).filter(|slot| inner >> slot & 1 == 0) {
                        figures.leaf([links.z, links.w][slot / 4] >> (8 * (slot % 4) + 5) & 7, level + 1);
                    }
                }
                TraversalKind::Grid => {
                    for cell in 0..Raster::of(nodes).total() as u32 {
                        figures.leaf(Node::at(nodes, FIRST_CELL + cell).count, level);
                    }
                }
                TraversalKind::Brute => figures.leaf(nodes[0].x, level),
                TraversalKind::Bvh2 => {
                    figures.inner += 1;
                    let at = (index * bvh2::NODE_VECTORS) as usize;
                    for link in [nodes[at].w, nodes[at + 2].w] {
                        if link & bvh2::LEAF == 0 {
                            open.push((link, level + 1));
                        } else {
                            figures.leaf(link & ((1 << bvh2::COUNT_BITS) - 1), level + 1);
                        }
                    }
                }
            }
        }
        figures
    }

    fn leaf(&mut self, references: u32, level: u32) {
        self.depth = self.depth.max(level);
        if references == 0 {
            self.empty += 1;
            return;
        }
        self.filled += 1;
        self.references += references as usize;
        self.fullest = self.fullest.max(references);
        let class = references.next_power_of_two().ilog2() as usize;
        if self.histogram.len() <= class {
            self.histogram.resize(class + 1, 0);
        }
        self.histogram[class] += 1;
    }
}
