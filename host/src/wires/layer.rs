//! Lines to be laid over a picture.

use embedded_graphics::geometry::Point;
use embedded_graphics::primitives::{Line, PointsIter};

/// What lies over a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// A byte each of red, green, blue (sRGB-encoded) and opacity a pixel, red the lowest; row by row from the upper left.
    pub texels: Vec<u32>,
}

impl Layer {
    /// Nothing.
    pub fn clear(size: [u32; 2]) -> Self {
        Layer {
            size,
            texels: vec![0; size[0] as usize * size[1] as usize],
        }
    }

    /// Draws a line between two points, pixels from the upper left corner; where several cross, the most opaque one is seen.
    pub fn line(&mut self, ends: [[f32; 2]; 2], [red, green, blue]: [u8; 3], opacity: u8) {
        let [width, height] = self.size.map(|side| side as i32);
        let [from, to] = ends.map(|[x, y]| Point::new((x as i32).clamp(0, width - 1), (y as i32).clamp(0, height - 1)));
        for at in Line::new(from, to).points() {
            let texel = &mut self.texels[at.y as usize * width as usize + at.x as usize];
            if u32::from(opacity) >= *texel >> 24 {
                *texel = u32::from_le_bytes([red, green, blue, opacity]);
            }
        }
    }

    /// Lays it over red, green and blue of each pixel of a picture that is as wide, and at least as high.
    ///
    /// # Panics
    /// If the picture has fewer pixels.
    pub fn over(&self, pixels: &mut [u8]) {
        for (texel, pixel) in self
            .texels
            .iter()
            .zip(pixels[..3 * self.texels.len()].as_chunks_mut().0)
        {
            let [red, green, blue, opacity] = texel.to_le_bytes().map(u32::from);
            let pixel: &mut [u8; 3] = pixel;
            for (channel, over) in pixel.iter_mut().zip([red, green, blue]) {
                let mixed = over * opacity + u32::from(*channel) * (255 - opacity);
                *channel = ((mixed + 127) / 255) as u8;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_opaque_line_is_seen_and_mixed_in() {
        let mut layer = Layer::clear([4, 3]);
        layer.line([[0.5, 1.5], [3.5, 1.5]], [200, 100, 0], 51);
        layer.line([[2.5, 0.0], [2.5, 3.0]], [0, 0, 255], 255);
        layer.line([[0.0, 2.9], [4.0, 2.9]], [9, 9, 9], 50);
        let mut pixels = vec![100; 4 * 3 * 3];
        layer.over(&mut pixels);
        let pixel = |x: usize, y: usize| &pixels[3 * (4 * y + x)..][..3];
        assert_eq!(pixel(0, 0), [100; 3], "nothing is there");
        assert_eq!(pixel(1, 1), [120, 100, 80], "a fifth of it");
        assert_eq!([pixel(2, 1), pixel(2, 2)], [[0, 0, 255]; 2]);
        assert_eq!(pixel(3, 2), [82; 3]);
    }
}
