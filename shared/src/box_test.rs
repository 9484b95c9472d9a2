//! Ray against box: the interface, and one file for each test.

mod kay_kajiya;
mod williams;

pub use kay_kajiya::KayKajiya;
pub use williams::Williams;

use crate::aabb::Aabb;
use crate::ray::PreparedRay;
use crate::scene::Scene;

/// The part of a ray inside a box, in the `t` of the prepared ray; empty where `enter > exit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Where the ray enters; negative where it starts inside, below -10^37 where no face bounds it.
    pub enter: f32,
    /// Where the ray leaves, rounded up by [`EXIT_SLACK`]; above 10^37 where no face bounds it.
    pub exit: f32,
}

/// What exits are multiplied with: 1 + 2 units in the last place.
///
/// Without it rounding loses rays through the edges of flat boxes (T. Ize, "Robust BVH ray traversal", JCGT 2(2), 2013).
pub const EXIT_SLACK: f32 = 1.0 + 2.0 * f32::EPSILON;

/// Further than any ray goes, with room to multiply; not infinity, which naga rejects as a literal.
const FAR: f32 = 1.0e38;

/// A ray against axis-aligned boxes.
///
/// Closed: a ray that only touches a face, an edge or a corner, or runs along it, is inside.
pub trait BoxTest: Copy {
    /// Does the work that is done once for each ray.
    fn prepare(ray: &PreparedRay) -> Self;

    /// The same, where the scene has a say in it.
    #[inline(always)]
    fn prepare_in(_: &Scene<'_>, ray: &PreparedRay) -> Self {
        Self::prepare(ray)
    }

    /// Where the ray is inside the box, without regard to the ray's limits of `t`.
    fn interval(&self, aabb: &Aabb) -> Interval;
}

/// The slab of an axis along which the ray does not move: everything or nothing.
#[inline]
fn parallel_slab(origin: f32, low: f32, high: f32) -> Interval {
    if low <= origin && origin <= high {
        Interval { enter: -FAR, exit: FAR }
    } else {
        Interval { enter: FAR, exit: -FAR }
    }
}

#[cfg(test)]
mod tests;
