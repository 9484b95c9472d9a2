//! Where the parts of structures lie.

use super::Visit;
use super::recorder::{Event, Record};
use crate::scene::Scene;
use glam::{UVec4, Vec3};
use oktant_shared::aabb::Aabb;
use oktant_shared::arithmetic::halves;
use oktant_shared::bvh2::{self, COUNT_BITS, LEAF};
use oktant_shared::grid::Raster;
use oktant_shared::octants;
use oktant_shared::octree::Node;
use oktant_shared::parts::TraversalKind;
use std::collections::HashMap;

/// A place in a structure.
#[derive(Clone, Copy)]
struct Cell {
    low: Vec3,
    high: Vec3,
    depth: u32,
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

/// What was visited. Limits are scaled to the `t` of the ray as it was given.
pub fn visits(scene: &Scene, record: &Record, scale: f32, advance: f32) -> Vec<Visit> {
    let given = |limit: f32| (limit + advance) * scale;
    match scene.parts.traversal {
        TraversalKind::Octants | TraversalKind::Compact => of_octants(scene, record, &given),
        TraversalKind::Bvh2 => of_bvh2(scene, record, &given),
        TraversalKind::Octree => {
            let cells = octree_cells(scene);
            leaves(record, "leaf", &given, |number| cells[number as usize])
        }
        TraversalKind::Grid => {
            let raster = Raster::of(&scene.nodes);
            leaves(record, "cell", &given, |number| grid_cell(&raster, number))
        }
        TraversalKind::Brute => leaves(record, "leaf", &given, |_| root(scene)),
    }
}

fn root(scene: &Scene) -> Cell {
    Cell::of(scene.root.aabb(), 0)
}

fn visit(kind: &'static str, index: u32, cell: Cell, limit: f32, triangles: u32) -> Visit {
    Visit {
        kind,
        index,
        depth: cell.depth,
        low: cell.low.to_array(),
        high: cell.high.to_array(),
        limit,
        triangles,
    }
}

/// The leaves of a structure that visits nothing else.
fn leaves(record: &Record, kind: &'static str, given: &dyn Fn(f32) -> f32, cell: impl Fn(u32) -> Cell) -> Vec<Visit> {
    let leaf = |event: &Event| match *event {
        Event::Leaf { number, limit, bits } => Some(visit(kind, number, cell(number), given(limit), bits)),
        Event::Box(_) => None,
    };
    record.events.iter().filter_map(leaf).collect()
}

/// The cells of an octree by index.
fn octree_cells(scene: &Scene) -> Vec<Cell> {
    let mut cells = vec![root(scene); 2 * scene.nodes.len()];
    let mut waiting = vec![0];
    while let Some(index) = waiting.pop() {
        let (node, cell) = (Node::at(&scene.nodes, index), cells[index as usize]);
        if !node.is_inner() {
            continue;
        }
        let middle = 0.5 * (cell.low + cell.high);
        for child in 0..8 {
            let mut half = Cell {
                low: cell.low,
                high: middle,
                depth: cell.depth + 1,
            };
            for axis in (0..3).filter(|axis| child >> axis & 1 == 1) {
                (half.low[axis], half.high[axis]) = (middle[axis], cell.high[axis]);
            }
            cells[(node.first + child) as usize] = half;
            waiting.push(node.first + child);
        }
    }
    cells
}

fn grid_cell(raster: &Raster, number: u32) -> Cell {
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

/// Nodes, and of each the leaves that were met.
fn of_octants(scene: &Scene, record: &Record, given: &dyn Fn(f32) -> f32) -> Vec<Visit> {
    let nodes = &scene.nodes;
    let mut cells = vec![root(scene); nodes.len() / octants::NODE_VECTORS as usize];
    let mut waiting = vec![0];
    while let Some(index) = waiting.pop() {
        let words = node_of_octants(nodes, index);
        let (inner, mut child) = (words[0].w >> 24, words[1].x);
        for slot in (0..8).filter(|slot| inner >> slot & 1 == 1) {
            cells[child as usize] = Cell::of(box_of_octant(words, slot), cells[index as usize].depth + 1);
            waiting.push(child);
            child += 1;
        }
    }
    let mut visits = Vec::new();
    for event in &record.events {
        let Event::Leaf { number, limit, bits } = *event else {
            continue;
        };
        let cell = cells[number as usize];
        visits.push(visit("node", number, cell, given(limit), bits.count_ones()));
        let words = node_of_octants(nodes, number);
        for slot in 0..8 {
            let meta = [words[1].z, words[1].w][slot as usize / 4] >> (8 * (slot % 4)) & 0xff;
            let (count, place) = (meta >> 5, meta & 31);
            let is_leaf = words[0].w >> (24 + slot) & 1 == 0;
            if is_leaf && count > 0 && bits >> place & 1 == 1 {
                let leaf = Cell::of(box_of_octant(words, slot), cell.depth + 1);
                visits.push(visit("leaf", words[1].y + place, leaf, given(limit), count));
            }
        }
    }
    visits
}

fn node_of_octants(nodes: &[UVec4], index: u32) -> &[UVec4] {
    let vectors = octants::NODE_VECTORS as usize;
    &nodes[index as usize * vectors..][..vectors]
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

/// Nodes, of which the boxes of both children were tested, and leaves.
fn of_bvh2(scene: &Scene, record: &Record, given: &dyn Fn(f32) -> f32) -> Vec<Visit> {
    let mut leaves = HashMap::new();
    let mut nodes = HashMap::new();
    let mut waiting = vec![(0, root(scene))];
    while let Some((index, cell)) = waiting.pop() {
        let words = &scene.nodes[(index * bvh2::NODE_VECTORS) as usize..];
        let children = [0, 2].map(|at| (words[at].w, aabb_of(words[at], words[at + 1])));
        nodes.insert(children.map(|(_, aabb)| bits_of(&aabb)), (index, cell));
        for (link, aabb) in children {
            let child = Cell::of(aabb, cell.depth + 1);
            if link & LEAF == 0 {
                waiting.push((link, child));
            } else {
                leaves.insert((link & !LEAF) >> COUNT_BITS, child);
            }
        }
    }
    let mut visits = Vec::new();
    let mut first: Option<Aabb> = None;
    let mut nearest = record.ray.t_max;
    for event in &record.events {
        match (*event, first.take()) {
            (Event::Box(aabb), None) => first = Some(aabb),
            (Event::Box(second), Some(first)) => {
                if let Some((index, cell)) = nodes.get(&[bits_of(&first), bits_of(&second)]) {
                    visits.push(visit("node", *index, *cell, given(nearest), 0));
                }
            }
            (Event::Leaf { number, limit, bits }, _) => {
                nearest = limit;
                let cell = leaves.get(&number).copied().unwrap_or(root(scene));
                visits.push(visit("leaf", number, cell, given(limit), bits));
            }
        }
    }
    visits
}

fn aabb_of(low: UVec4, high: UVec4) -> Aabb {
    let corner = |words: UVec4| Vec3::from_array([words.x, words.y, words.z].map(f32::from_bits));
    Aabb {
        low: corner(low),
        high: corner(high),
    }
}

fn bits_of(aabb: &Aabb) -> [u32; 6] {
    let [a, b, c] = aabb.low.to_array().map(f32::to_bits);
    let [d, e, f] = aabb.high.to_array().map(f32::to_bits);
    [a, b, c, d, e, f]
}
