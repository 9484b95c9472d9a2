//! Arithmetic whose rounding matters, under names.
//!
//! A GPU driver may contract `a * b + c` into one rounding, rustc never does. Whatever must round alike in two
//! triangles that share an edge, or must round only once, is written with the functions below; everything else may
//! round as it likes.

use glam::{Vec2, Vec3};
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// The smaller of two numbers; `b` where they cannot be ordered.
///
/// Written as a comparison because SPIR-V leaves the result of its minimum open when an operand is NaN.
#[inline]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two numbers; `b` where they cannot be ordered.
#[inline]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of two numbers, neither of them NaN: one instruction on either side.
#[inline(always)]
pub fn lesser(a: f32, b: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        extended::<f32, 37>(a, b)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        min(a, b)
    }
}

/// The larger of two numbers, neither of them NaN: one instruction on either side.
#[inline(always)]
pub fn greater(a: f32, b: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        extended::<f32, 40>(a, b)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        max(a, b)
    }
}

/// The smaller of two integers.
#[inline(always)]
pub fn lesser_integer(a: i32, b: i32) -> i32 {
    #[cfg(target_arch = "spirv")]
    {
        extended::<i32, 39>(a, b)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        a.min(b)
    }
}

/// The larger of two integers.
#[inline(always)]
pub fn greater_integer(a: i32, b: i32) -> i32 {
    #[cfg(target_arch = "spirv")]
    {
        extended::<i32, 42>(a, b)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        a.max(b)
    }
}

/// Two numbers in a word, with 8 significant bits each: one whose upper half is the word's lower half, and the word itself,
/// the lower half of which makes it a little larger than its upper half says.
#[inline(always)]
pub fn halves(word: u32) -> Vec2 {
    Vec2::new(f32::from_bits(word << 16), f32::from_bits(word))
}

/// An instruction of two numbers from GLSL's extended set: 37 is `FMin`, 40 `FMax`, 39 `SMin`, 42 `SMax`. The library's
/// functions of the names of the former take care of NaN, at several times the cost.
#[cfg(target_arch = "spirv")]
#[inline(always)]
fn extended<T: Default, const INSTRUCTION: u32>(a: T, b: T) -> T {
    let mut result = T::default();
    // SAFETY: the instruction has no effect but its result.
    unsafe {
        core::arch::asm!(
            "%glsl = OpExtInstImport \"GLSL.std.450\"",
            "%a = OpLoad _ {a}",
            "%b = OpLoad _ {b}",
            "%result = OpExtInst typeof*{result} %glsl {instruction} %a %b",
            "OpStore {result} %result",
            instruction = const INSTRUCTION,
            a = in(reg) &a,
            b = in(reg) &b,
            result = in(reg) &mut result,
        );
    }
    result
}

/// `a * b + c`, rounded once or twice, whichever is quicker.
#[inline(always)]
pub fn multiply_add(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        a.mul_add(b, c)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        a * b + c
    }
}

/// The smallest component.
#[inline]
pub fn min_component(v: Vec3) -> f32 {
    min(v.x, min(v.y, v.z))
}

/// The largest component.
#[inline]
pub fn max_component(v: Vec3) -> f32 {
    max(v.x, max(v.y, v.z))
}

/// Whether a number is neither infinite nor NaN.
///
/// Looks at the bits: a shader compiler may assume that no operand of a comparison is NaN.
#[inline]
pub fn is_finite(x: f32) -> bool {
    x.to_bits() & 0x7f80_0000 != 0x7f80_0000
}

/// Whether all components are neither infinite nor NaN.
#[inline]
pub fn is_finite_vector(v: Vec3) -> bool {
    is_finite(v.x) & is_finite(v.y) & is_finite(v.z)
}

/// `a * b + c`, rounded once.
///
/// On a GPU this is the instruction `Fma`, which Vulkan allows to round twice; natively f64 holds the product exactly,
/// so that the result differs from a true fused one only where the f64 sum lies within 2^-53 of a tie.
#[inline]
pub fn fused_multiply_add(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        a.mul_add(b, c)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        (f64::from(a) * f64::from(b) + f64::from(c)) as f32
    }
}

/// [`fused_multiply_add`] in each component, with the same `a`.
#[inline]
pub fn fused_multiply_add_vector(a: f32, b: Vec3, c: Vec3) -> Vec3 {
    Vec3::new(
        fused_multiply_add(a, b.x, c.x),
        fused_multiply_add(a, b.y, c.y),
        fused_multiply_add(a, b.z, c.z),
    )
}

