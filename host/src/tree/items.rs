//! What trees are built over: the boxes of triangles.

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};

/// A box round a triangle, or round several.
///
/// The number of the triangle, or of the first of the several, and how many there are, are the bits of fourth lanes, so that
/// an item is two SIMD registers; no arithmetic may touch them.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Item {
    low: Vec4,
    high: Vec4,
}

impl Item {
    /// Round a triangle.
    #[inline]
    pub fn new(id: u32, [a, b, c]: [Vec3; 3]) -> Self {
        Item {
            low: a.min(b).min(c).extend(f32::from_bits(id)),
            high: a.max(b).max(c).extend(f32::from_bits(1)),
        }
    }

    /// Round some of many items, from the one at `first` on, as an item of their number.
    pub fn round(first: u32, items: &[Item]) -> Self {
        let bounds = items
            .iter()
            .fold(Bounds::EMPTY, |bounds, item| bounds.and(Bounds::of(item)));
        Item {
            low: bounds.low.truncate().extend(f32::from_bits(first)),
            high: bounds.high.truncate().extend(f32::from_bits(items.len() as u32)),
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

    /// Number of the triangle, or of the first one.
    pub fn id(&self) -> u32 {
        self.low.w.to_bits()
    }

    /// How many triangles it stands for.
    pub fn count(&self) -> u32 {
        self.high.w.to_bits()
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
