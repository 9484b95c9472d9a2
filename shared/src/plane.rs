//! Planes without end, which no octree can hold.

use crate::ray::Ray;
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, vec2};

/// Bit of a hit's triangle id that says that a plane was hit, whose index the other bits are.
pub const PLANE: u32 = 1 << 31;

/// A plane: all points `p` with `normal . p = offset`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Plane {
    /// Unit vector; its side is the front.
    pub normal: Vec3,
    /// Distance from the origin along the normal, scene units.
    pub offset: f32,
    /// Unit vector in the plane: the first axis of its texture coordinates, which count in scene units.
    pub tangent: Vec3,
    /// Index of its material.
    pub material: u32,
}

const _: () = assert!(size_of::<Plane>() == 32);

/// So little that it changes no coordinate but zero, and so much that a ray of any length still knows it, scene units.
const LEAST_CLEARANCE: f32 = 1e-20;

impl Plane {
    /// The plane through a point, with a normal of any length.
    pub fn new(point: Vec3, normal: Vec3, material: u32) -> Self {
        let normal = normal.normalize();
        let tangent = if normal.x.abs() < 0.9 { Vec3::X } else { Vec3::Z };
        Plane {
            normal,
            offset: normal.dot(point),
            tangent: (tangent - normal * normal.dot(tangent)).normalize(),
            material,
        }
    }

    /// Where a ray meets the plane, in lengths of its direction; below zero where it does not, and for a ray along it.
    #[inline]
    pub fn crossing(&self, ray: &Ray) -> f32 {
        let approach = self.normal.dot(ray.direction);
        let height = self.offset - self.normal.dot(ray.origin);
        if approach == 0.0 { -1.0 } else { height / approach }
    }

    /// The point of the plane nearest to a point close by, and by how much a ray's origin must be moved off it.
    pub fn surface_point(&self, near: Vec3) -> (Vec3, f32) {
        let point = near - self.normal * (self.normal.dot(near) - self.offset);
        // Roundings of the projection, of the moved point, and of the new ray's own height above the plane.
        let size = point.abs().dot(self.normal.abs()) + self.offset.abs();
        // Planes through the origin round nothing, but a ray must not start in them either.
        (point, size * (12.0 / (1 << 24) as f32) + LEAST_CLEARANCE)
    }

    /// Texture coordinates of a point of the plane, scene units.
    pub fn coordinates(&self, point: Vec3) -> Vec2 {
        vec2(point.dot(self.tangent), point.dot(self.normal.cross(self.tangent)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn crossings() {
        let floor = Plane::new(vec3(5.0, 1.0, 7.0), Vec3::Y * 2.0, 0);
        let crossing = |origin, direction| floor.crossing(&Ray::new(origin, direction));
        assert_eq!(crossing(vec3(0.0, 4.0, 0.0), vec3(0.0, -2.0, 5.0)), 1.5);
        assert_eq!(crossing(vec3(0.0, -1.0, 0.0), vec3(1.0, 4.0, 5.0)), 0.5);
        assert!(crossing(vec3(0.0, 4.0, 0.0), Vec3::Y) < 0.0);
        assert!(crossing(vec3(0.0, 4.0, 0.0), Vec3::X) < 0.0);
        assert_eq!(floor.coordinates(vec3(2.0, 1.0, 3.0)), vec2(2.0, -3.0));
    }

    #[test]
    fn moved_origins_are_on_their_side() {
        let askew = Plane::new(vec3(0.3, 100.7, -0.2), vec3(0.3, 0.9, -0.2), 0);
        let level = Plane::new(Vec3::ZERO, Vec3::Y, 0);
        for (plane, slope, height) in [(askew, 0.3, 100.0), (level, 0.0, 0.0)] {
            for i in 0..1000_u32 {
                let (x, y) = (i as f32 * 37.0 % 1013.0, i as f32 * 91.0 % 977.0);
                let (point, clearance) = plane.surface_point(vec3(x, height - slope * x, y));
                for length in [1.0, 1e9] {
                    let out = plane.normal + plane.tangent;
                    let out = Ray::new(point + plane.normal * clearance, out * length);
                    assert!(plane.crossing(&out) < 0.0, "{i}");
                }
            }
        }
    }
}
