//! Colours and heights over a surface: images and patterns.

use crate::arithmetic::max;
use crate::buffer::load;
use crate::color::linear_color;
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, vec2};
#[cfg(target_arch = "spirv")]
use num_traits::Float;

/// Stands for "none" where the index of a texture is expected.
pub const NO_TEXTURE: u32 = u32::MAX;

/// [`Texture::kind`]: an image of 8 bits a channel, sRGB-encoded, red lowest.
pub const SRGB_IMAGE: u32 = 0;
/// [`Texture::kind`]: an image with a common exponent a pixel (E5B9G9R9), linear, for colours above 1.
pub const SHARED_EXPONENT_IMAGE: u32 = 1;
/// [`Texture::kind`]: squares in two colours, `width` and `height` (as of [`SRGB_IMAGE`]), `repeats` of either a unit.
pub const CHECKERBOARD: u32 = 2;
/// [`Texture::kind`]: sine waves along both axes, `repeats` a unit, 0 to 1.
pub const WAVES: u32 = 3;
/// [`Texture::kind`]: an image of one f32 a texel, linear: heights.
pub const HEIGHT_IMAGE: u32 = 4;

/// A texture over the unit square, repeated beyond it; `(0, 0)` is the lower left corner of an image.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Texture {
    /// Image: index of its first texel, the upper left.
    pub first: u32,
    /// Image: texels in a row. Checkerboard: the first colour.
    pub width: u32,
    /// Image: rows. Checkerboard: the second colour.
    pub height: u32,
    /// [`SRGB_IMAGE`], [`SHARED_EXPONENT_IMAGE`], [`CHECKERBOARD`], [`WAVES`] or [`HEIGHT_IMAGE`].
    pub kind: u32,
    /// How often an image or pattern is repeated a unit.
    pub repeats: f32,
    /// Fills the rows.
    pub reserved: [u32; 3],
}

const _: () = assert!(size_of::<Texture>() == 32);

impl Texture {
    /// Whether it has texels.
    pub fn is_image(&self) -> bool {
        self.kind == SRGB_IMAGE || self.kind == SHARED_EXPONENT_IMAGE || self.kind == HEIGHT_IMAGE
    }

    /// The colour at texture coordinates, linear RGB; between the middles of an image's texels it is interpolated. Heights
    /// are grey.
    pub fn color(&self, texels: &[u32], at: Vec2) -> Vec3 {
        let at = at * self.repeats;
        if self.kind == CHECKERBOARD {
            let square = at.x.floor() + at.y.floor();
            // Even or odd, for negative ones too.
            let odd = square - 2.0 * (square * 0.5).floor() > 0.5;
            return linear_color(if odd { self.height } else { self.width });
        }
        if self.kind == WAVES {
            // Half a period off, with the sign turned: Vulkan says how exact a sine is from -pi to pi only.
            let wave = |x: f32| 0.5 - 0.25 * ((fraction(x) - 0.5) * core::f32::consts::TAU).sin();
            return Vec3::splat(wave(at.x) + wave(at.y) - 0.5);
        }
        self.image_color(texels, at)
    }

    fn image_color(&self, texels: &[u32], at: Vec2) -> Vec3 {
        let x = fraction(at.x) * self.width as f32 - 0.5;
        let y = (1.0 - fraction(at.y)) * self.height as f32 - 0.5;
        let (left, above) = (x.floor(), y.floor());
        let (column, next_column) = (wrap(left, self.width), wrap(left + 1.0, self.width));
        let (row, next_row) = (wrap(above, self.height), wrap(above + 1.0, self.height));
        let weight = vec2(x - left, y - above);
        let mut color = Vec3::ZERO;
        let mut corner = 0;
        while corner < 4 {
            let (right, below) = (corner % 2 == 1, corner >= 2);
            let texel = self.texel(
                texels,
                if right { next_column } else { column },
                if below { next_row } else { row },
            );
            let share =
                (if right { weight.x } else { 1.0 - weight.x }) * (if below { weight.y } else { 1.0 - weight.y });
            color += texel * share;
            corner += 1;
        }
        color
    }

