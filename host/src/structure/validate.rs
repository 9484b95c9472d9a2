//! The check before a structure is handed to a kernel that trusts it.

use super::Structure;
use glam::UVec4;
use oktant_shared::grid::{FIRST_CELL, MAX_CELLS, Raster};
use oktant_shared::octree::{MAX_DEPTH, Node};
use oktant_shared::parts::TraversalKind;
use oktant_shared::{bvh2, octants};

/// A broken rule of the arrays, in words; a bug of whoever made them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("The structure is not valid: {0}. This is a bug; please report it with the mesh.")]
pub struct InvalidStructure(pub String);

fn invalid<T>(rule: String) -> Result<T, InvalidStructure> {
    Err(InvalidStructure(rule))
}

impl Structure {
    /// Checks everything that the traversal relies on without looking: indices in range, every node reached once, levels
    /// within the traversal's stack.
    ///
    /// # Errors
    /// The first broken rule.
    pub fn validate(&self, triangles: usize) -> Result<(), InvalidStructure> {
        if let Some(id) = self.ids.iter().find(|id| **id as usize >= triangles) {
            return invalid(format!("it holds triangle {id} of {triangles}"));
        }
        if self.traversal.is_indexed() {
            self.check_indices()?;
        } else if let Some(slot) = self.references.iter().find(|slot| **slot as usize >= self.ids.len()) {
            return invalid(format!("it refers to slot {slot} of {}", self.ids.len()));
        }
        match self.traversal {
            TraversalKind::Octree => self.check_octree(),
            TraversalKind::Octants | TraversalKind::Compact => self.check_octants(),
            TraversalKind::Bvh2 => self.check_bvh2(),
            TraversalKind::Grid => self.check_grid(),
            TraversalKind::Brute => self.check_brute(),
        }
    }

    fn check_indices(&self) -> Result<(), InvalidStructure> {
        if self.references.len() != 3 * self.ids.len() {
            return invalid(format!(
                "it has {} corners of {} triangles",
                self.references.len(),
                self.ids.len()
            ));
        }
        let count = self.corners.len();
        match self.references.iter().find(|vertex| **vertex as usize >= count) {
            Some(vertex) => invalid(format!("a triangle has corner {vertex} of {count}")),
            None => Ok(()),
        }
    }

    fn check_grid(&self) -> Result<(), InvalidStructure> {
        if self.nodes.len() < 3 {
            return invalid("it has no cells".into());
        }
        let raster = Raster::of(&self.nodes);
        let counts = raster.cells.to_array();
        if !counts.iter().all(|count| (1..=MAX_CELLS).contains(count)) {
            return invalid(format!("it has {counts:?} cells"));
        }
        if !(raster.low.is_finite() && raster.high().is_finite() && raster.cell > 0.0) {
            return invalid(format!("its cells of {} begin at {}", raster.cell, raster.low));
        }
        if raster.total().div_ceil(2) != self.nodes.len() - 2 {
            return invalid(format!(
                "it has {} words for {counts:?} cells",
                4 * (self.nodes.len() - 2)
            ));
        }
        for index in 0..raster.total() as u32 {
            let cell = Node::at(&self.nodes, FIRST_CELL + index);
            if u64::from(cell.first) + u64::from(cell.count) > self.references.len() as u64 {
                return invalid(format!("the references of cell {index} are out of range"));
            }
        }
        Ok(())
    }

    fn check_brute(&self) -> Result<(), InvalidStructure> {
        let [UVec4 { x: count, .. }] = self.nodes[..] else {
            return invalid(format!("it has {} nodes instead of one", self.nodes.len()));
        };
        if count as usize > self.ids.len() {
            return invalid(format!("it counts {count} triangles of {}", self.ids.len()));
        }
        Ok(())
    }

