//! What trees are built over: the boxes of triangles.

use super::pages::Pages;
use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::octree::{LARGEST_EXTENT, SMALLEST_EXTENT, has_area};
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};
use rayon::prelude::*;

/// A box round a triangle.
///
/// The triangle's number is the bits of a fourth lane, so that an item is two SIMD registers; no arithmetic may touch it.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Item {
    low: Vec4,
    high: Vec4,
}

impl Item {
    /// Round a triangle.
    #[inline]
    fn new(id: u32, [a, b, c]: [Vec3; 3]) -> Self {
        Item {
            low: a.min(b).min(c).extend(f32::from_bits(id)),
            high: a.max(b).max(c).extend(0.0),
        }
    }

    /// Lowest corner; the fourth lane means nothing.
    pub fn low(&self) -> Vec4 {
        self.low
    }

    /// Highest corner; the fourth lane means nothing.
    pub fn high(&self) -> Vec4 {
        self.high
    }

    /// Twice the centre of the box; the fourth lane means nothing.
    pub fn centre(&self) -> Vec4 {
        self.low + self.high
    }

    /// Number of the triangle.
    pub fn id(&self) -> u32 {
        self.low.w.to_bits()
    }
}

/// The smallest box round boxes; the fourth lanes mean nothing.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub low: Vec4,
    pub high: Vec4,
}

impl Bounds {
    pub const EMPTY: Bounds = Bounds {
        low: Vec4::INFINITY,
        high: Vec4::NEG_INFINITY,
    };

    /// Of one item.
    pub fn of(item: &Item) -> Self {
        Bounds {
            low: item.low,
            high: item.high,
        }
    }

    pub fn with(self, low: Vec4, high: Vec4) -> Self {
        Bounds {
            low: self.low.min(low),
            high: self.high.max(high),
        }
    }

    pub fn and(self, other: Bounds) -> Self {
        self.with(other.low, other.high)
    }

    /// Half the surface.
    pub fn area(&self) -> f32 {
        let size = self.high - self.low;
        size.x * (size.y + size.z) + size.y * size.z
    }
}

/// The triangles that a ray can hit.
pub(super) struct Items {
    /// One for each triangle with an area, ascending ids.
    pub items: Pages<Item>,
    /// Triangles without area.
    pub degenerate: u32,
    /// Box round all items.
    pub bounds: Bounds,
}

/// Triangles that are worked on at a time.
const BLOCK: usize = 1 << 14;

impl Items {
    /// Boxes round the triangles of a mesh.
    pub fn of(mesh: &Mesh) -> Result<Self, BuildError> {
        let mut items = Pages::<Item>::zeroed(mesh.triangles.len());
        // Those with an area to the front of each block.
        let blocks: Vec<(Bounds, usize)> = items
            .par_chunks_mut(BLOCK)
            .zip(mesh.triangles.par_chunks(BLOCK))
            .enumerate()
            .map(|(block, (items, triangles))| {
                let (mut bounds, mut count) = (Bounds::EMPTY, 0);
                for (id, &[a, b, c]) in (block * BLOCK..).zip(triangles) {
                    let corners = [a, b, c].map(|index| mesh.positions[index as usize]);
                    if has_area(&corners) {
                        items[count] = Item::new(id as u32, corners);
                        bounds = bounds.and(Bounds::of(&items[count]));
                        count += 1;
                    }
                }
                (bounds, count)
            })
            .collect();
        let mut bounds = Bounds::EMPTY;
        let mut count = 0;
        for (block, (block_bounds, block_count)) in blocks.into_iter().enumerate() {
            let first = block * BLOCK;
            if first != count {
                items.copy_within(first..first + block_count, count);
            }
            bounds = bounds.and(block_bounds);
            count += block_count;
        }
        let degenerate = (mesh.triangles.len() - count) as u32;
        items.truncate(count);
        if items.is_empty() {
            return Err(BuildError::NoArea);
        }
        let extent = (bounds.high - bounds.low).truncate().as_dvec3().max_element();
        if !(f64::from(SMALLEST_EXTENT)..=f64::from(LARGEST_EXTENT)).contains(&extent) {
            return Err(BuildError::Extent(extent as f32));
        }
        Ok(Items {
            items,
            degenerate,
            bounds,
        })
    }
}
