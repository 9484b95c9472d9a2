//! Ray against triangle: the interface, and one file for each test.

mod baldwin_weber;
mod indexed;
mod moller_trumbore;
mod plucker;
mod watertight;

pub use baldwin_weber::{BaldwinWeber, TriangleTransform};
pub use indexed::Indexed;
pub use moller_trumbore::MollerTrumbore;
pub use plucker::Plucker;
pub use watertight::Watertight;
#[cfg(target_arch = "x86_64")]
pub use watertight::{Eight, EightCrossings};

use crate::ray::PreparedRay;
use crate::scene::Scene;
use crate::triangle::Triangle;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::__m256;
#[cfg(target_arch = "x86_64")]
use glam::Vec4;

/// What a triangle test finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Whether the ray's line crosses the triangle; the other fields mean nothing otherwise.
    pub crosses: bool,
    /// Where, in the `t` of the prepared ray; negative behind its origin.
    pub t: f32,
    /// Barycentric weight of the second corner, 0 to 1 but for rounding.
    pub u: f32,
    /// Barycentric weight of the third corner, 0 to 1 but for rounding.
    pub v: f32,
}

impl Crossing {
    /// The ray passes the triangle.
    pub const NONE: Crossing = Crossing {
        crosses: false,
        t: 0.0,
        u: 0.0,
        v: 0.0,
    };
}

/// What a test of up to four triangles finds, lane by lane.
#[derive(Clone, Copy, Debug, Default)]
pub struct Crossings {
    /// Bit for each triangle that the line crosses.
    pub crosses: u32,
    /// See [`Crossing::t`].
    pub t: [f32; 4],
    /// See [`Crossing::u`].
    pub u: [f32; 4],
    /// See [`Crossing::v`].
    pub v: [f32; 4],
}

/// A line against triangles: two-sided, edges and corners included, no absolute epsilon.
///
/// A triangle without area and a line in the triangle's plane do not cross. The limits of the ray's `t` are the
/// traversal's business.
pub trait TriangleTest: Copy {
    /// Whether it takes triangles of a scene for three indices each.
    const IS_INDEXED: bool = false;

    /// Does the work that is done once for each ray.
    fn prepare(ray: &PreparedRay) -> Self;

    /// The same, where the scene has a say in it.
    #[inline(always)]
    fn prepare_in(_: &Scene<'_>, ray: &PreparedRay) -> Self {
        Self::prepare(ray)
    }

    /// Whether, and where, the line crosses the triangle.
    fn crossing(&self, triangle: &Triangle) -> Crossing;

    /// The same of the triangle at a slot of a scene.
    #[inline(always)]
    fn crossing_at(&self, scene: &Scene<'_>, slot: u32) -> Crossing {
        self.crossing(&Triangle::at(scene.triangles, slot))
    }

    /// The same for eight rays, of which origins and directions are given by axis, where the test is [`Watertight`]'s and
    /// the rays are alike enough; else none.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn eight(_origin: [__m256; 3], _direction: [__m256; 3]) -> Option<Eight> {
        None
    }

    /// Where the rows of a triangle's corners lie.
    ///
    /// # Safety
    /// The slot is in range.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn corners_at(scene: &Scene<'_>, slot: u32) -> [*const Vec4; 3] {
        // SAFETY: the caller's.
        unsafe { rows(scene, slot) }
    }

    /// The same of the triangles at the first `count` of four slots, bit for bit; nothing is said of the other lanes.
    ///
    /// # Safety
    /// The processor has AVX2, and all four slots are in range.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn crossings_at(&self, scene: &Scene<'_>, slots: [u32; 4], count: u32) -> Crossings {
        // SAFETY: the caller's.
        unsafe {
            let [a, b, c, d] = slots;
            let corners = [rows(scene, a), rows(scene, b), rows(scene, c), rows(scene, d)];
            self.crossings_of(corners, count)
        }
    }

    /// How many slots a scene has.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn slots(scene: &Scene<'_>) -> usize {
        scene.triangles.len() / 3
    }

    /// The same of the first `count` of four triangles, of each of which is said where the rows of its corners lie.
    ///
    /// # Safety
    /// The processor has AVX2, and there are rows at all twelve places.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn crossings_of(&self, corners: [[*const Vec4; 3]; 4], count: u32) -> Crossings {
        let mut crossings = Crossings::default();
        for (lane, [a, b, c]) in corners.into_iter().enumerate().take(count as usize) {
            // SAFETY: the caller's.
            let triangle = unsafe { Triangle::of_rows(*a, *b, *c) };
            let crossing = self.crossing(&triangle);
            crossings.crosses |= u32::from(crossing.crosses) << lane;
            crossings.t[lane] = crossing.t;
            crossings.u[lane] = crossing.u;
            crossings.v[lane] = crossing.v;
        }
        crossings
    }
}

/// Where the rows of a slot's triangle lie.
///
/// # Safety
/// The slot is in range.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
unsafe fn rows(scene: &Scene<'_>, slot: u32) -> [*const Vec4; 3] {
    // SAFETY: the caller's; each slot has three rows.
    unsafe {
        let first = scene.triangles.as_ptr().add(3 * slot as usize);
        [first, first.add(1), first.add(2)]
    }
}

#[cfg(test)]
mod tests;