/// `a * b`, and what its rounding left out; nothing of that on a GPU whose fused multiply-add rounds twice.
#[inline]
pub fn product_with_error(a: f32, b: f32) -> (f32, f32) {
    let product = a * b;
    (product, fused_multiply_add(a, b, -product))
}

/// `a + b`, and what its rounding left out (D. Knuth, "The Art of Computer Programming" 2, 4.2.2).
#[inline]
fn sum_with_error(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// The dot product, and what its roundings left out (T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot product", SIAM
/// J. Sci. Comput. 26(6), 2005): together they are good to about 2^-46 of the largest product.
pub fn dot_with_error(a: Vec3, b: Vec3) -> (f32, f32) {
    let (x, x_error) = product_with_error(a.x, b.x);
    let (y, y_error) = product_with_error(a.y, b.y);
    let (z, z_error) = product_with_error(a.z, b.z);
    let (two, two_error) = sum_with_error(x, y);
    let (dot, dot_error) = sum_with_error(two, z);
    (dot, x_error + y_error + z_error + two_error + dot_error)
}

/// `c - a * b`, rounded the same way wherever it stands: once on a GPU, twice natively.
#[inline]
pub fn multiply_subtract(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        (-a).mul_add(b, c)
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        c - a * b
    }
}

/// `a * b - c * d`, whose sign flips when the products are swapped.
///
/// This is the edge function of the watertight triangle test; two triangles that share an edge see it with opposite
/// sign, so that none of the ray's crossings falls between them. Natively the plain expression has the property. On a
/// GPU a driver may contract it into `fma(a, b, -(c * d))`, which has not, so there it is Kahan's difference of products
/// (C.-P. Jeannerod, N. Louvet, J.-M. Muller, "Further analysis of Kahan's algorithm for the accurate computation of
/// 2x2 determinants", Math. Comp. 82, 2013), whose error of 1.5 units in the last place never changes a sign. Where a
/// driver's `Fma` rounds twice, it is the plain expression again.
#[inline]
pub fn difference_of_products(a: f32, b: f32, c: f32, d: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    {
        let product = c * d;
        let difference = a.mul_add(b, -product);
        let error = (-c).mul_add(d, product);
        difference + error
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        a * b - c * d
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fused_multiply_add_rounds_once() {
        let a = 1.0 + f32::EPSILON;
        assert_eq!(
            fused_multiply_add(a, a, -(1.0 + 2.0 * f32::EPSILON)),
            f32::EPSILON * f32::EPSILON
        );
        assert_eq!(
            a * a - (1.0 + 2.0 * f32::EPSILON),
            0.0,
            "the plain expression rounds twice"
        );
    }

    #[test]
    fn halves_are_the_numbers_they_stand_for() {
        assert_eq!(halves(0x3f80 | 0x437f << 16), Vec2::new(1.0, 255.0 + 0.248_046_88));
        assert_eq!(halves(0), Vec2::ZERO);
    }

    #[test]
    fn dot_products_know_their_error() {
        let mut x = 0.3_f32;
        let mut next = || {
            x = (x * 997.0 + 0.123_456_7) % 1.0;
            x - 0.5
        };
        for _ in 0..10_000 {
            let (a, b) = (Vec3::new(next(), next(), next()), Vec3::new(next(), next(), next()));
            let exact = a.as_dvec3().dot(b.as_dvec3());
            let (dot, error) = dot_with_error(a, b);
            assert!((f64::from(dot) + f64::from(error) - exact).abs() < 1e-14);
        }
    }

    #[test]
    fn difference_of_products_is_antisymmetric() {
        let mut x = 0.1_f32;
        let mut next = || {
            x = (x * 997.0 + 0.123_456_7) % 1.0;
            x - 0.5
        };
        for _ in 0..100_000 {
            let (a, b, c, d) = (next(), next(), next(), next());
            assert_eq!(difference_of_products(a, b, c, d), -difference_of_products(c, d, a, b));
        }
    }

    #[test]
    fn numbers_that_are_not_finite_are_seen() {
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(!is_finite(x));
            assert!(!is_finite_vector(Vec3::new(0.0, x, 0.0)));
        }
        for x in [0.0, -0.0, 1e-45, f32::MAX, f32::MIN] {
            assert!(is_finite(x));
        }
    }
}
