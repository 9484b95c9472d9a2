//! From a node of a structure down to its children.

use crate::scene::Scene;
use glam::{UVec4, Vec3};
use oktant_shared::aabb::Aabb;
use oktant_shared::arithmetic::halves;
use oktant_shared::bvh2::{self, COUNT_BITS, LEAF};
use oktant_shared::grid::{FIRST_CELL, Raster};
use oktant_shared::octants;
use oktant_shared::octree::Node;
use oktant_shared::parts::TraversalKind;

/// A place in a structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Corner with the smallest coordinates, scene units.
    pub low: Vec3,
    /// Corner with the largest coordinates, scene units.
    pub high: Vec3,
    /// Its level; the root's is 0.
    pub depth: u32,
}

impl Cell {
    fn of(aabb: Aabb, depth: u32) -> Self {
        Cell {
            low: aabb.low,
            high: aabb.high,
            depth,
        }
    }
}

/// What is at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// An inner node, by its index.
    Inner(u32),
    /// A leaf or cell of so many triangles, by its index among nodes or cells; of trees of boxes, and without a structure, by
    /// the slot of its first triangle.
    Leaf {
        /// Index or slot.
        index: u32,
        /// How many.
        triangles: u32,
    },
}

/// The whole of a scene's structure.
pub fn root(scene: &Scene) -> (Cell, Content) {
    let cell = Cell::of(scene.root.aabb(), 0);
    let content = match scene.parts.traversal {
        TraversalKind::Octree => of_node(&scene.nodes, 0),
        TraversalKind::Brute => Content::Leaf {
            index: 0,
            triangles: scene.nodes[0].x,
        },
        TraversalKind::Octants | TraversalKind::Compact | TraversalKind::Bvh2 | TraversalKind::Grid => {
            Content::Inner(0)
        }
    };
    (cell, content)
}

/// What an inner node of that index consists of, empty leaves and cells included. Cells of a grid are of its own level.
pub fn children(scene: &Scene, index: u32, cell: &Cell) -> Vec<(Cell, Content)> {
    match scene.parts.traversal {
        TraversalKind::Octants | TraversalKind::Compact => of_octants(scene, index, cell),
        TraversalKind::Octree => of_octree(scene, index, cell),
        TraversalKind::Bvh2 => of_bvh2(scene, index, cell).into(),
        TraversalKind::Grid => of_grid(scene),
        TraversalKind::Brute => Vec::new(),
    }
}

/// The boxes of a BVH's node, and what is in them.
pub fn of_bvh2(scene: &Scene, index: u32, cell: &Cell) -> [(Cell, Content); 2] {
    let words = &scene.nodes[(index * bvh2::NODE_VECTORS) as usize..];
    [0, 2].map(|at| {
        let corner = |words: UVec4| Vec3::from_array([words.x, words.y, words.z].map(f32::from_bits));
        let link = words[at].w;
        let content = if link & LEAF == 0 {
            Content::Inner(link)
        } else {
            Content::Leaf {
                index: (link & !LEAF) >> COUNT_BITS,
                triangles: link & ((1 << COUNT_BITS) - 1),
            }
        };
        let child = Cell {
            low: corner(words[at]),
            high: corner(words[at + 1]),
            depth: cell.depth + 1,
        };
        (child, content)
    })
}

/// The cell of a grid with that number.
pub fn grid_cell(raster: &Raster, number: u32) -> Cell {
    let (row, cells) = (number / raster.cells.x, raster.cells);
    let place = Vec3::new(
        (number % cells.x) as f32,
        (row % cells.y) as f32,
        (row / cells.y) as f32,
    );
    let low = raster.low + place * raster.cell;
    Cell {
        low,
        high: low + raster.cell,
        depth: 0,
    }
}

fn of_grid(scene: &Scene) -> Vec<(Cell, Content)> {
    let raster = Raster::of(&scene.nodes);
    let cell = |index| {
        let triangles = Node::at(&scene.nodes, FIRST_CELL + index).count;
        (grid_cell(&raster, index), Content::Leaf { index, triangles })
    };
    (0..raster.total() as u32).map(cell).collect()
}

