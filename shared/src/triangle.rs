//! The triangle as the kernel reads it.

use crate::buffer::load;
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};

/// A triangle: its corners, and where their attributes lie. Counter-clockwise seen from outside.
///
/// Kernels read it as three rows of four words: rust-gpu loads a structure field by field, which takes twice as many
/// instructions.
#[repr(C, align(16))]
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
    /// The triangle at a slot of those that lie in rows.
    #[inline(always)]
    pub fn at(rows: &[Vec4], slot: u32) -> Self {
        Self::of_rows(load(rows, 3 * slot), load(rows, 3 * slot + 1), load(rows, 3 * slot + 2))
    }

    /// The triangle at a slot of those that are three indices each, of rows that hold a corner and its normal as a
    /// word (see [`crate::octahedral`]).
    #[inline(always)]
    pub fn indexed(corners: &[u32], rows: &[Vec4], slot: u32) -> Self {
        let vertex_a = load(corners, 3 * slot);
        let vertex_b = load(corners, 3 * slot + 1);
        let vertex_c = load(corners, 3 * slot + 2);
        let (a, b, c) = (load(rows, vertex_a), load(rows, vertex_b), load(rows, vertex_c));
        Triangle {
            a: Vec3::new(a.x, a.y, a.z),
            vertex_a,
            b: Vec3::new(b.x, b.y, b.z),
            vertex_b,
            c: Vec3::new(c.x, c.y, c.z),
            vertex_c,
        }
    }

    /// The triangle of three rows.
    #[inline(always)]
    pub fn of_rows(a: Vec4, b: Vec4, c: Vec4) -> Self {
        Triangle {
            a: Vec3::new(a.x, a.y, a.z),
            vertex_a: a.w.to_bits(),
            b: Vec3::new(b.x, b.y, b.z),
            vertex_b: b.w.to_bits(),
            c: Vec3::new(c.x, c.y, c.z),
            vertex_c: c.w.to_bits(),
        }
    }

    /// The point with barycentric weights `1 - u - v`, `u`, `v`, in scene units.
    pub fn point(&self, u: f32, v: f32) -> Vec3 {
        self.a + (self.b - self.a) * u + (self.c - self.a) * v
    }
}
