//! Colours between their encodings.

use glam::Vec3;
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// Linear RGB of a colour whose red, green and blue are the lowest three bytes, sRGB-encoded.
pub fn linear_color(srgb: u32) -> Vec3 {
    Vec3::new(
        linear_from_srgb((srgb & 0xff) as f32 / 255.0),
        linear_from_srgb((srgb >> 8 & 0xff) as f32 / 255.0),
        linear_from_srgb((srgb >> 16 & 0xff) as f32 / 255.0),
    )
}

/// The inverse of the sRGB transfer function (IEC 61966-2-1), 0 to 1.
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// The sRGB transfer function (IEC 61966-2-1), 0 to 1.
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_and_back() {
        for i in 0..=255_u32 {
            let linear = linear_color(i | i << 8 | i << 16);
            assert_eq!(linear.x, linear.y);
            assert_eq!(linear.x, linear.z);
            let back = srgb_from_linear(linear.x) * 255.0;
            assert!((back - i as f32).abs() < 1e-3, "{i} became {back}");
        }
    }
}
