//! Where rays and triangles meet, decided by exact signs.
//!
//! `robust::orient3d` gives the exact sign of the volume of a tetrahedron with f64 corners. The f32 coordinates of
//! triangles and origins are exact in f64; a second point of the ray's line is too where `origin + 2^k * direction` is
//! exact in f64 for some `k`: the factor is exact, and the sum is where the bits of both fit in 53 together. An
//! [`ExactRay`] looks for such a `k`. It finds one for all rays except where a component of the direction is smaller
//! than that of the origin by more than 2^29 relative to what is usual, as in 1e-20.

use glam::{DVec3, Vec3};
use oktant::mesh::Mesh;
use oktant_shared::ray::Ray;
use robust::{Coord3D, orient3d};

/// A ray without limits (`t >= 0`) whose line passes two points that are exact in f64.
#[derive(Clone, Copy, Debug)]
pub struct ExactRay {
    origin: DVec3,
    ahead: DVec3,
}

/// How a ray and a triangle lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// Apart, or the ray lies in the plane of the triangle, or the triangle is degenerate.
    None,
    /// The ray passes through the triangle's interior, at `t > 0`.
    Inside,
    /// The ray touches the triangle: on an edge, on a corner, or with its origin.
    Touch,
}

impl ExactRay {
    /// `None` where no power of two makes the second point exact, or if the ray is not finite or has no direction.
    pub fn new(ray: &Ray) -> Option<Self> {
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        if !origin.is_finite() || !direction.is_finite() || direction == DVec3::ZERO {
            return None;
        }
        // From a second point as far away as the origin is from zero, to both sides.
        let balanced = (origin.abs().max_element() / direction.abs().max_element()).log2();
        let balanced = if balanced.is_finite() {
            balanced.round() as i32
        } else {
            0
        };
        let alternating = (0..40).flat_map(|step| [balanced + step, balanced - step]);
        alternating
            .map(|exponent| direction * 2.0_f64.powi(exponent))
            .map(|step| (step, origin + step))
            .find(|&(step, ahead)| ahead - origin == step && ahead - step == origin)
            .map(|(_, ahead)| ExactRay { origin, ahead })
    }

    /// How the ray and the triangle lie to each other, exactly.
    pub fn contact(&self, [a, b, c]: [Vec3; 3]) -> Contact {
        let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
        let beside = |from, to| volume(self.origin, self.ahead, from, to);
        let first = beside(a, b);
        let second = beside(b, c);
        if first * second < 0.0 {
            return Contact::None;
        }
        let sides = [first, second, beside(c, a)];
        let positive = sides.iter().all(|&side| side >= 0.0);
        let negative = sides.iter().all(|&side| side <= 0.0);
        // All zero: the line lies in the plane, or there is no plane.
        if positive == negative {
            return Contact::None;
        }
        // Negative sides: the ray comes from where the corners are seen clockwise, and `volume` is positive there.
        let before = volume(a, b, c, self.origin) * if negative { 1.0 } else { -1.0 };
        if before < 0.0 {
            Contact::None
        } else if before > 0.0 && !sides.contains(&0.0) {
            Contact::Inside
        } else {
            Contact::Touch
        }
    }
}

/// The triangles of a mesh, to be held against many exact rays.
pub struct ExactMesh {
    triangles: Vec<[Vec3; 3]>,
    spheres: Vec<(DVec3, f64)>,
}

impl ExactMesh {
    /// Takes over the triangles.
    pub fn new(mesh: &Mesh) -> Self {
        let corners = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.positions[vertex as usize]);
        let triangles: Vec<[Vec3; 3]> = mesh.triangles.iter().map(corners).collect();
        let sphere = |corners: &[Vec3; 3]| {
            let corners = corners.map(Vec3::as_dvec3);
            let centre = corners.into_iter().sum::<DVec3>() / 3.0;
            (
                centre,
                corners
                    .map(|corner| corner.distance(centre))
                    .into_iter()
                    .fold(0.0, f64::max),
            )
        };
        ExactMesh {
            spheres: triangles.iter().map(sphere).collect(),
            triangles,
        }
    }

    /// The ids of all triangles that the ray has contact with, ascending.
    ///
    /// Only triangles whose bounding sphere the line passes far away from are left out unseen: by a thousandth of its
    /// radius and a millionth of the distance, a million times what rounding can do in f64.
    pub fn contacts(&self, ray: &ExactRay) -> Vec<(u32, Contact)> {
        let direction = (ray.ahead - ray.origin).normalize();
        let close = |&(centre, radius): &(DVec3, f64)| {
            let from_origin = centre - ray.origin;
            let along = direction.dot(from_origin);
            let limit = 1.001 * radius + 1e-6 * (along.abs() + radius);
            (from_origin - along * direction).length_squared() <= limit * limit
        };
        (0..)
            .zip(&self.triangles)
            .zip(&self.spheres)
            .filter(|(_, sphere)| close(sphere))
            .map(|((id, &triangle), _)| (id, ray.contact(triangle)))
            .filter(|&(_, contact)| contact != Contact::None)
            .collect()
    }
}

