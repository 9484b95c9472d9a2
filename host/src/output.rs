//! Writing files so that nothing is ever half written.

mod animation_files;
mod animation_format;
mod aov_png;
mod apng;
mod format;
mod frame_names;
mod gif;
mod hits_file;
mod open_exr;
mod png;
mod rendering_files;
mod text_file;
mod unfinished;

pub use animation_files::{AnimationFiles, Settings as AnimationSettings};
pub use animation_format::AnimationFormat;
pub use format::{Bits, Format, FormatError};
pub use frame_names::FrameNames;
pub use hits_file::{HitsFile, face_normal};
pub use rendering_files::{RenderingFiles, Written};
pub use text_file::TextFile;
pub use unfinished::abandon;

use self::png::{Pixels, Png};
use self::unfinished::{Unfinished, undisturbed};
use crate::insight::Insight;
use crate::picture::Picture;
use crate::tone::Tone;
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A picture file in the making: a temporary file beside it, which takes its name when the picture is complete and
/// vanishes otherwise. Standard output gets all of it at once, when it is complete.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    store: Store,
}

/// Where the content is until it is complete.
#[derive(Debug)]
enum Store {
    Beside(NamedTempFile, Unfinished),
    /// A file without a name.
    Unnamed(File),
}

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// There is something there that must not be replaced.
    #[error("{} is not a file; give another name for it.", .0.display())]
    NotAFile(PathBuf),
    /// The folder is missing.
    #[error("The folder {} does not exist; make it, or give another name for it.", .0.display())]
    NoFolder(PathBuf),
    /// Anything else that the system says.
    #[error("{} cannot be written ({source}); free space or give another name for it.", path.display())]
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
        let made = Unfinished::create(|| builder.tempfile_in(folder));
        let (temporary, unfinished) = made.map_err(|source| OutputError::Io {
            path: path.to_path_buf(),
            source,
        })?;
        Ok(PictureFile {
            path: path.to_path_buf(),
            store: Store::Beside(temporary, unfinished),
        })
    }

    /// A file for whoever reads standard output.
    ///
    /// # Errors
    /// [`OutputError`] where there is no place to keep the content until it is complete.
    pub fn standard_output() -> Result<Self, OutputError> {
        let path = PathBuf::from("standard output");
        match tempfile::tempfile() {
            Ok(file) => Ok(PictureFile {
                path,
                store: Store::Unnamed(file),
            }),
            Err(source) => Err(OutputError::Io { path, source }),
        }
    }

    /// Writes the picture as a toned, sRGB-encoded PNG of 8 bits and gives the file its name.
    ///
    /// # Errors
    /// [`OutputError::Io`], with nothing left behind and what was there before untouched.
    pub fn save(self, picture: &Picture, tone: &Tone) -> Result<(), OutputError> {
        self.save_rgb8(&picture.to_rgb8(tone), [picture.width, picture.height])
    }

    /// As [`PictureFile::save`], from red, green and blue of each pixel, sRGB-encoded.
    ///
    /// # Errors
    /// As [`PictureFile::save`].
    pub fn save_rgb8(self, pixels: &[u8], size: [u32; 2]) -> Result<(), OutputError> {
        self.save_png(pixels, size, None)
    }

    /// As [`PictureFile::save_rgb8`], of colours that stand for something else, with a sentence that says how to read them.
    ///
    /// # Errors
    /// As [`PictureFile::save`].
    pub fn save_described(self, pixels: &[u8], size: [u32; 2], description: String) -> Result<(), OutputError> {
        self.save_png(pixels, size, Some(description))
    }

    fn save_png(mut self, pixels: &[u8], size: [u32; 2], description: Option<String>) -> Result<(), OutputError> {
        let png = Png {
            width: size[0],
            height: size[1],
            pixels: Pixels::Rgb8(pixels.into()),
            description,
        };
        self.write(|writer| png.write(writer))?;
        self.publish()
    }

    /// Writes what pixels tell as it is into an OpenEXR file and gives the file its name.
    ///
    /// # Errors
    /// As [`PictureFile::save`].
    pub fn save_insight(mut self, insight: &Insight) -> Result<(), OutputError> {
        self.write(|writer| open_exr::write_insight(writer, insight))?;
        self.publish()
    }

    /// Writes what is to be in the file, all the way to the disk.
    fn write(&mut self, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<(), OutputError> {
        let file = self.file();
        let mut writer = BufWriter::new(file);
        content(&mut writer)
            .and_then(|()| writer.flush())
            .and_then(|()| file.sync_all())
            .map_err(|source| self.failed(source))
    }

    fn file(&self) -> &File {
        match &self.store {
            Store::Beside(temporary, _) => temporary.as_file(),
            Store::Unnamed(file) => file,
        }
    }

    fn failed(&self, source: io::Error) -> OutputError {
        OutputError::Io {
            path: self.path.clone(),
            source,
        }
    }

    /// Gives the file its name.
    fn publish(self) -> Result<(), OutputError> {
        publish([self])
    }
}

/// Gives files their names, all of them in one go; what is for standard output is sent there.
fn publish(files: impl IntoIterator<Item = PictureFile>) -> Result<(), OutputError> {
    let mut named = Vec::new();
    for mut file in files {
        match file.store {
            Store::Beside(temporary, unfinished) => named.push((file.path, temporary, unfinished)),
            Store::Unnamed(ref mut content) => send(content).map_err(|source| file.failed(source))?,
        }
    }
    // Outlive the time in which nobody may take note of files.
    let mut done = Vec::with_capacity(named.len());
    let mut rest = named.into_iter();
    undisturbed(|| {
        for (path, temporary, unfinished) in rest.by_ref() {
            done.push(unfinished);
            temporary.persist(&path).map_err(|error| OutputError::Io {
                path,
                source: error.error,
            })?;
        }
        Ok(())
    })
}

/// Sends a file to standard output; whoever closed it early wants no more.
fn send(content: &mut File) -> io::Result<()> {
    content.rewind()?;
    let mut output = io::stdout().lock();
    match io::copy(content, &mut output).and_then(|_| output.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result.map(drop),
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
        PictureFile::create(&path)
            .unwrap()
            .save(&picture(), &Tone::default())
            .unwrap();
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
