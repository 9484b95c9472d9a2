//! Where rays that leave a surface may start.

use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use oktant_shared::secondary_origin::{secondary_origin, surface_point};
use oktant_shared::triangle::Triangle;

/// What is known where a ray met a surface.
#[derive(Clone, Copy, Debug)]
pub struct Departure<'a> {
    /// The triangle.
    pub triangle: &'a Triangle,
    /// The ray's hit.
    pub hit: Hit,
    /// The ray.
    pub ray: Ray,
    /// Unit normal of the side on which rays leave.
    pub normal: Vec3,
    /// Where to.
    pub direction: Vec3,
}

/// A way to make the ray that leaves.
pub type Method = fn(&Departure<'_>) -> Ray;

/// As oktant does, but as if all triangles were wide.
pub fn wide(of: &Departure<'_>) -> Ray {
    const ERROR: f32 = 1.0 / (1 << 24) as f32;
    let (a, ab, ac) = (
        of.triangle.a,
        of.triangle.b - of.triangle.a,
        of.triangle.c - of.triangle.a,
    );
    let extent = (ab.abs() + ac.abs() + (ab - ac).abs()).max_element();
    let point = a + (ab * of.hit.u + ac * of.hit.v);
    let error = point.abs() * (3.0 * ERROR) + Vec3::splat(6.0 * ERROR * extent);
    Ray::new(point + of.normal * error.dot(of.normal.abs()), of.direction)
}

/// As oktant does.
pub fn bounded(of: &Departure<'_>) -> Ray {
    Ray::new(secondary_origin(of.triangle, &of.hit, of.normal), of.direction)
}

/// The point on the ray, as it is.
pub fn none(of: &Departure<'_>) -> Ray {
    Ray::new(of.ray.at(of.hit.t), of.direction)
}

/// The point on the ray, and hits count from 10^-4 on.
pub fn least_t(of: &Departure<'_>) -> Ray {
    Ray {
        t_min: 1e-4,
        ..none(of)
    }
}

/// Moved along the normal by 10^-3.
pub fn thousandth(of: &Departure<'_>) -> Ray {
    Ray::new(of.ray.at(of.hit.t) + of.normal * 1e-3, of.direction)
}

/// Moved along the normal by 10^-4.
pub fn ten_thousandth(of: &Departure<'_>) -> Ray {
    Ray::new(of.ray.at(of.hit.t) + of.normal * 1e-4, of.direction)
}

/// The bound of [`bounded`], but from the point on the ray.
pub fn bounded_on_ray(of: &Departure<'_>) -> Ray {
    let (_, clearance) = surface_point(of.triangle, &of.hit, of.normal);
    Ray::new(of.ray.at(of.hit.t) + of.normal * clearance, of.direction)
}

/// C. Wachter, N. Binder, "A fast and robust method for avoiding self-intersection", Ray Tracing Gems, 2019: by 256 units in
/// the last place, near zero by 2^-16; from the point on the ray.
pub fn integers_on_ray(of: &Departure<'_>) -> Ray {
    let point = of.ray.at(of.hit.t);
    let moved = Vec3::from_array([0, 1, 2].map(|axis| {
        let (p, n) = (point[axis], of.normal[axis]);
        let steps = (256.0 * n) as i32;
        if p.abs() < 1.0 / 32.0 {
            p + n / 65_536.0
        } else {
            f32::from_bits((p.to_bits() as i32 + if p < 0.0 { -steps } else { steps }) as u32)
        }
    }));
    Ray::new(moved, of.direction)
}
