//! From the sums of samples to what is shown.

use crate::buffer::load;
use crate::tone::tone_mapped;
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};

/// How a picture is shown on a surface: the uniform buffer of the entry points `present_*`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Present {
    /// Width of the picture, pixels.
    pub width: u32,
    /// Rows of the picture that are shown.
    pub height: u32,
    /// Width of the surface, pixels.
    pub surface_width: u32,
    /// Height of the surface, pixels.
    pub surface_height: u32,
    /// Width of the overlay in the surface's upper left corner, pixels; 0 where there is none.
    pub overlay_width: u32,
    /// Height of the overlay, pixels.
    pub overlay_height: u32,
    /// What colours are multiplied with.
    pub exposure: f32,
    /// How they are made to fit the screen: one of [`crate::tone`].
    pub curve: u32,
    /// First row of the picture that is shown, for pictures that hold two.
    pub first_row: u32,
    /// Fills the rows; fields of their own because an array in a uniform buffer needs 16 bytes an element.
    pub reserved_a: u32,
    /// Fills the rows.
    pub reserved_b: u32,
    /// Fills the rows.
    pub reserved_c: u32,
}

const _: () = assert!(size_of::<Present>() == 48);

/// The mean of a pixel's samples, linear RGB; magenta where no sample was ever written.
pub fn mean_color(sum: Vec4) -> Vec3 {
    if sum.w > 0.0 {
        sum.xyz() / sum.w
    } else {
        Vec3::new(1.0, 0.0, 1.0)
    }
}

/// The colour, linear RGB and opaque, of a point of the surface, in pixels from its upper left corner.
///
/// A picture smaller than the surface is enlarged without smoothing. The overlay has a byte each of red, green, blue and
/// opacity a pixel, not premultiplied, and is not enlarged.
pub fn presented_color(present: &Present, picture: &[Vec4], overlay: &[u32], at: Vec2) -> Vec4 {
    let column = scaled(at.x, present.surface_width, present.width);
    let row = present.first_row + scaled(at.y, present.surface_height, present.height);
    let color = mean_color(load(picture, row * present.width + column));
    let color = tone_mapped(color, present.exposure, present.curve);
    let (x, y) = (at.x as u32, at.y as u32);
    if x < present.overlay_width && y < present.overlay_height {
        let texel = load(overlay, y * present.overlay_width + x);
        let opacity = (texel >> 24) as f32 / 255.0;
        let over = crate::color::linear_color(texel);
        (color + (over - color) * opacity).extend(1.0)
    } else {
        color.extend(1.0)
    }
}

/// The place in a row of `to` pixels that corresponds to one in a row of `from`.
fn scaled(at: f32, from: u32, to: u32) -> u32 {
    let place = (at * to as f32 / from as f32) as u32;
    if place < to { place } else { to - 1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;

    #[test]
    fn pictures_are_enlarged_and_overlaid() {
        let picture: [Vec4; 4] = core::array::from_fn(|i| Vec4::new(i as f32, 0.0, 0.0, 2.0));
        let present = Present {
            width: 2,
            height: 2,
            surface_width: 8,
            surface_height: 8,
            overlay_width: 1,
            overlay_height: 2,
            exposure: 0.5,
            ..Present::zeroed()
        };
        let overlay = [0xff00_ff00, 0x0000_0000];
        let color = |x, y| presented_color(&present, &picture, &overlay, vec2(x, y));
        assert_eq!(color(3.5, 3.5).x, 0.0);
        assert_eq!(color(4.5, 3.5).x, 0.25);
        assert_eq!(color(3.5, 4.5).x, 0.5);
        assert_eq!(color(7.5, 7.5).x, 0.75);
        assert_eq!(color(0.5, 0.5), Vec4::new(0.0, 1.0, 0.0, 1.0), "opaque overlay");
        assert_eq!(color(0.5, 1.5).x, 0.0, "clear overlay");
    }

    #[test]
    fn an_unwritten_pixel_shows() {
        assert_eq!(mean_color(Vec4::ZERO), Vec3::new(1.0, 0.0, 1.0));
    }
}
