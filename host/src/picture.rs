//! A rendered picture.

use glam::Vec4;
use oktant_shared::color::srgb_from_linear;
use oktant_shared::present::mean_color;
use rayon::prelude::*;

/// Pictures have no more pixels than this in a row or column.
pub const LARGEST_SIDE: u32 = 32_768;
/// Pictures have no more pixels than this: they must fit into memory.
pub const LARGEST_PICTURE: u64 = 1 << 28;

/// Sums of samples, row by row from the upper left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// For each pixel the weighted sum of its samples' linear RGB, and the sum of the weights; 0 where nothing was
    /// written.
    pub sums: Vec<Vec4>,
    /// For each pixel the closest-hit rays, the shadow rays and the weight that was cut, summed over its samples.
    pub work: Vec<Vec4>,
}

impl Picture {
    /// A picture in which nothing is written yet.
    pub fn unwritten(width: u32, height: u32) -> Self {
        Picture {
            width,
            height,
            sums: vec![Vec4::ZERO; width as usize * height as usize],
            work: vec![Vec4::ZERO; width as usize * height as usize],
        }
    }

    /// The picture with its colours only, nothing counted.
    pub fn of_sums(width: u32, height: u32, sums: Vec<Vec4>) -> Self {
        Picture {
            work: vec![Vec4::ZERO; sums.len()],
            width,
            height,
            sums,
        }
    }

    /// The pixels as bytes of red, green and blue, sRGB-encoded; unwritten ones are magenta.
    pub fn to_rgb8(&self) -> Vec<u8> {
        self.sums.par_iter().flat_map_iter(|sum| srgb_bytes(*sum)).collect()
    }
}

/// Red, green and blue of a pixel's sum, sRGB-encoded.
pub fn srgb_bytes(sum: Vec4) -> [u8; 3] {
    mean_color(sum)
        .to_array()
        .map(|linear| (srgb_from_linear(linear.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8)
}
