//! The planes of an octree.

use glam::Vec3;

/// The planes between an octree's cells: at `low + i * size / 2^level` on every axis, for levels up to `depth`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellGrid {
    /// Lowest corner of the root cube, scene units.
    pub low: Vec3,
    /// Edge of the root cube, scene units.
    pub size: f32,
    /// Finest level; the root is level 0.
    pub depth: u32,
}

impl CellGrid {
    /// A coordinate of the grid. Indices beyond the root cube continue it.
    pub(super) fn plane(&self, axis: usize, level: u32, index: i64) -> f64 {
        f64::from(self.low[axis]) + index as f64 * f64::from(self.size) / (1_u64 << level) as f64
    }

    /// The same where it is known to be an f32.
    pub(super) fn exact_plane(&self, axis: usize, level: u32, index: i64) -> f32 {
        let plane = self.plane(axis, level, index);
        assert_eq!(
            f64::from(plane as f32),
            plane,
            "plane {index} of level {level} on axis {axis} is no f32"
        );
        plane as f32
    }

    /// The indices of the planes of a level between two coordinates, both included; possibly none.
    pub(super) fn between(&self, axis: usize, level: u32, low: f32, high: f32) -> (i64, i64) {
        let cell = f64::from(self.size) / (1_u64 << level) as f64;
        let index = |coordinate: f32| (f64::from(coordinate) - f64::from(self.low[axis])) / cell;
        let last = 1_i64 << level;
        (
            (index(low).ceil() as i64).max(0),
            (index(high).floor() as i64).min(last),
        )
    }
}
