//! Ray against triangle: the interface, and one file for each test.

mod moller_trumbore;
mod watertight;

pub use moller_trumbore::MollerTrumbore;
pub use watertight::Watertight;

use crate::ray::PreparedRay;
use crate::triangle::Triangle;

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

/// A line against triangles: two-sided, edges and corners included, no absolute epsilon.
///
/// A triangle without area and a line in the triangle's plane do not cross. The limits of the ray's `t` are the
/// traversal's business.
pub trait TriangleTest: Copy {
    /// Does the work that is done once for each ray.
    fn prepare(ray: &PreparedRay) -> Self;

    /// Whether, and where, the line crosses the triangle.
    fn crossing(&self, triangle: &Triangle) -> Crossing;
}

#[cfg(test)]
mod tests;
