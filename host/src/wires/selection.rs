//! Which cells are drawn.

use crate::insight::shortened;
use crate::scene::Scene;
use crate::seen::middles;
use crate::structure::Figures;
use crate::trace::{Cell, Content, Layout, Recorder, children, root};
use glam::{UVec2, Vec3};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use std::collections::HashSet;
use std::fmt;

/// Cells to choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    /// All leaves, or cells of a grid, that hold triangles.
    Leaves,
    /// All nodes and leaves of a level that hold triangles; the root's is 0.
    Level(u32),
    /// What the ray through the middle of that pixel visits.
    Pixel([u32; 2]),
}

/// No more cells are drawn than this: lines would cover everything.
pub const MOST: usize = 10_000;

/// The cells that a selection chose.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// What was asked for.
    pub selection: Selection,
    /// The cells. Where there are more than [`MOST`], they are of leaves those on the levels nearest to the root, and of one level
    /// those nearest to the camera.
    pub cells: Vec<Cell>,
    /// How many more there are.
    pub left_out: usize,
}

impl Chosen {
    /// The cells of a scene's structure, as the camera of a frame comes by them.
    pub fn new(scene: &Scene, selection: Selection, frame: &Frame) -> Self {
        let eye = frame.camera.eye;
        let (cells, left_out) = match selection {
            Selection::Leaves => leaves(scene, eye, MOST),
            Selection::Level(level) => {
                let cells = of_level(scene, level);
                nearest(cells, eye, MOST)
            }
            Selection::Pixel([x, y]) => {
                let ray = sample_ray(&middles(frame), UVec2::new(x, y), 0);
                (visited(scene, &shortened(scene, ray)).1, 0)
            }
        };
        Chosen {
            selection,
            cells,
            left_out,
        }
    }
}

impl fmt::Display for Chosen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.cells.len();
        match self.selection {
            Selection::Leaves => write!(f, "{count} leaves")?,
            Selection::Level(level) => write!(f, "{count} cells of level {level}")?,
            Selection::Pixel([x, y]) => write!(f, "{count} cells that the ray of pixel {x}, {y} visits")?,
        }
        match (self.left_out, self.selection) {
            (0, _) => Ok(()),
            (more, Selection::Leaves) => write!(f, ", those nearest to the root; {more} more are left out"),
            (more, _) => write!(f, ", the nearest; {more} more are left out"),
        }
    }
}

/// The closest hit of a ray, with the triangle's slot, and everything that it visits, each cell once.
pub(crate) fn visited(scene: &Scene, ray: &Ray) -> (Hit, Vec<Cell>) {
    let record = Recorder::new(scene).record(scene, ray);
    let mut known = HashSet::new();
    let visits = Layout::new(scene).visits(scene, &record, 1.0, 0.0);
    let visits = visits
        .into_iter()
        .filter(|visit| known.insert((visit.kind, visit.index)));
    let cells = visits.map(|visit| Cell {
        low: visit.low.into(),
        high: visit.high.into(),
        depth: visit.depth,
    });
    (record.hit, cells.collect())
}

/// Inner nodes of a level, by index.
type Inner = Vec<(u32, Cell)>;

/// The cells of inner nodes, apart into inner nodes and filled leaves.
fn below(scene: &Scene, nodes: &Inner) -> (Inner, Vec<Cell>) {
    apart(nodes.iter().flat_map(|(index, cell)| children(scene, *index, cell)))
}

fn apart(places: impl Iterator<Item = (Cell, Content)>) -> (Inner, Vec<Cell>) {
    let (mut inner, mut filled) = (Vec::new(), Vec::new());
    for (cell, content) in places {
        match content {
            Content::Inner(index) => inner.push((index, cell)),
            Content::Leaf { triangles, .. } if triangles > 0 => filled.push(cell),
            Content::Leaf { .. } => {}
        }
    }
    (inner, filled)
}

/// Level 0: the whole, or the cells of a grid.
fn top(scene: &Scene) -> (Inner, Vec<Cell>) {
    let top = apart([root(scene)].into_iter());
    if scene.parts.traversal == TraversalKind::Grid {
        below(scene, &top.0)
    } else {
        top
    }
}

/// Leaves level by level, until there are enough, of the last level the nearest ones; and how many are left out.
fn leaves(scene: &Scene, eye: Vec3, most: usize) -> (Vec<Cell>, usize) {
    let (mut inner, mut filled) = top(scene);
    let mut cells = Vec::new();
    loop {
        let (kept, left_out) = nearest(filled, eye, most - cells.len());
        cells.extend(kept);
        if inner.is_empty() {
            return (cells, left_out);
        }
        if cells.len() == most {
            // Those below need no boxes to be counted.
            let all = Figures::new(scene.parts.traversal, &scene.nodes).filled;
            return (cells, all - most);
        }
        (inner, filled) = below(scene, &inner);
    }
}

