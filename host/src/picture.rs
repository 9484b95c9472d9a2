//! A rendered picture.

use crate::tone::Tone;
use glam::{Vec3, Vec4};
use oktant_shared::adaptive::{INTERPOLATED, Mark, UNKNOWN, samples_at};
use oktant_shared::color::srgb_from_linear;
use oktant_shared::present::mean_color;
use rayon::prelude::*;

/// Pictures have no more pixels than this in a row or column.
pub const LARGEST_SIDE: u32 = 32_768;
/// Pictures have no more pixels than this: they must fit into memory.
pub const LARGEST_PICTURE: u64 = 1 << 28;
/// Width and height of pictures, and of the window, where nobody says them.
pub const DEFAULT_SIZE: [u32; 2] = [1280, 968];

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
    /// For each pixel the closest-hit rays, the shadow rays and the weight that was cut, summed over its samples; those too
    /// that were given up for more.
    pub work: Vec<Vec4>,
    /// For each pixel what adaptive sampling knows of it; empty where it was not used.
    pub marks: Vec<Mark>,
}

impl Picture {
    /// A picture in which nothing is written yet.
    pub fn unwritten(width: u32, height: u32) -> Self {
        Picture {
            width,
            height,
            sums: vec![Vec4::ZERO; width as usize * height as usize],
            work: vec![Vec4::ZERO; width as usize * height as usize],
            marks: Vec::new(),
        }
    }

    /// The picture with its colours only, nothing counted.
    pub fn of_sums(width: u32, height: u32, sums: Vec<Vec4>) -> Self {
        Picture {
            work: vec![Vec4::ZERO; sums.len()],
            marks: Vec::new(),
            width,
            height,
            sums,
        }
    }

    /// The samples of which the pixels consist, in the mean; an interpolated one has none. Of an adaptive picture.
    pub fn mean_samples(&self) -> f64 {
        let of = |mark: &Mark| match mark.level() {
            UNKNOWN | INTERPOLATED => 0,
            level => samples_at(level).samples,
        };
        let all: u64 = self.marks.par_iter().map(|mark| u64::from(of(mark))).sum();
        all as f64 / self.marks.len().max(1) as f64
    }

    /// The first rows, and the others.
    pub fn split(self, rows: u32) -> [Picture; 2] {
        let [upper_sums, lower_sums] = split(self.sums, self.width, rows);
        let [upper_work, lower_work] = split(self.work, self.width, rows);
        let [upper_marks, lower_marks] = if self.marks.is_empty() {
            [Vec::new(), Vec::new()]
        } else {
            split(self.marks, self.width, rows)
        };
        let part = |height, sums, work, marks| Picture {
            width: self.width,
            height,
            sums,
            work,
            marks,
        };
        [
            part(rows, upper_sums, upper_work, upper_marks),
            part(self.height - rows, lower_sums, lower_work, lower_marks),
        ]
    }

    /// The pixels as red, green and blue from 0 to 255, toned and sRGB-encoded; unwritten ones are magenta.
    pub fn to_rgb8(&self, tone: &Tone) -> Vec<u8> {
        self.sums
            .par_iter()
            .flat_map_iter(|sum| encoded(shown(*sum, tone), 255.0).map(|channel| channel as u8))
            .collect()
    }

    /// As [`Picture::to_rgb8`], from 0 to 65,535.
    pub fn to_rgb16(&self, tone: &Tone) -> Vec<u16> {
        self.sums
            .par_iter()
            .flat_map_iter(|sum| encoded(shown(*sum, tone), 65_535.0).map(|channel| channel as u16))
            .collect()
    }
}

/// The first rows of an array of pixels, and the others.
pub(crate) fn split<T>(mut pixels: Vec<T>, width: u32, rows: u32) -> [Vec<T>; 2] {
    let rest = pixels.split_off(width as usize * rows as usize);
    [pixels, rest]
}

