//! Where a ray met a triangle.

use bytemuck::{Pod, Zeroable};
use glam::{UVec4, uvec4};

/// Stands for "no triangle" where a triangle id is expected.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// The nearest intersection of a ray, or a miss.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Hit {
    /// Ray parameter in lengths of the ray's direction; the ray's `t_max` on a miss.
    pub t: f32,
    /// The triangle; [`NO_TRIANGLE`] on a miss. Its slot where a traversal found it, its id (place in the mesh) where a
    /// back end reports it (see [`crate::scene::Scene::identified`]). Of equal `t` the lowest id wins.
    pub triangle: u32,
    /// Barycentric weight of the triangle's second vertex, 0 to 1; 0 on a miss.
    pub u: f32,
    /// Barycentric weight of the triangle's third vertex, 0 to 1; 0 on a miss.
    pub v: f32,
}

const _: () = assert!(size_of::<Hit>() == 16);

impl Hit {
    /// No hit up to `t_max`.
    #[inline]
    pub fn miss(t_max: f32) -> Self {
        Hit {
            t: t_max,
            triangle: NO_TRIANGLE,
            u: 0.0,
            v: 0.0,
        }
    }

    /// As a row of four words, see [`crate::triangle::Triangle`].
    #[inline(always)]
    pub fn row(&self) -> UVec4 {
        uvec4(self.t.to_bits(), self.triangle, self.u.to_bits(), self.v.to_bits())
    }

    /// Whether a triangle was hit.
    #[inline]
    pub fn is_hit(&self) -> bool {
        self.triangle != NO_TRIANGLE
    }
}