    fn check_octree(&self) -> Result<(), InvalidStructure> {
        if self.root.depth > MAX_DEPTH {
            return invalid(format!("its depth {} exceeds {MAX_DEPTH}", self.root.depth));
        }
        let mut levels = Levels::new(2 * self.nodes.len(), self.root.depth)?;
        for index in 0..2 * self.nodes.len() {
            let node = Node::at(&self.nodes, index as u32);
            if !levels.is_reached(index) {
                // The last word may be half full.
                if index + 1 == 2 * self.nodes.len() && (node == Node { first: 0, count: 0 }) {
                    continue;
                }
                return invalid(format!("node {index} has no parent before it"));
            }
            if node.is_inner() {
                for child in 0..8 {
                    levels.reach(index, node.first as usize + child)?;
                }
            } else if u64::from(node.first) + u64::from(node.count) > self.references.len() as u64 {
                return invalid(format!("the references of node {index} are out of range"));
            }
        }
        Ok(())
    }

    fn check_octants(&self) -> Result<(), InvalidStructure> {
        let nodes = whole(&self.nodes, octants::NODE_VECTORS)?;
        let mut levels = Levels::new(nodes, octants::MAX_LEVEL)?;
        for index in 0..nodes {
            if !levels.is_reached(index) {
                return invalid(format!("node {index} has no parent before it"));
            }
            let at = index * octants::NODE_VECTORS as usize;
            let (frame, links) = (self.nodes[at], self.nodes[at + 1]);
            let inner = frame.w >> 24;
            for child in 0..inner.count_ones() as usize {
                levels.reach(index, links.x as usize + child)?;
            }
            for slot in 0..8 {
                let byte = [links.z, links.w][slot / 4] >> (8 * (slot % 4)) & 0xff;
                let end = u64::from(links.y) + u64::from(byte & 31) + u64::from(byte >> 5);
                if inner >> slot & 1 == 0 && byte != 0 && end > self.ids.len() as u64 {
                    return invalid(format!("a leaf of node {index} is out of range"));
                }
            }
        }
        Ok(())
    }

    fn check_bvh2(&self) -> Result<(), InvalidStructure> {
        let nodes = whole(&self.nodes, bvh2::NODE_VECTORS)?;
        let mut levels = Levels::new(nodes, bvh2::MAX_LEVEL)?;
        for index in 0..nodes {
            if !levels.is_reached(index) {
                return invalid(format!("node {index} has no parent before it"));
            }
            let at = index * bvh2::NODE_VECTORS as usize;
            for link in [self.nodes[at].w, self.nodes[at + 2].w] {
                if link & bvh2::LEAF == 0 {
                    levels.reach(index, link as usize)?;
                } else {
                    let first = u64::from((link & !bvh2::LEAF) >> bvh2::COUNT_BITS);
                    let count = u64::from(link & ((1 << bvh2::COUNT_BITS) - 1));
                    if first + count > self.ids.len() as u64 {
                        return invalid(format!("a leaf of node {index} is out of range"));
                    }
                }
            }
        }
        Ok(())
    }
}

/// How many nodes of so many vectors each there are.
fn whole(nodes: &[UVec4], vectors: u32) -> Result<usize, InvalidStructure> {
    if nodes.len().is_multiple_of(vectors as usize) {
        Ok(nodes.len() / vectors as usize)
    } else {
        invalid(format!(
            "its last node has {} words",
            4 * (nodes.len() % vectors as usize)
        ))
    }
}

/// The level of each node, known once its parent was looked at; parents come before their children.
struct Levels {
    levels: Vec<u8>,
    deepest: u32,
}

/// The level of a node that nothing has led to yet.
const UNKNOWN: u8 = u8::MAX;

impl Levels {
    fn new(nodes: usize, deepest: u32) -> Result<Self, InvalidStructure> {
        let mut levels = vec![UNKNOWN; nodes];
        *levels.first_mut().ok_or(InvalidStructure("it has no root".into()))? = 0;
        Ok(Levels { levels, deepest })
    }

    fn is_reached(&self, index: usize) -> bool {
        self.levels[index] != UNKNOWN
    }

    fn reach(&mut self, parent: usize, child: usize) -> Result<(), InvalidStructure> {
        let level = self.levels[parent] + 1;
        if u32::from(level) > self.deepest {
            return invalid(format!("node {parent} has children below the deepest level"));
        }
        if child <= parent || child >= self.levels.len() {
            return invalid(format!("the children of node {parent} are out of range"));
        }
        if self.levels[child] != UNKNOWN {
            return invalid(format!("node {parent} shares a child"));
        }
        self.levels[child] = level;
        Ok(())
    }
}