/// The colour of a pixel's sum, linear RGB from 0 to 1. No tone curve dims the magenta of an unwritten one.
fn shown(sum: Vec4, tone: &Tone) -> Vec3 {
    let color = mean_color(sum);
    if sum.w > 0.0 { tone.map(color) } else { color }
}

/// Linear RGB, sRGB-encoded and rounded to whole numbers from 0 to `greatest`.
fn encoded(color: Vec3, greatest: f32) -> [f32; 3] {
    color
        .to_array()
        .map(|linear| (srgb_from_linear(linear.clamp(0.0, 1.0)) * greatest + 0.5).floor())
}

/// Red, green and blue of a pixel's sum, sRGB-encoded.
pub fn srgb_bytes(sum: Vec4) -> [u8; 3] {
    encoded(mean_color(sum), 255.0).map(|channel| channel as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tone::Curve;
    use glam::vec4;

    fn tone(exposure: f32, curve: Curve) -> Tone {
        Tone { exposure, curve }
    }

    #[test]
    fn colours_are_encoded_by_the_standard() {
        // sRGB values and what IEC 61966-2-1 makes of them, in double precision.
        for (byte, linear) in [(0_u8, 0.0), (10, 0.003_035_27), (128, 0.215_860_5), (255, 1.0)] {
            let picture = Picture::of_sums(1, 1, vec![vec4(linear, linear, linear, 1.0)]);
            assert_eq!(picture.to_rgb8(&Tone::default()), [byte; 3]);
            let wanted = u16::from(byte) * 257;
            for channel in picture.to_rgb16(&Tone::default()) {
                assert!(channel.abs_diff(wanted) <= 1, "{channel} for {wanted}");
            }
        }
    }

    #[test]
    fn sixteen_bits_tell_more_colours_apart_than_eight() {
        let sums = (0..1000).map(|i| vec4(0.2 + i as f32 * 1e-5, 0.0, 0.0, 1.0)).collect();
        let picture = Picture::of_sums(1000, 1, sums);
        let mut reds: Vec<u16> = picture.to_rgb16(&Tone::default()).into_iter().step_by(3).collect();
        assert!(reds.is_sorted());
        reds.dedup();
        assert!(reds.len() > 600, "{}", reds.len());
    }

    #[test]
    fn tone_and_exposure_are_in_the_picture() {
        let picture = Picture::of_sums(1, 1, vec![vec4(2.0, 2.0, 2.0, 2.0)]);
        let red = |tone: &Tone| picture.to_rgb8(tone)[0];
        assert_eq!(red(&tone(0.0, Curve::None)), 255);
        // Half the light is 188 of 255, an eighth 99.
        assert_eq!(red(&tone(0.0, Curve::Reinhard)), 188);
        assert_eq!(red(&tone(-1.0, Curve::None)), 188);
        assert_eq!(red(&tone(-3.0, Curve::None)), 99);
        // (2.51 + 0.03) / (2.43 + 0.59 + 0.14) = 0.8038 is 231.6 of 255.
        assert_eq!(red(&tone(0.0, Curve::Aces)), 232);
    }

    #[test]
    fn an_unwritten_pixel_is_magenta_whatever_the_tone() {
        for curve in Curve::ALL {
            let picture = Picture::unwritten(1, 1);
            assert_eq!(picture.to_rgb8(&tone(-4.0, curve)), [255, 0, 255]);
            assert_eq!(picture.to_rgb16(&tone(-4.0, curve)), [65_535, 0, 65_535]);
        }
    }

    #[test]
    fn rows_are_split() {
        let sums: Vec<Vec4> = (0..6).map(|i| Vec4::splat(i as f32)).collect();
        let [upper, lower] = Picture::of_sums(2, 3, sums.clone()).split(2);
        assert_eq!((upper.width, upper.height, upper.work.len()), (2, 2, 4));
        assert_eq!(upper.sums, sums[..4]);
        assert_eq!((lower.width, lower.height, lower.work.len()), (2, 1, 2));
        assert_eq!(lower.sums, sums[4..]);
    }
}
