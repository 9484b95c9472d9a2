//! Where the parts of structures lie that a ray visits.

use super::Visit;
use super::descent::{Cell, Content, children, grid_cell, of_bvh2, root};
use super::recorder::{Event, Record};
use crate::scene::Scene;
use glam::Vec3;
use oktant_shared::aabb::Aabb;
use oktant_shared::grid::{FIRST_CELL, Raster};
use oktant_shared::octants;
use oktant_shared::octree::Node;
use oktant_shared::parts::TraversalKind;
use std::collections::HashMap;

/// Where all parts of a scene's structure lie; it is made once for any number of rays.
pub struct Layout(Places);

enum Places {
    /// Nodes by index.
    Octants(Vec<Cell>),
    /// Nodes by index, leaves too.
    Octree(Vec<Cell>),
    Bvh2 {
        /// By the boxes of both children, with their index.
        nodes: HashMap<[[u32; 6]; 2], (u32, Cell)>,
        /// By the slot of their first triangle.
        leaves: HashMap<u32, Cell>,
    },
    Grid(Raster),
    Brute,
}

impl Layout {
    /// The layout of a scene's structure.
    pub fn new(scene: &Scene) -> Self {
        let whole = root(scene).0;
        Layout(match scene.parts.traversal {
            TraversalKind::Octants | TraversalKind::Compact => {
                let mut cells = vec![whole; scene.nodes.len() / octants::NODE_VECTORS as usize];
                descend(scene, |cell, content| {
                    if let Content::Inner(index) = content {
                        cells[index as usize] = cell;
                    }
                });
                Places::Octants(cells)
            }
            TraversalKind::Octree => {
                let mut cells = vec![whole; 2 * scene.nodes.len()];
                descend(scene, |cell, content| {
                    let (Content::Inner(index) | Content::Leaf { index, .. }) = content;
                    cells[index as usize] = cell;
                });
                Places::Octree(cells)
            }
            TraversalKind::Bvh2 => {
                let (mut nodes, mut leaves) = (HashMap::new(), HashMap::new());
                descend(scene, |cell, content| match content {
                    Content::Inner(index) => {
                        let boxes = of_bvh2(scene, index, &cell).map(|(child, _)| bits_of(child.low, child.high));
                        nodes.insert(boxes, (index, cell));
                    }
                    Content::Leaf { index, .. } => {
                        leaves.insert(index, cell);
                    }
                });
                Places::Bvh2 { nodes, leaves }
            }
            TraversalKind::Grid => Places::Grid(Raster::of(&scene.nodes)),
            TraversalKind::Brute => Places::Brute,
        })
    }

    /// What a ray visited in that scene. Limits are scaled to the `t` of the ray as it was given.
    pub fn visits(&self, scene: &Scene, record: &Record, scale: f32, advance: f32) -> Vec<Visit> {
        let given = |limit: f32| (limit + advance) * scale;
        match &self.0 {
            Places::Octants(cells) => of_octants(scene, cells, record, &given),
            Places::Octree(cells) => leaves(record, "leaf", &given, |number| cells[number as usize]),
            Places::Bvh2 { nodes, leaves } => of_bvh(scene, nodes, leaves, record, &given),
            Places::Grid(raster) => leaves(record, "cell", &given, |number| grid_cell(raster, number)),
            Places::Brute => leaves(record, "leaf", &given, |_| root(scene).0),
        }
    }

    /// The leaf or cell in which a ray found its hit, the first one that holds the triangle; none on a miss.
    pub fn leaf_of_hit(&self, scene: &Scene, record: &Record) -> Option<Visit> {
        let slot = record.hit.is_hit().then_some(record.hit.triangle)?;
        let listed = |node: Node| scene.references[node.first as usize..][..node.count as usize].contains(&slot);
        let holds = |visit: &Visit| match self.0 {
            Places::Octree(_) => listed(Node::at(&scene.nodes, visit.index)),
            Places::Grid(_) => listed(Node::at(&scene.nodes, FIRST_CELL + visit.index)),
            Places::Octants(_) | Places::Bvh2 { .. } | Places::Brute => {
                visit.kind != "node" && (visit.index..visit.index + visit.triangles).contains(&slot)
            }
        };
        self.visits(scene, record, 1.0, 0.0).into_iter().find(holds)
    }
}

/// Hands on everything in a structure.
fn descend(scene: &Scene, mut meet: impl FnMut(Cell, Content)) {
    let mut waiting = vec![root(scene)];
    while let Some((cell, content)) = waiting.pop() {
        meet(cell, content);
        if let Content::Inner(index) = content {
            waiting.extend(children(scene, index, &cell));
        }
    }
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

/// Nodes, and of each the leaves that were met.
fn of_octants(scene: &Scene, cells: &[Cell], record: &Record, given: &dyn Fn(f32) -> f32) -> Vec<Visit> {
    let mut visits = Vec::new();
    for event in &record.events {
        let Event::Leaf { number, limit, bits } = *event else {
            continue;
        };
        let cell = cells[number as usize];
        visits.push(visit("node", number, cell, given(limit), bits.count_ones()));
        let first = scene.nodes[(number * octants::NODE_VECTORS + 1) as usize].y;
        for (leaf, content) in children(scene, number, &cell) {
            if let Content::Leaf { index, triangles } = content
                && triangles > 0
                && bits >> (index - first) & 1 == 1
            {
                visits.push(visit("leaf", index, leaf, given(limit), triangles));
            }
        }
    }
    visits
}

/// Nodes, of which the boxes of both children were tested, and leaves.
fn of_bvh(
    scene: &Scene,
    nodes: &HashMap<[[u32; 6]; 2], (u32, Cell)>,
    leaves: &HashMap<u32, Cell>,
    record: &Record,
    given: &dyn Fn(f32) -> f32,
) -> Vec<Visit> {
    let mut visits = Vec::new();
    let mut first: Option<Aabb> = None;
    let mut nearest = record.ray.t_max;
    for event in &record.events {
        match (*event, first.take()) {
            (Event::Box(aabb), None) => first = Some(aabb),
            (Event::Box(second), Some(first)) => {
                let boxes = [first, second].map(|aabb| bits_of(aabb.low, aabb.high));
                if let Some((index, cell)) = nodes.get(&boxes) {
                    visits.push(visit("node", *index, *cell, given(nearest), 0));
                }
            }
            (Event::Leaf { number, limit, bits }, _) => {
                nearest = limit;
                let cell = leaves.get(&number).copied().unwrap_or(root(scene).0);
                visits.push(visit("leaf", number, cell, given(limit), bits));
            }
        }
    }
    visits
}

fn bits_of(low: Vec3, high: Vec3) -> [u32; 6] {
    let [a, b, c] = low.to_array().map(f32::to_bits);
    let [d, e, f] = high.to_array().map(f32::to_bits);
    [a, b, c, d, e, f]
}
