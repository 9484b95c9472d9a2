//! Normals at a hit.

use crate::arithmetic::max_component;
use crate::hit::Hit;
use crate::triangle::{Triangle, Vertex};
use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// The unit normal of a triangle's plane, on the side from which its corners run counter-clockwise; zero for a triangle
/// without area.
pub fn face_normal(triangle: &Triangle) -> Vec3 {
    let edge_ab = triangle.b - triangle.a;
    let edge_ac = triangle.c - triangle.a;
    // Scaled first: the product of the edges of a small triangle of a small mesh would underflow.
    let size = max_component(edge_ab.abs()) + max_component(edge_ac.abs());
    if size > f32::MIN_POSITIVE {
        let normal = (edge_ab / size).cross(edge_ac / size);
        // And again: that of a needle is short.
        let length = max_component(normal.abs());
        if length > f32::MIN_POSITIVE {
            return unit_or_zero(normal / length);
        }
    }
    Vec3::ZERO
}

/// The normal interpolated between a triangle's corners ("Phong shading": B. T. Phong, "Illumination for computer
/// generated pictures", CACM 18(6), 1975), of unit length; `otherwise` where the mesh has none there or the three cancel.
pub fn interpolated_normal(corners: &[Vertex; 3], hit: &Hit, otherwise: Vec3) -> Vec3 {
    let normal =
        unit_or_zero(corners[0].normal * (1.0 - hit.u - hit.v) + corners[1].normal * hit.u + corners[2].normal * hit.v);
    if normal == Vec3::ZERO { otherwise } else { normal }
}

/// A vector of the same direction and length 1; zero where the squared length is below 1e-20.
pub fn unit_or_zero(v: Vec3) -> Vec3 {
    let squared = v.dot(v);
    if squared > 1e-20 {
        v / squared.sqrt()
    } else {
        Vec3::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    #[test]
    fn face_normals_at_every_scale() {
        for size in [1e-18, 1e-6, 1.0, 1e6, 1e18] {
            let triangle = Triangle {
                b: Vec3::X * size,
                c: Vec3::Y * size,
                ..Triangle::zeroed()
            };
            assert_eq!(face_normal(&triangle), Vec3::Z, "size {size}");
        }
        assert_eq!(face_normal(&Triangle::zeroed()), Vec3::ZERO);
        let needle = Triangle {
            b: Vec3::X,
            c: Vec3::new(0.5, 1e-15, 0.0),
            ..Triangle::zeroed()
        };
        assert_eq!(face_normal(&needle), Vec3::Z);
    }
}