fn of_node(nodes: &[UVec4], index: u32) -> Content {
    let node = Node::at(nodes, index);
    if node.is_inner() {
        Content::Inner(index)
    } else {
        Content::Leaf {
            index,
            triangles: node.count,
        }
    }
}

fn of_octree(scene: &Scene, index: u32, cell: &Cell) -> Vec<(Cell, Content)> {
    let first = Node::at(&scene.nodes, index).first;
    let middle = 0.5 * (cell.low + cell.high);
    let octant = |child: u32| {
        let mut half = Cell {
            low: cell.low,
            high: middle,
            depth: cell.depth + 1,
        };
        for axis in (0..3).filter(|axis| child >> axis & 1 == 1) {
            (half.low[axis], half.high[axis]) = (middle[axis], cell.high[axis]);
        }
        (half, of_node(&scene.nodes, first + child))
    };
    (0..8).map(octant).collect()
}

fn of_octants(scene: &Scene, index: u32, cell: &Cell) -> Vec<(Cell, Content)> {
    let vectors = octants::NODE_VECTORS as usize;
    let words = &scene.nodes[index as usize * vectors..][..vectors];
    let (inner, mut next) = (words[0].w >> 24, words[1].x);
    let octant = |slot: u32| {
        let content = if inner >> slot & 1 == 1 {
            next += 1;
            Content::Inner(next - 1)
        } else {
            let byte = [words[1].z, words[1].w][slot as usize / 4] >> (8 * (slot % 4)) & 0xff;
            Content::Leaf {
                index: words[1].y + (byte & 31),
                triangles: byte >> 5,
            }
        };
        (Cell::of(box_of_octant(words, slot), cell.depth + 1), content)
    };
    (0..8).map(octant).collect()
}

/// The box of a child.
fn box_of_octant(words: &[UVec4], slot: u32) -> Aabb {
    let mut aabb = Aabb {
        low: Vec3::ZERO,
        high: Vec3::ZERO,
    };
    for axis in 0..3 {
        let corner = f32::from_bits(words[0][axis]);
        let size = f32::from_bits((words[0].w >> (8 * axis) & 0xff) << 23);
        let face = |side: usize| {
            let two = halves(words[2 + 2 * axis + side][slot as usize / 2]);
            corner + size * if slot.is_multiple_of(2) { two.x } else { two.y }
        };
        (aabb.low[axis], aabb.high[axis]) = (face(0), face(1));
    }
    aabb
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::progress::silent;
    use crate::structure::{Figures, StructureOptions};

    /// Oracle: the figures of the structure, counted another way.
    #[test]
    fn the_way_down_leads_to_everything() {
        for traversal in TraversalKind::ALL {
            let scene = Scene::new(&balls::balls(), &StructureOptions::of(*traversal), &silent).unwrap();
            let figures = Figures::new(*traversal, &scene.nodes);
            let (mut inner, mut filled, mut references, mut deepest) = (0, 0, 0, 0);
            let mut waiting = vec![root(&scene)];
            while let Some((cell, content)) = waiting.pop() {
                match content {
                    Content::Inner(index) => {
                        inner += 1;
                        waiting.extend(children(&scene, index, &cell));
                    }
                    Content::Leaf { triangles, .. } => {
                        filled += usize::from(triangles > 0);
                        references += triangles as usize;
                        deepest = deepest.max(cell.depth);
                        assert!(
                            triangles == 0 || cell.low.cmple(cell.high).all(),
                            "{traversal}: {cell:?}"
                        );
                    }
                }
            }
            // The grid has no node of its own.
            inner -= usize::from(*traversal == TraversalKind::Grid);
            assert_eq!(
                (inner, filled, references, deepest),
                (figures.inner, figures.filled, figures.references, figures.depth),
                "{traversal}"
            );
        }
    }
}
