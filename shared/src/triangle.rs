//! The triangle as the kernel reads it.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A triangle: its corners, and where their attributes lie. Counter-clockwise seen from outside.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Triangle {
    /// First corner, scene units.
    pub a: Vec3,
    /// Index of the first corner in the array of [`Vertex`].
    pub vertex_a: u32,
    /// Second corner, scene units.
    pub b: Vec3,
    /// Index of the second corner in the array of [`Vertex`].
    pub vertex_b: u32,
    /// Third corner, scene units.
    pub c: Vec3,
    /// Index of the third corner in the array of [`Vertex`].
    pub vertex_c: u32,
}

const _: () = assert!(size_of::<Triangle>() == 48);

/// What a vertex carries beside its position; read once for each shaded hit.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// Unit normal, or zero where the mesh has none here (the face normal is used then).
    pub normal: Vec3,
    /// Colour, 8 bits each for red (lowest), green, blue and alpha, sRGB-encoded.
    pub color: u32,
}

const _: () = assert!(size_of::<Vertex>() == 16);

impl Triangle {
    /// The point with barycentric weights `1 - u - v`, `u`, `v`, in scene units.
    pub fn point(&self, u: f32, v: f32) -> Vec3 {
        self.a + (self.b - self.a) * u + (self.c - self.a) * v
    }
}
