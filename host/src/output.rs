//! Writing files so that nothing is ever half written.

use crate::picture::Picture;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A picture file in the making: a temporary file beside it, which takes its name when the picture is complete and
/// vanishes otherwise.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    temporary: NamedTempFile,
}

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// There is something there that must not be replaced.
    #[error("{} is not a file; give another name for the picture.", .0.display())]
    NotAFile(PathBuf),
    /// The folder is missing.
    #[error("The folder {} does not exist; make it, or give another name for the picture.", .0.display())]
    NoFolder(PathBuf),
    /// Anything else that the system says.
    #[error("{} cannot be written ({source}); free space or give another name for the picture.", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl PictureFile {
    /// Makes sure that the file can be written, without touching what is there.
    ///
    /// # Errors
    /// [`OutputError`] where it cannot.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        if path.file_name().is_none() || fs::metadata(path).is_ok_and(|there| !there.is_file()) {
            return Err(OutputError::NotAFile(path.to_path_buf()));
        }
        if !folder.is_dir() {
            return Err(OutputError::NoFolder(folder.to_path_buf()));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".oktant-").suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What any new file gets; the process's mask still applies.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let temporary = builder.tempfile_in(folder).map_err(|source| OutputError::Io {
            path: path.to_path_buf(),
            source,
        })?;
        Ok(PictureFile {
            path: path.to_path_buf(),
            temporary,
        })
    }

    /// Writes the picture as an sRGB-encoded PNG and gives the file its name.
    ///
    /// # Errors
    /// [`OutputError::Io`], with nothing left behind and what was there before untouched.
    pub fn save(self, picture: &Picture) -> Result<(), OutputError> {
        self.save_rgb8(&picture.to_rgb8(), [picture.width, picture.height])
    }

    /// As [`PictureFile::save`], from red, green and blue of each pixel, sRGB-encoded.
    ///
    /// # Errors
    /// As [`PictureFile::save`].
    pub fn save_rgb8(self, pixels: &[u8], [width, height]: [u32; 2]) -> Result<(), OutputError> {
        let failed = |source| OutputError::Io {
            path: self.path.clone(),
            source,
        };
        let mut writer = BufWriter::new(self.temporary.as_file());
        let encoder = PngEncoder::new_with_quality(&mut writer, CompressionType::Default, FilterType::Adaptive);
        encoder
            .write_image(pixels, width, height, ExtendedColorType::Rgb8)
            .map_err(|error| {
                failed(match error {
                    ImageError::IoError(source) => source,
                    other => io::Error::other(other),
                })
            })?;
        writer.flush().map_err(failed)?;
        drop(writer);
        self.temporary.as_file().sync_all().map_err(failed)?;
        self.temporary
            .persist(&self.path)
            .map(drop)
            .map_err(|error| OutputError::Io {
                path: self.path.clone(),
                source: error.error,
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec4;

    fn picture() -> Picture {
        Picture::of_sums(2, 1, vec![vec4(1.0, 0.0, 0.0, 2.0), vec4(0.0, 4.0, 0.0, 1.0)])
    }

    #[test]
    fn a_picture_comes_back_srgb_encoded() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        fs::write(&path, "old").unwrap();
        PictureFile::create(&path).unwrap().save(&picture()).unwrap();
        let read = image::open(&path).unwrap().to_rgb8();
        assert_eq!(read.dimensions(), (2, 1));
        assert_eq!(read.get_pixel(0, 0).0, [188, 0, 0], "half the light is 188 of 255");
        assert_eq!(read.get_pixel(1, 0).0, [0, 255, 0], "too much light is cut off");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_cannot_be_written_is_refused_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(
            PictureFile::create(folder.path()),
            Err(OutputError::NotAFile(_))
        ));
        assert!(matches!(
            PictureFile::create(&folder.path().join("missing/picture.png")),
            Err(OutputError::NoFolder(_))
        ));
        let path = folder.path().join("picture.png");
        fs::write(&path, "old").unwrap();
        drop(PictureFile::create(&path).unwrap());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
