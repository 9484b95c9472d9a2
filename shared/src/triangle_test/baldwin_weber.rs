//! The test by a change of coordinates.

use super::{Crossing, TriangleTest};
use crate::arithmetic::{difference_of_products, dot_with_error, is_finite};
use crate::ray::PreparedRay;
use crate::triangle::Triangle;
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};

/// D. Baldwin and M. Weber, "Fast ray-triangle intersections by coordinate transformation", JCGT 5(3), 2016: the ray is
/// taken into coordinates in which the corners are (0, 0, 0), (1, 0, 0) and (0, 1, 0), where the plane is z = 0.
///
/// Deviations: the fixed column of the transform is stored, so that no test branches on it; the transform's offsets are
/// rounded once. Not watertight: neighbours round differently. The error grows with the mesh's distance from the origin
/// of its coordinates, for corners are not taken relative to the ray's origin.
#[derive(Clone, Copy, Debug)]
pub struct BaldwinWeber {
    origin: Vec3,
    direction: Vec3,
}

/// What is made beforehand of a triangle: the affine transform into its own coordinates, in rows.
///
/// A point `p` has the barycentric weights `u` and `v` at `row.xyz . p + row.w` of the first two rows; that of the third
/// is how far `p` lies off the plane along the main axis of the normal, scene units, signed. All zero where the triangle
/// has no area that f32 resolves.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TriangleTransform {
    /// Weight of the second corner; `xyz` per scene unit.
    pub u: Vec4,
    /// Weight of the third corner; `xyz` per scene unit.
    pub v: Vec4,
    /// Distance from the plane along the main axis; `xyz` a number, the largest of them 1, `w` scene units.
    pub plane: Vec4,
}

const _: () = assert!(size_of::<TriangleTransform>() == 48);

impl TriangleTransform {
    /// The transform of a triangle.
    ///
    /// Of the paper's choices for the third column, the unit vector of the normal's main axis: it rounds less often than
    /// the normal, whose square would also underflow in triangles of 10^-10 units.
    pub fn of(triangle: &Triangle) -> Self {
        let a = triangle.a;
        let ab = triangle.b - a;
        let ac = triangle.c - a;
        let normal = Vec3::new(
            difference_of_products(ab.y, ac.z, ab.z, ac.y),
            difference_of_products(ab.z, ac.x, ab.x, ac.z),
            difference_of_products(ab.x, ac.y, ab.y, ac.x),
        );
        let size = normal.abs();
        let (main, u, v) = if size.x >= size.y && size.x >= size.z {
            (normal.x, Vec3::new(0.0, ac.z, -ac.y), Vec3::new(0.0, -ab.z, ab.y))
        } else if size.y >= size.z {
            (normal.y, Vec3::new(-ac.z, 0.0, ac.x), Vec3::new(ab.z, 0.0, -ab.x))
        } else {
            (normal.z, Vec3::new(ac.y, -ac.x, 0.0), Vec3::new(-ab.y, ab.x, 0.0))
        };
        let transform = TriangleTransform {
            u: row(u / main, a),
            v: row(v / main, a),
            plane: row(normal / main, a),
        };
        let resolved = main.abs() > f32::MIN_POSITIVE
            && is_finite(transform.u.element_sum())
            && is_finite(transform.v.element_sum())
            && is_finite(transform.plane.element_sum());
        if resolved {
            transform
        } else {
            TriangleTransform {
                u: Vec4::ZERO,
                v: Vec4::ZERO,
                plane: Vec4::ZERO,
            }
        }
    }
}

/// The row that is 0 at `zero`.
#[inline]
fn row(gradient: Vec3, zero: Vec3) -> Vec4 {
    let (dot, error) = dot_with_error(gradient, zero);
    gradient.extend(-(dot + error))
}

impl TriangleTest for BaldwinWeber {
    #[inline]
    fn prepare(ray: &PreparedRay) -> Self {
        BaldwinWeber {
            origin: ray.origin,
            direction: ray.direction,
        }
    }

    /// The transform is made on the way; [`BaldwinWeber::crossing_transformed`] takes one that is already there.
    #[inline]
    fn crossing(&self, triangle: &Triangle) -> Crossing {
        self.crossing_transformed(&TriangleTransform::of(triangle))
    }
}

impl BaldwinWeber {
    /// Whether, and where, the line crosses the triangle of the transform.
    #[inline]
    pub fn crossing_transformed(&self, transform: &TriangleTransform) -> Crossing {
        let towards = transform.plane.truncate().dot(self.direction);
        let t = -self.origin_in(transform.plane) / towards;
        let u = self.origin_in(transform.u) + t * transform.u.truncate().dot(self.direction);
        let v = self.origin_in(transform.v) + t * transform.v.truncate().dot(self.direction);
        Crossing {
            crosses: towards.abs() > f32::MIN_POSITIVE && u >= 0.0 && v >= 0.0 && u + v <= 1.0,
            t,
            u,
            v,
        }
    }

    /// The ray's origin in one of the triangle's coordinates.
    #[inline]
    fn origin_in(&self, row: Vec4) -> f32 {
        row.truncate().dot(self.origin) + row.w
    }
}
