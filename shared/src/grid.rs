//! The uniform grid.

use crate::arithmetic::{max, max_component, min, min_component};
use crate::buffer::load;
use crate::entered::Entered;
use crate::octree::Node;
use crate::revelles::reciprocal;
use crate::scene::Scene;
use crate::walk::{self, Along, List};
use glam::{UVec3, UVec4, Vec3};

/// The raster of a grid's cells, in the first two vectors of a scene's nodes.
///
/// The planes between cells are at `low + i * cell`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raster {
    /// Cells along each axis, at least 1 and at most [`MAX_CELLS`].
    pub cells: UVec3,
    /// Corner with the smallest coordinates, scene units.
    pub low: Vec3,
    /// Edge length of a cell, scene units.
    pub cell: f32,
}

/// Most cells along an axis: f32 counts them, and their planes, without rounding.
pub const MAX_CELLS: u32 = 1 << 12;

/// Cells lie two by two in the vectors; so many places before the first are the raster's.
pub const FIRST_CELL: u32 = 4;

impl Raster {
    /// The raster of a scene's grid.
    #[inline]
    pub fn of(nodes: &[UVec4]) -> Self {
        let (counts, place) = (load(nodes, 0), load(nodes, 1));
        Raster {
            cells: UVec3::new(counts.x, counts.y, counts.z),
            low: Vec3::new(
                f32::from_bits(place.x),
                f32::from_bits(place.y),
                f32::from_bits(place.z),
            ),
            cell: f32::from_bits(place.w),
        }
    }

    /// The vectors that [`Raster::of`] reads.
    pub fn words(&self) -> [UVec4; 2] {
        let low = self.low;
        [
            self.cells.extend(0),
            UVec4::new(low.x.to_bits(), low.y.to_bits(), low.z.to_bits(), self.cell.to_bits()),
        ]
    }

    /// Cells in all.
    pub fn total(&self) -> usize {
        self.cells.x as usize * self.cells.y as usize * self.cells.z as usize
    }

    /// Corner with the largest coordinates, scene units.
    #[inline]
    pub fn high(&self) -> Vec3 {
        self.low + self.count() * self.cell
    }

    /// [`Raster::cells`] as numbers to compute with.
    #[inline]
    fn count(&self) -> Vec3 {
        Vec3::new(self.cells.x as f32, self.cells.y as f32, self.cells.z as f32)
    }
}

/// Cells of one size, each with the list of its triangles (A. Fujimoto, T. Tanaka, K. Iwata, "ARTS: accelerated
/// ray-tracing system", IEEE CG&A 6(4), 1986), with the box test `B` at the root and the triangle test `T`.
///
/// A ray goes from cell to cell through the nearest of the next three planes (J. Amanatides and A. Woo, "A fast voxel
/// traversal algorithm for ray tracing", Eurographics 1987).
///
/// Deviations:
/// - A plane is crossed where it is; the published sum of steps would add up the rounding of each.
/// - Cells are closed and widened by [`crate::octree::CELL_MARGIN`] of the root, so it does not matter which of two
///   neighbours a ray in their common plane visits. A zero direction component counts as a tiny positive one.
/// - The search ends only when the nearest hit lies before the exit of the cell, for triangles reach beyond it.
/// - A triangle in several cells is tested in each; there are no mailboxes.
pub type Grid<B, T> = Along<Walk, B, T>;

/// Further than any ray goes; a product with a component of the direction is still finite.
const FAR: f32 = 1.0e38;

/// The walk of a ray from cell to cell.
///
/// Planes are counted from the corner that the ray moves away from, so that along every axis their number and `t` grow
/// together.
pub struct Walk {
    origin: Vec3,
    reciprocal: Vec3,
    /// Where plane 0 is, scene units.
    start: Vec3,
    /// From a plane to the next, scene units, signed.
    step: Vec3,
    /// Numbers of the planes through which the ray may leave the cell.
    next: Vec3,
    /// Numbers of the last planes.
    last: Vec3,
    /// Where the ray crosses the next planes.
    exits: Vec3,
    /// Index of the cell.
    index: u32,
    /// What a step along each axis adds to the index, wrapping.
    strides: UVec3,
    /// False when the ray has left the grid, or needs to look no further.
    inside: bool,
}

