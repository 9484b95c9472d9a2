//! The watertight test.

#[cfg(not(target_arch = "spirv"))]
mod edge_on;
#[cfg(target_arch = "x86_64")]
mod eight;
#[cfg(target_arch = "x86_64")]
mod four;

#[cfg(target_arch = "x86_64")]
pub use eight::{Eight, EightCrossings};

use super::{Crossing, TriangleTest};
use crate::arithmetic::{difference_of_products, multiply_subtract};
use crate::ray::PreparedRay;
use crate::triangle::Triangle;
#[cfg(target_arch = "x86_64")]
use crate::triangle_test::Crossings;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::__m256;
use glam::Vec3;
#[cfg(target_arch = "x86_64")]
use glam::Vec4;

/// S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013: the triangle is sheared until
/// the ray runs along an axis, then the origin is placed by three edge functions that two neighbours compute alike.
///
/// Deviations: the fall-back to f64 is not for edge functions of exactly zero (both neighbours then report the hit, and the
/// lower id wins), but for triangles that are seen so much edge-on that f32 could say nothing (see `edge_on`), and on the
/// CPU only; on a GPU the edge functions are Kahan's difference of products, which needs none, and because a contracted one
/// leaks (see [`difference_of_products`]); the winding is not restored for rays along a negative axis, the test being
/// two-sided.
#[derive(Clone, Copy, Debug)]
pub struct Watertight {
    /// The ray's origin with its axes rotated so that the largest direction component is last.
    origin: Vec3,
    /// Axis of the largest direction component.
    axis: u32,
    /// Shear along x and y, and the reciprocal of the largest direction component.
    shear: Vec3,
}

impl TriangleTest for Watertight {
    #[inline]
    fn prepare(ray: &PreparedRay) -> Self {
        let size = ray.direction.abs();
        #[cfg(target_arch = "spirv")]
        let axis = if (size.x >= size.y) & (size.x >= size.z) {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        // A sum of comparisons is no branch, which no processor would foresee.
        #[cfg(not(target_arch = "spirv"))]
        let axis = u32::from((size.x < size.y) | (size.x < size.z)) * (1 + u32::from(size.y < size.z));
        let direction = turned(ray.direction, axis);
        let reciprocal = 1.0 / direction.z;
        Watertight {
            origin: turned(ray.origin, axis),
            axis,
            shear: Vec3::new(direction.x * reciprocal, direction.y * reciprocal, reciprocal),
        }
    }

    #[inline]
    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let a = self.sheared(triangle.a);
        let b = self.sheared(triangle.b);
        let c = self.sheared(triangle.c);
        let weight_a = difference_of_products(c.x, b.y, c.y, b.x);
        let weight_b = difference_of_products(a.x, c.y, a.y, c.x);
        let weight_c = difference_of_products(b.x, a.y, b.y, a.x);
        let determinant = weight_a + weight_b + weight_c;
        let reciprocal = 1.0 / determinant;
        // Without branches: on a GPU each `&&` is one.
        let inside = ((weight_a >= 0.0) & (weight_b >= 0.0) & (weight_c >= 0.0))
            | ((weight_a <= 0.0) & (weight_b <= 0.0) & (weight_c <= 0.0));
        #[cfg(not(target_arch = "spirv"))]
        {
            let largest = (c.x * b.y).abs().max((a.x * c.y).abs()).max((b.x * a.y).abs());
            if inside & (determinant.abs() <= edge_on::EDGE_ON * largest) {
                return edge_on::crossing([a, b, c]);
            }
        }
        let distance = weight_a * a.z + weight_b * b.z + weight_c * c.z;
        Crossing {
            crosses: inside & (determinant.abs() > f32::MIN_POSITIVE),
            t: distance * reciprocal,
            u: weight_b * reciprocal,
            v: weight_c * reciprocal,
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn eight(origin: [__m256; 3], direction: [__m256; 3]) -> Option<Eight> {
        // SAFETY: who has registers of eight lanes has AVX2.
        unsafe { Eight::prepare(origin, direction) }
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn crossings_of(&self, corners: [[*const Vec4; 3]; 4], _count: u32) -> Crossings {
        // SAFETY: the caller's.
        unsafe { four::crossings(self, corners) }
    }
}

impl Watertight {
    /// A corner as the ray sees it: x and y across the ray, z along it in lengths of the direction.
    ///
    /// Computed from the corner alone, so that all triangles that share a corner get the same bits.
    #[inline]
    fn sheared(&self, corner: Vec3) -> Vec3 {
        let p = rotated(corner, self.axis) - self.origin;
        Vec3::new(
            multiply_subtract(self.shear.x, p.z, p.x),
            multiply_subtract(self.shear.y, p.z, p.y),
            p.z * self.shear.z,
        )
    }
}

/// [`rotated`] where the axis has not been chosen before.
#[inline(always)]
fn turned(v: Vec3, axis: u32) -> Vec3 {
    #[cfg(target_arch = "spirv")]
    {
        rotated(v, axis)
    }
    // Choices would become branches.
    #[cfg(not(target_arch = "spirv"))]
    {
        let cycle = [v.x, v.y, v.z, v.x, v.y];
        let axis = axis as usize;
        Vec3::new(cycle[axis + 1], cycle[axis + 2], cycle[axis])
    }
}

/// The components in cyclic order, the one at `axis` last.
#[inline]
fn rotated(v: Vec3, axis: u32) -> Vec3 {
    let (x, y, z) = (v.x, v.y, v.z);
    let (is_x, is_y) = (axis == 0, axis == 1);
    // Choices between numbers at hand are no branches.
    let (yz, zx, xy) = (
        if is_y { z } else { x },
        if is_y { x } else { y },
        if is_y { y } else { z },
    );
    Vec3::new(
        if is_x { y } else { yz },
        if is_x { z } else { zx },
        if is_x { x } else { xy },
    )
}
