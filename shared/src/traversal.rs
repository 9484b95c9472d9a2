//! Ray against scene: the interface.

use crate::hit::Hit;
use crate::octants::Octants;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::{Indexed, Watertight};

/// A way to find a ray's hits among all triangles of a scene.
pub trait Traversal {
    /// Whether shadow rays through scenes without transparency ask for any hit. Those that do not ask for the closest one,
    /// as others do: the traversal is in the kernel once less.
    const SHADOWS_APART: bool = true;

    /// What [`Scene::parts`] is: as given, or a constant where it is known beforehand, so that no branch is compiled that asks.
    #[inline(always)]
    fn parts(given: u32) -> u32 {
        given
    }

    /// The hit with the smallest `t` within the ray's limits, of equal ones the triangle with the lowest id, as the triangle
    /// test computes it: of triangles in one plane, rounding may put any a little in front. A box or cell may be left out
    /// once a hit lies before it, so that where the test's `t` is off by more than boxes are wider, as of slender
    /// triangles, another triangle may be found, whose `t` is off by no more.
    ///
    /// A miss has the ray's `t_max` and no triangle.
    fn closest_hit(scene: &Scene<'_>, ray: &Ray) -> Hit;

    /// Whether anything lies within the ray's limits.
    fn any_hit(scene: &Scene<'_>, ray: &Ray) -> bool;

    /// [`Traversal::closest_hit`] of each ray; whoever has many gives them at once, for some traversals take less time then.
    ///
    /// # Panics
    /// If there are fewer places for hits than rays.
    #[cfg(not(target_arch = "spirv"))]
    fn closest_hits(scene: &Scene<'_>, rays: &[Ray], hits: &mut [Hit]) {
        closest_hits_in_turn::<Self>(scene, rays, hits);
    }

    /// [`Traversal::any_hit`] of each ray.
    ///
    /// # Panics
    /// If there are fewer places for answers than rays.
    #[cfg(not(target_arch = "spirv"))]
    fn any_hits(scene: &Scene<'_>, rays: &[Ray], are_hit: &mut [bool]) {
        any_hits_in_turn::<Self>(scene, rays, are_hit);
    }
}

/// [`Traversal::closest_hits`], one after the other.
#[cfg(not(target_arch = "spirv"))]
pub(crate) fn closest_hits_in_turn<V: Traversal + ?Sized>(scene: &Scene<'_>, rays: &[Ray], hits: &mut [Hit]) {
    for (ray, hit) in rays.iter().zip(&mut hits[..rays.len()]) {
        *hit = V::closest_hit(scene, ray);
    }
}

/// [`Traversal::any_hits`], one after the other.
#[cfg(not(target_arch = "spirv"))]
pub(crate) fn any_hits_in_turn<V: Traversal + ?Sized>(scene: &Scene<'_>, rays: &[Ray], are_hit: &mut [bool]) {
    for (ray, is_hit) in rays.iter().zip(&mut are_hit[..rays.len()]) {
        *is_hit = V::any_hit(scene, ray);
    }
}

/// The combination that oktant renders with.
pub type Standard = Octants<Watertight>;

/// The same over triangles that share their corners: fewer bytes, slower.
pub type Compact = Octants<Indexed<Watertight>>;
