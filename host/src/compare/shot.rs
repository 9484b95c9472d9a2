//! A picture that is read from a file.

use image::error::LimitErrorKind;
use image::{DynamicImage, ImageError, ImageFormat, ImageReader, Limits};
use oktant_shared::color::{linear_from_srgb, srgb_from_linear};
use oktant_shared::present::mean_color;
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, BufReader, ErrorKind};
use std::path::{Path, PathBuf};

use crate::picture::{LARGEST_PICTURE, LARGEST_SIDE, Picture};

/// A picture as light and as colours, row by row from the upper left; what a file says of transparency is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    width: u32,
    height: u32,
    /// Linear RGB as the file has it; from 0 to 1 in a PNG file, any finite number in an EXR file.
    light: Vec<[f32; 3]>,
    /// What a screen shows: light cut off at 0 and 1, sRGB-encoded.
    colors: Vec<[f32; 3]>,
}

/// Why a file is no picture that can be compared.
#[derive(Debug, thiserror::Error)]
pub enum ShotFault {
    /// There is nothing.
    #[error("{}: there is no such file; check the path.", .0.display())]
    Missing(PathBuf),
    /// It cannot be read.
    #[error("{}: the file cannot be read ({reason}); check its permissions and the disk.", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: io::Error,
    },
    /// It is something else.
    #[error("{}: this is neither a PNG nor an EXR file; give one that `oktant render` has written.", .0.display())]
    Format(PathBuf),
    /// Its content is broken.
    #[error("{}: the picture cannot be decoded ({reason}); write it again.", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What the decoder says.
        reason: ImageError,
    },
    /// More pixels than oktant renders.
    #[error("{}: the picture is larger than {LARGEST_SIDE} pixels a side or {LARGEST_PICTURE} in all; compare parts of it.", .0.display())]
    TooLarge(PathBuf),
    /// Light that is no number.
    #[error("{}: the pixel at {x},{y} is not a finite number; find out who wrote it, for it has no difference from anything.", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// Its place in its row.
        x: usize,
        /// Its row.
        y: usize,
    },
}

impl Shot {
    /// Reads a PNG or EXR file.
    ///
    /// # Errors
    /// [`ShotFault`].
    pub fn read(path: &Path) -> Result<Self, ShotFault> {
        let image = decode(path)?;
        let encoded = !matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
        let (width, height) = (image.width(), image.height());
        let pixels: Vec<[f32; 3]> = image.into_rgb32f().into_raw().as_chunks().0.to_vec();
        if let Some(at) = pixels.iter().position(|pixel| !pixel.iter().all(|x| x.is_finite())) {
            return Err(ShotFault::NotFinite {
                path: path.to_path_buf(),
                x: at % width as usize,
                y: at / width as usize,
            });
        }
        Ok(if encoded {
            Shot {
                light: mapped(&pixels, linear_from_srgb),
                colors: pixels,
                width,
                height,
            }
        } else {
            Shot::of_light(width, height, pixels)
        })
    }

    /// A picture as an EXR file would hold it.
    pub fn of_picture(picture: &Picture) -> Self {
        let light = picture.sums.par_iter().map(|sum| mean_color(*sum).to_array());
        Shot::of_light(picture.width, picture.height, light.collect())
    }

    fn of_light(width: u32, height: u32, light: Vec<[f32; 3]>) -> Self {
        Shot {
            colors: mapped(&light, |light| srgb_from_linear(light.clamp(0.0, 1.0))),
            light,
            width,
            height,
        }
    }

    /// Pixels in a row, and rows.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Linear RGB.
    pub fn light(&self) -> &[[f32; 3]] {
        &self.light
    }

    /// What a screen shows, sRGB-encoded, 0 to 1.
    pub fn colors(&self) -> &[[f32; 3]] {
        &self.colors
    }
}

fn mapped(pixels: &[[f32; 3]], channel: impl Fn(f32) -> f32 + Sync) -> Vec<[f32; 3]> {
    pixels.par_iter().map(|pixel| pixel.map(&channel)).collect()
}

fn decode(path: &Path) -> Result<DynamicImage, ShotFault> {
    let unreadable = |reason: io::Error| match reason.kind() {
        ErrorKind::NotFound => ShotFault::Missing(path.to_path_buf()),
        _ => ShotFault::Unreadable {
            path: path.to_path_buf(),
            reason,
        },
    };
    let file = File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(unreadable(ErrorKind::IsADirectory.into()));
    }
    let mut reader = ImageReader::new(BufReader::new(file))
        .with_guessed_format()
        .map_err(unreadable)?;
    if !matches!(reader.format(), Some(ImageFormat::Png | ImageFormat::OpenExr)) {
        return Err(ShotFault::Format(path.to_path_buf()));
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(LARGEST_SIDE);
    limits.max_image_height = Some(LARGEST_SIDE);
    // Of four floats each.
    limits.max_alloc = Some(LARGEST_PICTURE * 16);
    reader.limits(limits);
    reader.decode().map_err(|reason| match reason {
        ImageError::Limits(limit)
            if matches!(
                limit.kind(),
                LimitErrorKind::DimensionError | LimitErrorKind::InsufficientMemory
            ) =>
        {
            ShotFault::TooLarge(path.to_path_buf())
        }
        reason => ShotFault::Broken {
            path: path.to_path_buf(),
            reason,
        },
    })
}