    fn texel(&self, texels: &[u32], column: u32, row: u32) -> Vec3 {
        let texel = load(texels, self.first + row * self.width + column);
        if self.kind == SRGB_IMAGE {
            linear_color(texel)
        } else if self.kind == HEIGHT_IMAGE {
            Vec3::splat(f32::from_bits(texel))
        } else {
            // 2^(e - 15 - 9), e in 0 to 31: the bits of a normal number.
            let scale = f32::from_bits(((texel >> 27) + 127 - 24) << 23);
            let channel = |shift: u32| (texel >> shift & 0x1ff) as f32 * scale;
            Vec3::new(channel(0), channel(9), channel(18))
        }
    }

    /// The height at texture coordinates: what a [`HEIGHT_IMAGE`] says, else how bright it is in linear light.
    pub fn height(&self, texels: &[u32], at: Vec2) -> f32 {
        let color = self.color(texels, at);
        (color.x + color.y + color.z) / 3.0
    }

    /// How the height changes along both axes of the texture, per unit.
    pub fn slope(&self, texels: &[u32], at: Vec2) -> Vec2 {
        // A texel apart, or a hundredth of a pattern's period.
        let step = |count: u32| {
            if self.is_image() { 1.0 / count as f32 } else { 0.01 }
        };
        let step = vec2(step(self.width), step(self.height)) / max(self.repeats, f32::MIN_POSITIVE);
        let mut heights = [0.0; 4];
        let mut i = 0;
        // One call for all: each would be a copy in the kernel.
        while i < 4 {
            let sign = if i % 2 == 0 { -0.5 } else { 0.5 };
            let aside = if i < 2 { vec2(step.x, 0.0) } else { vec2(0.0, step.y) };
            heights[i] = self.height(texels, at + aside * sign);
            i += 1;
        }
        vec2(heights[1] - heights[0], heights[3] - heights[2]) / step
    }
}

/// A linear colour, 0 to 65,408, in a texel of [`SHARED_EXPONENT_IMAGE`]; the largest channel keeps 9 bits.
pub fn shared_exponent(color: Vec3) -> u32 {
    let largest = max(color.x, max(color.y, color.z));
    // The exponent that makes the largest channel 256 to 511, within 0 to 31.
    let mut exponent = (largest.to_bits() >> 23) as i32 - 127 + 16;
    exponent = if exponent < 0 { 0 } else { exponent };
    exponent = if exponent > 31 { 31 } else { exponent };
    let pack = |exponent: i32, channel: f32| {
        let scaled = channel * f32::from_bits(((127 + 24 - exponent) as u32) << 23) + 0.5;
        if scaled < 0.0 { 0 } else { scaled as u32 }
    };
    if pack(exponent, largest) > 511 && exponent < 31 {
        exponent += 1;
    }
    let channel = |value: f32| {
        let packed = pack(exponent, value);
        if packed > 511 { 511 } else { packed }
    };
    channel(color.x) | channel(color.y) << 9 | channel(color.z) << 18 | (exponent as u32) << 27
}

fn fraction(x: f32) -> f32 {
    x - x.floor()
}

