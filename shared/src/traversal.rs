//! Ray against scene: the interface.

use crate::hit::Hit;
use crate::octants::Octants;
use crate::ray::Ray;
use crate::scene::Scene;
use crate::triangle_test::Watertight;

/// A way to find a ray's hits among all triangles of a scene.
pub trait Traversal {
    /// Whether shadow rays through scenes without transparency ask for any hit. Those that do not ask for the closest one,
    /// as others do: the traversal is in the kernel once less.
    const SHADOWS_APART: bool = true;

    /// The hit with the smallest `t` within the ray's limits, of equal ones the triangle with the lowest id.
    ///
    /// A miss has the ray's `t_max` and no triangle.
    fn closest_hit(scene: &Scene<'_>, ray: &Ray) -> Hit;

    /// Whether anything lies within the ray's limits.
    fn any_hit(scene: &Scene<'_>, ray: &Ray) -> bool;
}

/// The combination that oktant renders with.
pub type Standard = Octants<Watertight>;
