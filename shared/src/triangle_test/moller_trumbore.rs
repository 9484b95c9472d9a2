//! The test of 1997, without an epsilon.

use super::{Crossing, TriangleTest};
use crate::ray::PreparedRay;
use crate::triangle::Triangle;
use glam::Vec3;

/// T. Moller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997.
///
/// Deviations: the determinant is compared with zero, not with an epsilon, which at the scale of the raw Stanford bunny
/// would lose every hit; all comparisons are false for NaN. Not watertight: about one in eight rays aimed exactly at a
/// shared edge falls between the two triangles.
#[derive(Clone, Copy, Debug)]
pub struct MollerTrumbore {
    origin: Vec3,
    direction: Vec3,
}

impl TriangleTest for MollerTrumbore {
    #[inline]
    fn prepare(ray: &PreparedRay) -> Self {
        MollerTrumbore {
            origin: ray.origin,
            direction: ray.direction,
        }
    }

    #[inline]
    fn crossing(&self, triangle: &Triangle) -> Crossing {
        let edge_ab = triangle.b - triangle.a;
        let edge_ac = triangle.c - triangle.a;
        let p = self.direction.cross(edge_ac);
        let determinant = p.dot(edge_ab);
        let reciprocal = 1.0 / determinant;
        let to_origin = self.origin - triangle.a;
        let u = p.dot(to_origin) * reciprocal;
        let q = to_origin.cross(edge_ab);
        let v = q.dot(self.direction) * reciprocal;
        let t = q.dot(edge_ac) * reciprocal;
        // Zero also where the reciprocal would overflow: then the triangle is far below what f32 resolves at this scale.
        let solvable = determinant.abs() > f32::MIN_POSITIVE;
        Crossing {
            crosses: solvable & (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0),
            t,
            u,
            v,
        }
    }
}
