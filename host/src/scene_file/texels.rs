//! The texels of image files.

use super::fault::Reason;
use glam::Vec3;
use image::error::LimitErrorKind;
use image::{DynamicImage, ImageError, ImageReader, Limits};
use oktant_shared::texture::{SHARED_EXPONENT_IMAGE, SRGB_IMAGE, Texture, shared_exponent};
use rayon::prelude::*;
use std::fs::File;
use std::io::{BufReader, ErrorKind};
use std::path::Path;

/// Most pixels of an image's row or column.
const LONGEST_SIDE: u32 = 16_384;
/// Most texels of all images: 256 MiB of them.
const MOST_TEXELS: usize = 1 << 26;
/// Most bytes that reading an image may take.
const MOST_BYTES: u64 = 2 << 30;
/// The largest value that a texel with a shared exponent holds.
const BRIGHTEST: f32 = 65_408.0;

/// Reads an image and adds its texels, the upper left one first: with a common exponent where its channels are floating
/// point numbers (HDR, EXR), else with 8 bits a channel. What it says about transparency is ignored.
///
/// # Errors
/// Why it cannot be had.
pub fn read(path: &Path, texels: &mut Vec<u32>) -> Result<Texture, Reason> {
    let unreadable = |reason: std::io::Error| match reason.kind() {
        ErrorKind::NotFound => Reason::NoFile(path.to_path_buf()),
        _ => Reason::File {
            path: path.to_path_buf(),
            reason,
        },
    };
    let file = File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(unreadable(ErrorKind::IsADirectory.into()));
    }
    let broken = |reason: ImageError| match reason {
        ImageError::Limits(limit) if limit.kind() == LimitErrorKind::DimensionError => Reason::LongImage {
            path: path.to_path_buf(),
            most: LONGEST_SIDE,
        },
        reason => Reason::Image {
            path: path.to_path_buf(),
            reason,
        },
    };
    let mut reader = ImageReader::new(BufReader::new(file))
        .with_guessed_format()
        .map_err(unreadable)?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST_SIDE);
    limits.max_image_height = Some(LONGEST_SIDE);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let image = reader.decode().map_err(broken)?;
    let (width, height) = (image.width(), image.height());
    if width == 0 || height == 0 {
        return Err(Reason::EmptyImage(path.to_path_buf()));
    }
    let first = texels.len();
    if first + width as usize * height as usize > MOST_TEXELS {
        return Err(Reason::TooManyTexels(MOST_TEXELS));
    }
    let is_float = matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
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
    Ok(Texture {
        first: first as u32,
        width,
        height,
        kind: if is_float { SHARED_EXPONENT_IMAGE } else { SRGB_IMAGE },
        repeats: 1.0,
        reserved: [0; 3],
    })
}
