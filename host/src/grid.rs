//! The uniform grid: its resolution, and the lists of its cells.

mod cells;
mod raster;

use crate::build_error::BuildError;
use crate::hittable::Hittable;
use crate::mesh::Mesh;
use crate::octree::root;
use crate::progress::Progress;
use cells::sorted_into;
use glam::Vec3;
use oktant_shared::grid::Raster;
use oktant_shared::octree::{CELL_MARGIN, Node, Root};
use raster::raster;
use rayon::prelude::*;

/// What limits a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridOptions {
    /// Cells for each triangle, above 0.
    pub density: f32,
    /// Hard limit of references, as a multiple of the triangles, at least 1.
    pub budget: u32,
}

impl Default for GridOptions {
    /// Cells and references take about as much memory as the triangles.
    fn default() -> Self {
        GridOptions {
            density: 4.0,
            budget: 32,
        }
    }
}

/// A uniform grid over the triangles of a mesh, as flat arrays.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The cube around everything; the grid fills the part of it that has triangles.
    pub root: Root,
    /// How the cells lie.
    pub raster: Raster,
    /// The cells, x fastest, then y.
    pub cells: Vec<Node>,
    /// Slots of triangles, cell by cell, ascending in each.
    pub references: Vec<u32>,
    /// The triangles' ids by slot.
    pub ids: Vec<u32>,
    /// Triangles left out because they have no area.
    pub degenerate: u32,
    /// Triangles left out because they lie exactly on one with a lower id.
    pub duplicates: u32,
}

/// How far the planes of cells and the ray's crossings with them may be off, in parts of the largest coordinate.
const COORDINATE_MARGIN: f32 = 4.0 * f32::EPSILON;

impl Grid {
    /// Builds the grid of a mesh, a coarser one where the options' would take more references than their limit; the same
    /// one for the same mesh, whatever the number of threads.
    ///
    /// # Errors
    /// [`BuildError`] where the mesh has nothing to build it from.
    pub fn build(mesh: &Mesh, options: &GridOptions, progress: Progress<'_>) -> Result<Self, BuildError> {
        let hittable = Hittable::of(mesh)?;
        let (low, high) = (hittable.low, hittable.high);
        let corners: Vec<[Vec3; 3]> = hittable
            .ids
            .par_iter()
            .map(|id| hittable.corners[*id as usize])
            .collect();
        let root = root(low, high, 0)?;
        let largest = root.low.abs().max(root.high.abs()).max_element();
        let margin = root.size() * CELL_MARGIN + largest * COORDINATE_MARGIN;

        let budget = corners.len() * options.budget.max(1) as usize;
        let mut cells = f64::from(options.density) * corners.len() as f64;
        progress("building", 0.0);
        let (raster, (cells, references)) = loop {
            let raster = raster(low, high, margin, cells);
            if let Some(sorted) = sorted_into(&raster, &corners, margin, budget) {
                break (raster, sorted);
            }
            cells /= 4.0;
        };
        progress("building", 1.0);
        Ok(Grid {
            root,
            raster,
            cells,
            references,
            ids: hittable.ids,
            degenerate: hittable.degenerate,
            duplicates: hittable.duplicates,
        })
    }
}

#[cfg(test)]
mod tests;
