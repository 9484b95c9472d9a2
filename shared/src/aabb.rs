//! The axis-aligned box.

use glam::Vec3;

/// An axis-aligned box; its faces belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Corner with the smallest coordinates, scene units.
    pub low: Vec3,
    /// Corner with the largest coordinates, scene units.
    pub high: Vec3,
}
