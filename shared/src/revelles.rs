//! The parametric octree traversal.

use crate::arithmetic::{max, max_component, min_component};
use crate::buffer::{blank, get, put};
use crate::entered::Entered;
use crate::octree::{MAX_DEPTH, Node};
use crate::scene::Scene;
use crate::walk::{self, Along, List};
use glam::{UVec3, Vec3};

/// J. Revelles, C. Urena, M. Lastra, "An efficient parametric algorithm for octree traversal", WSCG 2000, with the box
/// test `B` at the root and the triangle test `T` in the leaves.
///
/// A cell is entered and left where the ray crosses the planes of its faces. Which child comes first follows from the
/// order of the entry and the middle planes, which comes next from the plane through which the ray leaves.
///
/// Deviations, each for a failure of the published form:
/// - Planes are mirrored instead of the ray, and middle planes are crossed where they are, not half-way between the
///   parent's: nothing is rounded in the cells' places and no error adds up over levels.
/// - A zero direction component counts as a tiny positive one for finding cells. Cells are closed and widened by
///   [`crate::octree::CELL_MARGIN`], so it does not matter which of two neighbours a ray in their common plane visits.
/// - The search ends only when the nearest hit lies before the exit of the cell, for triangles reach beyond it.
/// - A ray from afar is traced from shortly before the root, so that `t` resolves the cells.
/// - No recursion: the path is the integer place of the cell, and the stack holds just the children's indices.
pub type Revelles<B, T> = Along<Walk, B, T>;

/// Direction components smaller than this count as this for finding cells.
const LEAST_SLOPE: f32 = 7.888_609e-31; // 2^-100

/// The walk of a ray from leaf to leaf.
///
/// Places are counted in smallest cells from the corner of the root that the ray moves away from, so that along every
/// axis places and `t` grow together.
pub struct Walk {
    origin: Vec3,
    reciprocal: Vec3,
    /// Where place 0 is, scene units.
    start: Vec3,
    /// From a place to the next, scene units, signed.
    step: Vec3,
    /// Axes along which places run against the coordinates; bits as in the index of a child.
    mirrored: u32,
    /// Low corner of the cell, in places.
    place: UVec3,
    /// The cell's edge length is 2^size places.
    size: u32,
    depth: u32,
    /// The cell's index.
    node: u32,
    /// Where the ray enters the cell.
    enter: f32,
    /// Index of the first child of the cell on the path that has size 2^(i + 1).
    stack: [u32; MAX_DEPTH as usize],
    /// False when the ray has left the root, or needs to look no further.
    inside: bool,
}

impl walk::Walk for Walk {
    type Leaf = List;

    #[inline(always)]
    fn new(scene: &Scene<'_>, entered: &Entered) -> Self {
        let root = &scene.root;
        let direction = entered.ray.direction;
        let mirrored = bits(direction.x < 0.0, direction.y < 0.0, direction.z < 0.0);
        let mut walk = Walk {
            origin: entered.ray.origin,
            reciprocal: Vec3::new(
                reciprocal(direction.x),
                reciprocal(direction.y),
                reciprocal(direction.z),
            ),
            start: Vec3::new(
                if direction.x < 0.0 { root.high.x } else { root.low.x },
                if direction.y < 0.0 { root.high.y } else { root.low.y },
                if direction.z < 0.0 { root.high.z } else { root.low.z },
            ),
            step: Vec3::new(
                if direction.x < 0.0 { -root.cell } else { root.cell },
                if direction.y < 0.0 { -root.cell } else { root.cell },
                if direction.z < 0.0 { -root.cell } else { root.cell },
            ),
            mirrored,
            place: UVec3::ZERO,
            size: root.depth,
            depth: root.depth,
            node: 0,
            enter: 0.0,
            stack: blank(0),
            inside: entered.inside,
        };
        walk.enter = max(max_component(walk.crossings(UVec3::ZERO)), entered.ray.t_min);
        walk
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        self.inside
    }

    /// Goes down to the leaf at the place where the ray enters the current cell.
    #[inline(always)]
    fn leaf(&mut self, scene: &Scene<'_>, _: f32) -> List {
        let mut node = Node::at(scene.nodes, self.node);
        if node.is_inner() {
            loop {
                self.size -= 1;
                put(&mut self.stack, self.size, node.first);
                let half = 1 << self.size;
                let middle = self.crossings(self.place + UVec3::splat(half));
                let x = middle.x <= self.enter;
                let y = middle.y <= self.enter;
                let z = middle.z <= self.enter;
                self.place += UVec3::new(
                    if x { half } else { 0 },
                    if y { half } else { 0 },
                    if z { half } else { 0 },
                );
                self.node = node.first + (bits(x, y, z) ^ self.mirrored);
                node = Node::at(scene.nodes, self.node);
                if !node.is_inner() {
                    break;
                }
            }
        }
        List {
            next: node.first,
            end: node.first + node.count,
        }
    }

    /// Leaves the current leaf for the next cell on the way, unless the ray ends before at `limit`.
    #[inline(always)]
    fn leave(&mut self, limit: f32) {
        let length = 1 << self.size;
        let exits = self.crossings(self.place + UVec3::splat(length));
        let exit = min_component(exits);
        let before = self.place;
        let changed = if exits.x <= exit {
            self.place.x += length;
            before.x ^ self.place.x
        } else if exits.y <= exit {
            self.place.y += length;
            before.y ^ self.place.y
        } else {
            self.place.z += length;
            before.z ^ self.place.z
        };
        // The highest bit that changed is the size of the largest cell that was left.
        let size = 31 - changed.leading_zeros();
        self.inside = (size < self.depth) & (exit < limit);
        if self.inside {
            self.size = size;
            self.enter = exit;
            let lower = (1 << size) - 1;
            self.place = UVec3::new(self.place.x & !lower, self.place.y & !lower, self.place.z & !lower);
            let child = bits(
                self.place.x >> size & 1 == 1,
                self.place.y >> size & 1 == 1,
                self.place.z >> size & 1 == 1,
            );
            self.node = get(&self.stack, size) + (child ^ self.mirrored);
        }
    }
}

impl Walk {
    /// Where the ray crosses the three planes through a place.
    #[inline(always)]
    fn crossings(&self, place: UVec3) -> Vec3 {
        // Exact: the planes of all cells are (see `Root`).
        let plane = self.start + self.step * Vec3::new(place.x as f32, place.y as f32, place.z as f32);
        (plane - self.origin) * self.reciprocal
    }
}

/// The index of a child, from whether it is the upper one along each axis.
#[inline]
fn bits(x: bool, y: bool, z: bool) -> u32 {
    (if x { 1 } else { 0 }) | (if y { 2 } else { 0 }) | (if z { 4 } else { 0 })
}

/// The reciprocal of a direction's component for finding cells; zero counts as a tiny positive one.
#[inline]
pub(crate) fn reciprocal(component: f32) -> f32 {
    if component.abs() < LEAST_SLOPE {
        1.0 / LEAST_SLOPE
    } else {
        1.0 / component
    }
}