fn of_level(scene: &Scene, level: u32) -> Vec<Cell> {
    let (mut inner, mut filled) = top(scene);
    for _ in 0..level {
        (inner, filled) = below(scene, &inner);
    }
    let nodes = inner.into_iter().map(|(_, cell)| cell);
    filled.extend(nodes);
    filled
}

/// So many of them at most, those nearest to a point, and how many are left out.
fn nearest(mut cells: Vec<Cell>, eye: Vec3, most: usize) -> (Vec<Cell>, usize) {
    let left_out = cells.len().saturating_sub(most);
    if left_out > 0 {
        let distance = |cell: &Cell| eye.clamp(cell.low, cell.high).distance_squared(eye);
        cells.select_nth_unstable_by(most, |a, b| distance(a).total_cmp(&distance(b)));
        cells.truncate(most);
    }
    (cells, left_out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use crate::view::View;

    fn scene(traversal: TraversalKind) -> Scene {
        Scene::new(&balls::balls(), &StructureOptions::of(traversal), &silent).unwrap()
    }

    fn chosen(scene: &Scene, selection: Selection) -> Chosen {
        Chosen::new(scene, selection, &View::default().frame(scene, 64, 48))
    }

    #[test]
    fn all_leaves_are_found_and_limits_are_kept() {
        for traversal in TraversalKind::ALL {
            let scene = scene(*traversal);
            let filled = Figures::new(*traversal, &scene.nodes).filled;
            let all = leaves(&scene, Vec3::ZERO, usize::MAX);
            assert_eq!((all.0.len(), all.1), (filled, 0), "{traversal}");
            let few = leaves(&scene, Vec3::ZERO, 20);
            assert_eq!(few.0.len(), filled.min(20), "{traversal}");
            assert_eq!(few.1, filled.saturating_sub(20), "{traversal}");
            let deepest = |cells: &[Cell]| cells.iter().map(|cell| cell.depth).max();
            assert!(deepest(&few.0) <= deepest(&all.0), "{traversal}");
        }
    }

    #[test]
    fn what_is_left_out_is_told() {
        let mut chosen = Chosen {
            selection: Selection::Leaves,
            cells: Vec::new(),
            left_out: 0,
        };
        assert_eq!(chosen.to_string(), "0 leaves");
        chosen.left_out = 7;
        assert_eq!(
            chosen.to_string(),
            "0 leaves, those nearest to the root; 7 more are left out"
        );
        chosen.selection = Selection::Level(3);
        assert_eq!(
            chosen.to_string(),
            "0 cells of level 3, the nearest; 7 more are left out"
        );
    }

    #[test]
    fn levels_have_their_cells() {
        for traversal in [TraversalKind::Octants, TraversalKind::Octree, TraversalKind::Bvh2] {
            let scene = scene(traversal);
            let depth = Figures::new(traversal, &scene.nodes).depth;
            for level in [0, 1, depth, depth + 1] {
                let chosen = chosen(&scene, Selection::Level(level));
                assert!(chosen.cells.iter().all(|cell| cell.depth == level), "{traversal}");
                assert_eq!(chosen.cells.is_empty(), level > depth, "{traversal}, level {level}");
            }
        }
        let grid = scene(TraversalKind::Grid);
        let filled = Figures::new(TraversalKind::Grid, &grid.nodes).filled;
        assert_eq!(chosen(&grid, Selection::Level(0)).cells.len(), filled);
    }

    #[test]
    fn the_nearest_are_kept() {
        let cell = |x: f32| Cell {
            low: Vec3::splat(x),
            high: Vec3::splat(x + 0.5),
            depth: 3,
        };
        let (kept, left_out) = nearest(vec![cell(5.0), cell(1.0), cell(9.0), cell(2.0)], Vec3::ZERO, 2);
        let mut lows: Vec<f32> = kept.iter().map(|cell| cell.low.x).collect();
        lows.sort_by(f32::total_cmp);
        assert_eq!((lows, left_out), (vec![1.0, 2.0], 2));
    }

    #[test]
    fn what_a_ray_visits_is_chosen_once() {
        for traversal in [
            TraversalKind::Octants,
            TraversalKind::Octree,
            TraversalKind::Bvh2,
            TraversalKind::Grid,
        ] {
            let scene = scene(traversal);
            let chosen = chosen(&scene, Selection::Pixel([32, 24]));
            assert!(chosen.cells.len() > 1, "{traversal}");
            let text = chosen.to_string();
            assert!(text.ends_with("cells that the ray of pixel 32, 24 visits"), "{text}");
        }
    }
}