impl Walk {
    /// The walk of a ray that there is no grid for.
    pub fn nowhere() -> Self {
        Walk {
            origin: Vec3::ZERO,
            reciprocal: Vec3::ZERO,
            start: Vec3::ZERO,
            step: Vec3::ZERO,
            next: Vec3::ZERO,
            last: Vec3::ZERO,
            exits: Vec3::ZERO,
            index: 0,
            strides: UVec3::ZERO,
            inside: false,
        }
    }
}

impl walk::Walk for Walk {
    type Leaf = List;

    #[inline(always)]
    fn new(scene: &Scene<'_>, entered: &Entered) -> Self {
        let raster = Raster::of(scene.nodes);
        let (origin, direction) = (entered.ray.origin, entered.ray.direction);
        let (low, high, cell) = (raster.low, raster.high(), raster.cell);
        let back_x = direction.x < 0.0;
        let back_y = direction.y < 0.0;
        let back_z = direction.z < 0.0;
        let start = Vec3::new(
            if back_x { high.x } else { low.x },
            if back_y { high.y } else { low.y },
            if back_z { high.z } else { low.z },
        );
        let step = Vec3::new(
            if back_x { -cell } else { cell },
            if back_y { -cell } else { cell },
            if back_z { -cell } else { cell },
        );
        let reciprocal = Vec3::new(
            reciprocal(direction.x),
            reciprocal(direction.y),
            reciprocal(direction.z),
        );
        let enter = max(max_component((start - origin) * reciprocal), entered.ray.t_min);
        let last = raster.count();
        // A ray that passes by the grid, or misses the cell by a rounding, begins in the nearest one.
        let place = (origin + direction * min(enter, FAR) - start) / step;
        let place = UVec3::new(
            place_within(place.x, last.x),
            place_within(place.y, last.y),
            place_within(place.z, last.z),
        );
        let next = Vec3::new(place.x as f32 + 1.0, place.y as f32 + 1.0, place.z as f32 + 1.0);
        let cells = raster.cells;
        let index = along(back_x, place.x, cells.x)
            + cells.x * (along(back_y, place.y, cells.y) + cells.y * along(back_z, place.z, cells.z));
        Walk {
            origin,
            reciprocal,
            start,
            step,
            next,
            last,
            exits: (start + step * next - origin) * reciprocal,
            index,
            strides: UVec3::new(
                stride(back_x, 1),
                stride(back_y, cells.x),
                stride(back_z, cells.x * cells.y),
            ),
            inside: entered.inside,
        }
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        self.inside
    }

    /// The current cell.
    #[inline(always)]
    fn leaf(&mut self, scene: &Scene<'_>, _: f32) -> List {
        let cell = Node::at(scene.nodes, FIRST_CELL + self.index);
        List {
            next: cell.first,
            end: cell.first + cell.count,
        }
    }

    /// Leaves the cell for the next one on the way, unless the ray ends before at `limit`.
    #[inline(always)]
    fn leave(&mut self, limit: f32) {
        let exit = min_component(self.exits);
        let x = self.exits.x <= exit;
        let y = !x & (self.exits.y <= exit);
        let z = !x & !y;
        let (next, last) = if x {
            (self.next.x, self.last.x)
        } else if y {
            (self.next.y, self.last.y)
        } else {
            (self.next.z, self.last.z)
        };
        self.inside = (next < last) & (exit < limit);
        self.next += Vec3::new(
            if x { 1.0 } else { 0.0 },
            if y { 1.0 } else { 0.0 },
            if z { 1.0 } else { 0.0 },
        );
        self.index = self.index.wrapping_add(if x {
            self.strides.x
        } else if y {
            self.strides.y
        } else {
            self.strides.z
        });
        self.exits = (self.start + self.step * self.next - self.origin) * self.reciprocal;
    }
}

/// The whole part of a number of cells, within those that there are.
#[inline]
fn place_within(cells: f32, count: f32) -> u32 {
    max(min(cells, count - 1.0), 0.0) as u32
}

/// The number of a cell along an axis, from the low coordinates, of one that is counted from where the ray comes.
#[inline]
fn along(back: bool, place: u32, count: u32) -> u32 {
    if back { count - 1 - place } else { place }
}

/// What a step along an axis adds to a cell's index, wrapping.
#[inline]
fn stride(back: bool, length: u32) -> u32 {
    if back { 0_u32.wrapping_sub(length) } else { length }
}
