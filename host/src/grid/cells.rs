//! Which triangles belong to which cells.

use crate::octree::overlapped_children;
use glam::{DVec3, UVec3, Vec3};
use oktant_shared::grid::Raster;
use oktant_shared::octree::Node;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A triangle in a cell.
struct Reference {
    cell: u32,
    slot: u32,
}

/// The cells and their lists; nothing where they would hold more than `budget` references in all.
///
/// Cells are closed and widened by `margin`, scene units, on all sides.
pub(super) fn sorted_into(
    raster: &Raster,
    corners: &[[Vec3; 3]],
    margin: f32,
    budget: usize,
) -> Option<(Vec<Node>, Vec<u32>)> {
    const PIECE: usize = 4096;
    let total = AtomicUsize::new(0);
    let pieces: Vec<Vec<Reference>> = corners
        .par_chunks(PIECE)
        .enumerate()
        .map(|(piece, corners)| {
            let mut found = Vec::new();
            for (slot, corners) in (piece * PIECE..).zip(corners) {
                let before = found.len();
                overlapped(raster, corners, margin, |cell| {
                    found.push(Reference {
                        cell,
                        slot: slot as u32,
                    });
                });
                let grown = found.len() - before;
                if total.fetch_add(grown, Ordering::Relaxed) + grown > budget {
                    // Whatever is missing now, the whole is refused.
                    return Vec::new();
                }
            }
            found
        })
        .collect();
    if total.into_inner() > budget {
        return None;
    }
    // A counting sort: slots ascend in each cell because they do in the pieces.
    let mut cells = vec![Node { first: 0, count: 0 }; raster.total()];
    for reference in pieces.iter().flatten() {
        cells[reference.cell as usize].count += 1;
    }
    let mut sum = 0;
    for cell in &mut cells {
        cell.first = sum;
        sum += cell.count;
        cell.count = 0;
    }
    let mut references = vec![0; sum as usize];
    for reference in pieces.iter().flatten() {
        let cell = &mut cells[reference.cell as usize];
        references[(cell.first + cell.count) as usize] = reference.slot;
        cell.count += 1;
    }
    Some((cells, references))
}

/// Hands over the indices of all cells that a triangle overlaps.
fn overlapped(raster: &Raster, corners: &[Vec3; 3], margin: f32, mut found: impl FnMut(u32)) {
    let [a, b, c] = corners;
    let place = |corner: Vec3, margin: f32| {
        let place = (corner.as_dvec3() + f64::from(margin) - raster.low.as_dvec3()) / f64::from(raster.cell);
        let place = place.floor().max(DVec3::ZERO);
        UVec3::new(place.x as u32, place.y as u32, place.z as u32).min(raster.cells - 1)
    };
    let first = place(a.min(*b).min(*c), -margin);
    let last = place(a.max(*b).max(*c), margin);
    // The smallest block of 2^size cells in each direction, aligned as an octree's cells are, that holds all of it.
    let size = 32 - (first ^ last).max_element().leading_zeros();
    let mut open = vec![Block {
        place: first >> size << size,
        size,
    }];
    while let Some(block) = open.pop() {
        if block.size == 0 {
            let Block { place, .. } = block;
            found(place.x + raster.cells.x * (place.y + raster.cells.y * place.z));
            continue;
        }
        let size = block.size - 1;
        let half = raster.cell * (1_u32 << size) as f32;
        let center = raster.low + block.place.as_vec3() * raster.cell + half;
        let children = overlapped_children(corners, center, half, margin);
        for child in (0..8).filter(|child| children >> child & 1 == 1) {
            let place = block.place + (UVec3::new(child & 1, child >> 1 & 1, child >> 2) << size);
            let inside = place.cmple(last).all() && (place + (1 << size)).cmpgt(first).all();
            if inside {
                open.push(Block { place, size });
            }
        }
    }
}

/// A cube of cells.
struct Block {
    /// Its low corner, in cells.
    place: UVec3,
    /// Its edge is 2^size cells long.
    size: u32,
}
