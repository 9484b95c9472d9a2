//! Triangles without order.

use crate::mesh::Mesh;
use glam::{Vec3, vec3};

/// A linear congruential generator of 64 bits (multiplier of Knuth's MMIX) whose upper half is taken: enough to scatter
/// triangles, and the same in every version of every library.
struct Random(u64);

impl Random {
    /// Uniform, -1 to 1.
    fn next(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let bits = (self.0 >> 40) as f32;
        bits / (1 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        vec3(self.next(), self.next(), self.next())
    }
}

/// So many triangles about a cube from -1 to 1, none connected with another. Their size shrinks with their number, so that
/// a ray through the cube meets about three, whatever the number: each corner lies within 6.3 divided by the square root
/// of the number of the triangle's centre, along every axis.
pub fn soup(triangles: u32) -> Mesh {
    let mut random = Random(0x6f6b_7461_6e74);
    let size = 6.3 / (triangles.max(1) as f32).sqrt();
    let positions = (0..triangles).flat_map(|_| {
        let center = random.vector();
        [(); 3].map(|()| center + random.vector() * size)
    });
    Mesh {
        positions: positions.collect(),
        triangles: (0..triangles).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    }
}
