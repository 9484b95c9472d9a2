//! The texels of image files.

use glam::Vec3;
use image::error::LimitErrorKind;
use image::{DynamicImage, ImageError, ImageReader, Limits};
use oktant_shared::texture::{HEIGHT_IMAGE, SHARED_EXPONENT_IMAGE, SRGB_IMAGE, Texture, shared_exponent};
use rayon::prelude::*;
use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, ErrorKind, Seek};
use std::path::Path;

/// Most pixels of an image's row or column.
const LONGEST_SIDE: u32 = 16_384;
/// Most texels of all images: 256 MiB of them.
pub const MOST_TEXELS: usize = 1 << 26;
/// Most bytes that reading an image may take.
const MOST_BYTES: u64 = 2 << 30;
/// The largest value that a texel with a shared exponent holds.
const BRIGHTEST: f32 = 65_408.0;
/// The largest height, so that slopes stay finite.
const HIGHEST: f32 = 1e6;

/// Why an image cannot be used. Each sentence begins with the name of the image.
#[derive(Debug, thiserror::Error)]
pub enum ImageFault {
    /// It cannot be decoded.
    #[error("{name} is no image that can be read ({reason}); give a PNG, JPEG, HDR or EXR file")]
    Broken {
        /// The image.
        name: String,
        /// What is wrong with it.
        reason: ImageError,
    },
    /// A file that is not there.
    #[error("{0}: there is no such file; check the path")]
    Missing(String),
    /// A file that the system does not give.
    #[error("{name} cannot be read ({reason}); check the path")]
    Unreadable {
        /// The image.
        name: String,
        /// What the system says.
        reason: std::io::Error,
    },
    /// No pixels.
    #[error("{0} has no pixels; give another image")]
    Empty(String),
    /// Too wide or too high.
    #[error("{name} is too large; give an image of at most {most} pixels a side")]
    TooLong {
        /// The image.
        name: String,
        /// Pixels that a side may have.
        most: u32,
    },
}

/// All images together have more texels than this, which is more than a GPU takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("all images together may have {0} pixels, and there are more; make them smaller")]
pub struct TooManyTexels(pub usize);

/// Reads an image file. What it says about transparency is ignored.
///
/// # Errors
/// Why it cannot be had.
pub fn read(path: &Path) -> Result<DynamicImage, ImageFault> {
    let unreadable = |reason: std::io::Error| match reason.kind() {
        ErrorKind::NotFound => ImageFault::Missing(path.display().to_string()),
        _ => ImageFault::Unreadable {
            name: path.display().to_string(),
            reason,
        },
    };
    let file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(unreadable(ErrorKind::IsADirectory.into()));
    }
    decode(BufReader::new(file), &path.display().to_string())
}

/// Reads an image that is in memory; `name` is what errors call it. What it says about transparency is ignored.
///
/// # Errors
/// Why it cannot be had.
pub fn parse(bytes: &[u8], name: &str) -> Result<DynamicImage, ImageFault> {
    decode(Cursor::new(bytes), name)
}

fn decode(bytes: impl BufRead + Seek, name: &str) -> Result<DynamicImage, ImageFault> {
    let broken = |reason: ImageError| match reason {
        ImageError::Limits(limit) if limit.kind() == LimitErrorKind::DimensionError => ImageFault::TooLong {
            name: name.to_owned(),
            most: LONGEST_SIDE,
        },
        reason => ImageFault::Broken {
            name: name.to_owned(),
            reason,
        },
    };
    let mut reader = ImageReader::new(bytes)
        .with_guessed_format()
        .map_err(|reason| ImageFault::Unreadable {
            name: name.to_owned(),
            reason,
        })?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST_SIDE);
    limits.max_image_height = Some(LONGEST_SIDE);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let image = reader.decode().map_err(broken)?;
    if image.width() == 0 || image.height() == 0 {
        return Err(ImageFault::Empty(name.to_owned()));
    }
    Ok(image)
}

/// Adds the colours of an image, the upper left one first: with a common exponent where its channels are floating point
/// numbers (HDR, EXR), else with 8 bits a channel.
///
/// # Errors
/// Where there are too many texels.
pub fn add_colors(image: &DynamicImage, texels: &mut Vec<u32>) -> Result<Texture, TooManyTexels> {
    let is_float = matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
    let kind = if is_float { SHARED_EXPONENT_IMAGE } else { SRGB_IMAGE };
    let texture = texture(image, kind, texels)?;
    if is_float {
        texels.par_extend(image.to_rgb32f().as_raw().par_chunks_exact(3).map(|pixel| {
            let channel = |value: f32| if value > 0.0 { value.min(BRIGHTEST) } else { 0.0 };
            shared_exponent(Vec3::new(channel(pixel[0]), channel(pixel[1]), channel(pixel[2])))
        }));
    } else {
        texels.par_extend(
            image
                .to_rgb8()
                .as_raw()
                .par_chunks_exact(3)
                .map(|pixel| u32::from_le_bytes([pixel[0], pixel[1], pixel[2], 0])),
        );
    }
    Ok(texture)
}