/// Positive where `d` sees `a`, `b`, `c` clockwise, negative where counter-clockwise, zero in the plane. Only its sign
/// is exact, and reduced to that it can be multiplied without underflow.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    let coordinates = |DVec3 { x, y, z }: DVec3| Coord3D { x, y, z };
    let volume = orient3d(coordinates(a), coordinates(b), coordinates(c), coordinates(d));
    if volume == 0.0 { 0.0 } else { volume.signum() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn contact(origin: [f32; 3], direction: [f32; 3]) -> Contact {
        let ray = Ray::new(Vec3::from_array(origin), Vec3::from_array(direction));
        let exact = ExactRay::new(&ray).unwrap();
        let [a, b, c] = TRIANGLE;
        // Corner order and winding do not matter.
        let contact = exact.contact(TRIANGLE);
        for order in [[b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            assert_eq!(exact.contact(order), contact);
        }
        contact
    }

    #[test]
    fn contacts_are_told_apart() {
        let third = 1.0 / 3.0;
        for (side, ahead) in [(-1.0, 1.0), (1.0, -1.0), (1e5, -1e-3), (-1e-5, 1e20)] {
            assert_eq!(contact([0.25, 0.25, side], [0.0, 0.0, ahead]), Contact::Inside);
            assert_eq!(contact([0.25, 0.25, side], [0.0, 0.0, -ahead]), Contact::None);
            assert_eq!(contact([0.5, 0.5, side], [0.0, 0.0, ahead]), Contact::Touch);
            assert_eq!(contact([0.5, 0.500_000_06, side], [0.0, 0.0, ahead]), Contact::None);
            assert_eq!(contact([0.5, 0.499_999_97, side], [0.0, 0.0, ahead]), Contact::Inside);
            assert_eq!(contact([1.0, 0.0, side], [0.0, 0.0, ahead]), Contact::Touch);
            assert_eq!(contact([-1e-30, 0.5, side], [0.0, 0.0, ahead]), Contact::None);
            assert_eq!(contact([third, third, side], [0.0, 0.0, ahead]), Contact::Inside);
        }
        assert_eq!(contact([0.25, 0.25, 0.0], [1.0, 0.5, 1.0]), Contact::Touch);
        assert_eq!(contact([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]), Contact::None);
        assert_eq!(contact([-1.0, 0.25, 1.0], [1.0, 0.0, 0.0]), Contact::None);
        assert_eq!(contact([0.25, 0.25, 1.0], [1.0, 0.0, 0.0]), Contact::None);
    }

    #[test]
    fn degenerate_triangles_are_not_touched() {
        let ray = ExactRay::new(&Ray::new(Vec3::new(0.5, 0.0, -1.0), Vec3::Z)).unwrap();
        assert_eq!(ray.contact([Vec3::ZERO, Vec3::X, Vec3::X * 0.75]), Contact::None);
        assert_eq!(ray.contact([Vec3::X; 3]), Contact::None);
    }

    #[test]
    fn rays_without_an_exact_second_point_are_refused() {
        let origin = Vec3::new(0.3, 0.2, 0.1);
        assert!(ExactRay::new(&Ray::new(origin, Vec3::new(1.0, 1e-20, 0.0))).is_none());
        assert!(ExactRay::new(&Ray::new(origin, Vec3::ZERO)).is_none());
        assert!(ExactRay::new(&Ray::new(origin, Vec3::NAN)).is_none());
        assert!(ExactRay::new(&Ray::new(origin, Vec3::new(1e-12, 2e-12, -3e-12))).is_some());
        assert!(ExactRay::new(&Ray::new(origin * 1e5, Vec3::new(0.3, -0.7, 0.123))).is_some());
    }
}
