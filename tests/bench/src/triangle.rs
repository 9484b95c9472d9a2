//! The triangle test for libraries that bring none of their own.

use glam::Vec3A;
use oktant_shared::ray::Ray;

/// T. Moller and B. Trumbore's test (1997) with edges made beforehand: two-sided, closed, without epsilon.
#[derive(Clone, Copy)]
pub struct Triangle {
    corner: Vec3A,
    edges: [Vec3A; 2],
}

/// Origin and direction as that test takes them.
pub struct Line {
    /// Where it starts.
    pub origin: Vec3A,
    /// Where it goes.
    pub direction: Vec3A,
    /// Smallest `t` that counts.
    pub t_min: f32,
}

impl Line {
    /// That of a ray.
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        Line {
            origin: Vec3A::from(ray.origin.to_array()),
            direction: Vec3A::from(ray.direction.to_array()),
            t_min: ray.t_min,
        }
    }
}

impl Triangle {
    /// From its corners.
    pub fn new(corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(Vec3A::from);
        Triangle {
            corner: a,
            edges: [b - a, c - a],
        }
    }

    /// Where the line crosses it, up to `limit`.
    #[inline(always)]
    pub fn crossing(&self, line: &Line, limit: f32) -> Option<f32> {
        let [edge_b, edge_c] = self.edges;
        let across = line.direction.cross(edge_c);
        let determinant = edge_b.dot(across);
        let inverse = 1.0 / determinant;
        let from_corner = line.origin - self.corner;
        let u = from_corner.dot(across) * inverse;
        let turned = from_corner.cross(edge_b);
        let v = line.direction.dot(turned) * inverse;
        let t = edge_c.dot(turned) * inverse;
        let crosses = determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (crosses && t >= line.t_min && t <= limit).then_some(t)
    }
}