/// The index of a column or row, -1 or `count` at the ends; 0 for what is no number, as the fraction of infinity is.
fn wrap(index: f32, count: u32) -> u32 {
    if index < 0.0 {
        count - 1
    } else if index < count as f32 {
        index as u32
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32) -> Texture {
        Texture {
            width,
            height,
            repeats: 1.0,
            ..Texture::zeroed()
        }
    }

    #[test]
    fn an_image_is_upright_and_interpolated() {
        // Upper row black and white, lower row red and blue.
        let texels = [0x00_00_00, 0xff_ff_ff, 0x00_00_ff, 0xff_00_00];
        let color = |x, y| image(2, 2).color(&texels, vec2(x, y));
        assert_eq!(color(0.25, 0.75), Vec3::ZERO);
        assert_eq!(color(0.75, 0.75), Vec3::ONE);
        assert_eq!(color(0.25, 0.25), Vec3::X);
        assert_eq!(color(0.75, 0.25), Vec3::Z);
        assert!(color(0.5, 0.75).abs_diff_eq(Vec3::splat(0.5), 1e-6));
        assert!(color(0.25, 0.5).abs_diff_eq(Vec3::X * 0.5, 1e-6));
        // Repeated, on both sides.
        assert_eq!(color(-0.75, 1.25), color(0.25, 0.25));
        assert!(color(0.0, 0.75).abs_diff_eq(Vec3::splat(0.5), 1e-6));
    }

    #[test]
    fn a_shared_exponent_keeps_nine_bits() {
        let bright = image(1, 1);
        let bright = Texture {
            kind: SHARED_EXPONENT_IMAGE,
            ..bright
        };
        for exponent in -14..16 {
            for mantissa in [1.0, 1.3, 1.7, 1.999] {
                let value = mantissa * 2.0_f32.powi(exponent);
                let color = Vec3::new(value, value * 0.5, value * 0.01);
                let back = bright.color(&[shared_exponent(color)], Vec2::ZERO);
                assert!(
                    (back - color).abs().max_element() <= value / 500.0,
                    "{color} became {back}"
                );
            }
        }
        assert_eq!(bright.color(&[shared_exponent(Vec3::ZERO)], Vec2::ZERO), Vec3::ZERO);
    }

    #[test]
    fn heights_are_linear() {
        let ramp = Texture {
            kind: HEIGHT_IMAGE,
            ..image(4, 1)
        };
        let texels = [0.0_f32, 0.25, 0.5, -3.0].map(f32::to_bits);
        assert_eq!(ramp.color(&texels, vec2(0.625, 0.5)), Vec3::splat(0.5));
        assert_eq!(ramp.height(&texels, vec2(0.875, 0.5)), -3.0);
        // Half-way between the texels, whose middles are a quarter apart.
        assert_eq!(ramp.height(&texels, vec2(0.25, 0.5)), 0.125);
        let slope = ramp.slope(&texels, vec2(0.375, 0.5));
        assert!(slope.abs_diff_eq(vec2(1.0, 0.0), 1e-6), "{slope}");
    }

    #[test]
    fn coordinates_without_end_stay_within_the_image() {
        for at in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 3e38] {
            let color = image(2, 2).color(&[0; 4], vec2(at, -at));
            assert!(color == Vec3::ZERO || color.is_nan(), "{at}: {color}");
        }
    }

    #[test]
    fn waves_are_sines_however_far() {
        let waves = Texture {
            kind: WAVES,
            ..image(0, 0)
        };
        for i in -40..40 {
            let x = i as f32 / 16.0;
            let exact = 0.5 + 0.25 * (x * core::f32::consts::TAU).sin();
            for far in [0.0, 1000.0, -1000.0] {
                let height = waves.height(&[], vec2(x + far, 0.0));
                assert!((height - exact).abs() < 1e-6, "{x}: {height} and {exact}");
            }
        }
    }

    #[test]
    fn slopes_of_waves() {
        let waves = Texture {
            kind: WAVES,
            repeats: 2.0,
            ..image(0, 0)
        };
        for x in [0.0_f32, 0.1, 0.3, 0.77] {
            let slope = waves.slope(&[], vec2(x, 0.25));
            let exact = 0.25 * 2.0 * core::f32::consts::TAU * (2.0 * core::f32::consts::TAU * x).cos();
            assert!((slope.x - exact).abs() < 0.01, "{x}: {} and {exact}", slope.x);
        }
    }

    #[test]
    fn a_checkerboard_alternates() {
        let board = Texture {
            kind: CHECKERBOARD,
            width: 0,
            height: 0xff_ff_ff,
            repeats: 1.0,
            ..image(0, 0)
        };
        let color = |x, y| board.color(&[], vec2(x, y)).x;
        assert_eq!([color(0.5, 0.5), color(1.5, 0.5), color(1.5, 1.5)], [0.0, 1.0, 0.0]);
        assert_eq!([color(-0.5, 0.5), color(-0.5, -0.5), color(-1.5, 0.5)], [1.0, 0.0, 0.0]);
    }
}
