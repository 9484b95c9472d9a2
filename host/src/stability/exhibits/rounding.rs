//! How sums of products are rounded.

use glam::Vec3;

/// A way to round sums of products.
pub trait Rounding: Copy + Send + Sync {
    /// `a * b - c * d`.
    fn difference(a: f32, b: f32, c: f32, d: f32) -> f32;

    /// `c - a * b`.
    fn subtract(a: f32, b: f32, c: f32) -> f32;

    /// The dot product.
    fn dot(a: Vec3, b: Vec3) -> f32;

    /// The cross product.
    fn cross(a: Vec3, b: Vec3) -> Vec3 {
        Vec3::new(
            Self::difference(a.y, b.z, b.y, a.z),
            Self::difference(a.z, b.x, b.z, a.x),
            Self::difference(a.x, b.y, b.x, a.y),
        )
    }
}

/// Every operation once, as rustc compiles it for the CPU.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

/// A product and the sum that it goes into at once, wherever there is one: what Vulkan allows a driver to do.
#[derive(Clone, Copy, Debug)]
pub struct Contracted;

/// As [`Contracted`], but for differences, which are Kahan's: what the kernel asks of a GPU (see
/// [`oktant_shared::arithmetic::difference_of_products`]).
#[derive(Clone, Copy, Debug)]
pub struct Kernel;

impl Rounding for Plain {
    fn difference(a: f32, b: f32, c: f32, d: f32) -> f32 {
        a * b - c * d
    }

    fn subtract(a: f32, b: f32, c: f32) -> f32 {
        c - a * b
    }

    fn dot(a: Vec3, b: Vec3) -> f32 {
        a.x * b.x + a.y * b.y + a.z * b.z
    }
}

impl Rounding for Contracted {
    fn difference(a: f32, b: f32, c: f32, d: f32) -> f32 {
        a.mul_add(b, -(c * d))
    }

    fn subtract(a: f32, b: f32, c: f32) -> f32 {
        (-a).mul_add(b, c)
    }

    fn dot(a: Vec3, b: Vec3) -> f32 {
        a.z.mul_add(b.z, a.y.mul_add(b.y, a.x * b.x))
    }
}

impl Rounding for Kernel {
    fn difference(a: f32, b: f32, c: f32, d: f32) -> f32 {
        let product = c * d;
        a.mul_add(b, -product) + (-c).mul_add(d, product)
    }

    fn subtract(a: f32, b: f32, c: f32) -> f32 {
        Contracted::subtract(a, b, c)
    }

    fn dot(a: Vec3, b: Vec3) -> f32 {
        Contracted::dot(a, b)
    }
}