/// Adds the heights of an image, the upper left one first: the mean of its channels, as they are where they are floating
/// point numbers, else as a part of the largest number that 8 or 16 bits hold. Nothing is decoded: heights are no light.
///
/// # Errors
/// Where there are too many texels.
pub fn add_heights(image: &DynamicImage, texels: &mut Vec<u32>) -> Result<Texture, TooManyTexels> {
    let texture = texture(image, HEIGHT_IMAGE, texels)?;
    texels.par_extend(image.to_rgb32f().as_raw().par_chunks_exact(3).map(|pixel| {
        let height = (f64::from(pixel[0]) + f64::from(pixel[1]) + f64::from(pixel[2])) / 3.0;
        if height.is_nan() {
            0
        } else {
            (height as f32).clamp(-HIGHEST, HIGHEST).to_bits()
        }
    }));
    Ok(texture)
}

/// The texture whose texels are to be added next.
/// Adds textures and the texels that they refer to to others; returns the index of the first.
///
/// # Errors
/// [`TooManyTexels`], and nothing is added then.
pub fn append(
    (all_textures, all_texels): (&mut Vec<Texture>, &mut Vec<u32>),
    (textures, texels): (&[Texture], &[u32]),
) -> Result<u32, TooManyTexels> {
    let (first, first_texel) = (all_textures.len() as u32, all_texels.len());
    if first_texel + texels.len() > MOST_TEXELS {
        return Err(TooManyTexels(MOST_TEXELS));
    }
    all_texels.extend_from_slice(texels);
    all_textures.extend(textures.iter().map(|own| Texture {
        first: own.first + first_texel as u32,
        ..*own
    }));
    Ok(first)
}

fn texture(image: &DynamicImage, kind: u32, texels: &[u32]) -> Result<Texture, TooManyTexels> {
    let (width, height) = (image.width(), image.height());
    if texels.len() + width as usize * height as usize > MOST_TEXELS {
        return Err(TooManyTexels(MOST_TEXELS));
    }
    Ok(Texture {
        first: texels.len() as u32,
        width,
        height,
        kind,
        repeats: 1.0,
        reserved: [0; 3],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;
    use image::{ImageBuffer, Luma, Rgb, Rgb32FImage, RgbImage};

    fn heights(image: DynamicImage) -> Vec<f32> {
        // They come after what is there.
        let mut texels = vec![7];
        let texture = add_heights(&image, &mut texels).unwrap();
        assert_eq!((texture.first, texture.kind), (1, HEIGHT_IMAGE));
        assert_eq!(
            texture.height(&texels, vec2(0.5 / image.width() as f32, 0.5)),
            f32::from_bits(texels[1])
        );
        texels[1..].iter().map(|texel| f32::from_bits(*texel)).collect()
    }

    #[test]
    fn heights_of_images_are_linear_and_keep_16_bits() {
        let grey = ImageBuffer::from_fn(4, 1, |x, _| Luma([[0_u16, 1, 32_768, 65_535][x as usize]]));
        assert_eq!(
            heights(DynamicImage::ImageLuma16(grey)),
            [0.0, 1.0 / 65_535.0, 32_768.0 / 65_535.0, 1.0]
        );
        let grey = ImageBuffer::from_fn(2, 1, |x, _| Luma([[128_u8, 255][x as usize]]));
        assert_eq!(heights(DynamicImage::ImageLuma8(grey)), [128.0 / 255.0, 1.0]);
        let mean = heights(RgbImage::from_pixel(1, 1, Rgb([255, 0, 51])).into());
        assert!((mean[0] - 0.4).abs() < 1e-6, "{mean:?}");
    }

    #[test]
    fn heights_of_floating_point_images_are_as_they_are() {
        let values = [-2.5, 0.1, f32::NAN, f32::INFINITY];
        let image = Rgb32FImage::from_fn(4, 1, |x, _| Rgb([values[x as usize]; 3]));
        assert_eq!(heights(image.into()), [-2.5, 0.1, 0.0, HIGHEST]);
    }
}
