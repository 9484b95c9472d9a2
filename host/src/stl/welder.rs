//! Making one vertex of corners at the same place.

use super::fault::Fault;
use glam::DVec3;
use std::collections::HashMap;

/// Triangles whose corners share vertices.
#[derive(Default)]
pub(super) struct Welder {
    /// No two are equal. In f64, as text may have more digits than f32.
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The vertex at a place, by the bits of its coordinates.
    vertices: HashMap<[u64; 3], u32>,
}

impl Welder {
    /// Adds a triangle.
    pub(super) fn add(&mut self, corners: [DVec3; 3]) -> Result<(), Fault> {
        let mut triangle = [0; 3];
        for (vertex, corner) in triangle.iter_mut().zip(corners) {
            // -0.0 is the same place as 0.0.
            let corner = corner + DVec3::ZERO;
            let next = u32::try_from(self.positions.len()).map_err(|_| Fault::TooMany)?;
            *vertex = *self.vertices.entry(corner.to_array().map(f64::to_bits)).or_insert(next);
            if *vertex == next {
                self.positions.push(corner);
            }
        }
        if self.triangles.len() == u32::MAX as usize {
            return Err(Fault::TooMany);
        }
        self.triangles.push(triangle);
        Ok(())
    }
}
