//! Files that hold all frames of an animation, complete or not there.

use super::apng::Apng;
use super::gif::Gif;
use super::png::Pixels;
use super::rendering_files::eyes;
use super::{AnimationFormat, OutputError, PictureFile, Written, publish};
use crate::picture::Picture;
use crate::tone::Tone;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Files in the making, see [`PictureFile`]: one for each eye. Frames are written as they come.
pub struct AnimationFiles {
    settings: Settings,
    eyes: Vec<EyeFile>,
}

/// What is known of an animation before its first frame.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The format of the files.
    pub format: AnimationFormat,
    /// How many frames there will be, at least one.
    pub frame_count: u32,
    /// How many of them are shown in a second, at least one, and at most as many as the format can.
    pub frames_per_second: u16,
}

struct EyeFile {
    file: PictureFile,
    /// None before the first frame, whose size it has.
    encoder: Option<Encoder>,
}

enum Encoder {
    Gif(Gif<BufWriter<File>>),
    Apng(Apng<BufWriter<File>>),
}

impl AnimationFiles {
    /// Makes sure that the files can be written, without touching what is there. Those of a pair have `-left` and `-right`
    /// at the end of their names.
    ///
    /// # Errors
    /// [`OutputError`] of the first that cannot.
    pub fn create(path: &Path, settings: Settings, is_pair: bool) -> Result<Self, OutputError> {
        let eye = |name: &PathBuf| PictureFile::create(name).map(EyeFile::new);
        let eyes = eyes(path, is_pair).iter().map(eye).collect::<Result<_, _>>()?;
        Ok(AnimationFiles { settings, eyes })
    }

    /// An animation for whoever reads standard output.
    ///
    /// # Errors
    /// [`OutputError`] where there is no place to keep it until it is complete.
    pub fn standard_output(settings: Settings) -> Result<Self, OutputError> {
        let eyes = vec![EyeFile::new(PictureFile::standard_output()?)];
        Ok(AnimationFiles { settings, eyes })
    }

    /// Whether there is a file for each of two eyes.
    pub fn is_pair(&self) -> bool {
        self.eyes.len() == 2
    }

    /// Adds the next frame, of the same size as all others. Of a pair, the upper half of the picture is the left eye's.
    ///
    /// # Errors
    /// [`OutputError::Io`].
    pub fn add(&mut self, picture: Picture, tone: &Tone) -> Result<(), OutputError> {
        let parts = if self.is_pair() {
            let rows = picture.height / 2;
            Vec::from(picture.split(rows))
        } else {
            vec![picture]
        };
        for (eye, picture) in self.eyes.iter_mut().zip(&parts) {
            let added = eye.add(picture, tone, self.settings);
            added.map_err(|source| eye.file.failed(source))?;
        }
        Ok(())
    }

    /// Gives the files their names, now that all frames are added.
    ///
    /// # Errors
    /// [`OutputError::Io`]; nothing is left behind and what was there before is untouched, unless the very last step, the
    /// renaming, failed for one of two.
    pub fn finish(self) -> Result<Vec<Written>, OutputError> {
        let mut files = Vec::new();
        let mut written = Vec::new();
        for EyeFile { file, encoder } in self.eyes {
            let ended = match encoder {
                Some(Encoder::Gif(gif)) => gif.finish(),
                Some(Encoder::Apng(apng)) => apng.finish(),
                None => Err(io::Error::other("there are no frames")),
            };
            ended
                .and_then(|()| file.file().sync_all())
                .map_err(|source| file.failed(source))?;
            written.push(Written {
                path: file.path.clone(),
                description: None,
            });
            files.push(file);
        }
        publish(files)?;
        Ok(written)
    }
}

impl EyeFile {
    fn new(file: PictureFile) -> Self {
        EyeFile { file, encoder: None }
    }

    fn add(&mut self, picture: &Picture, tone: &Tone, settings: Settings) -> io::Result<()> {
        let pixels = Pixels::of(picture, tone, settings.format.bits());
        let encoder = match &mut self.encoder {
            Some(encoder) => encoder,
            none => {
                let writer = BufWriter::new(self.file.file().try_clone()?);
                none.insert(Encoder::new(
                    writer,
                    [picture.width, picture.height],
                    &pixels,
                    settings,
                )?)
            }
        };
        match encoder {
            Encoder::Gif(gif) => gif.add(&pixels.bytes()),
            Encoder::Apng(apng) => apng.add(&pixels),
        }
    }
}

impl Encoder {
    fn new(writer: BufWriter<File>, size: [u32; 2], like: &Pixels<'_>, settings: Settings) -> io::Result<Self> {
        let Settings {
            format,
            frame_count,
            frames_per_second,
        } = settings;
        Ok(match format {
            AnimationFormat::Gif => Encoder::Gif(Gif::new(writer, size, frames_per_second)?),
            AnimationFormat::Apng(_) => Encoder::Apng(Apng::new(writer, size, like, frame_count, frames_per_second)?),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Bits;
    use glam::vec4;
    use std::fs;

    /// A picture whose upper half is red and whose lower one is black.
    fn stacked() -> Picture {
        let sums = (0..8).map(|i| vec4(if i < 4 { 1.0 } else { 0.0 }, 0.0, 0.0, 1.0));
        Picture::of_sums(2, 4, sums.collect())
    }

    fn settings(format: AnimationFormat) -> Settings {
        Settings {
            format,
            frame_count: 2,
            frames_per_second: 25,
        }
    }

    #[test]
    fn each_eye_has_its_animation() {
        let folder = tempfile::tempdir().unwrap();
        for (name, format) in [
            ("a.apng", AnimationFormat::Apng(Bits::Eight)),
            ("a.gif", AnimationFormat::Gif),
        ] {
            let path = folder.path().join(name);
            let mut files = AnimationFiles::create(&path, settings(format), true).unwrap();
            for _ in 0..2 {
                files.add(stacked(), &Tone::default()).unwrap();
            }
            let written = files.finish().unwrap();
            assert_eq!(written.len(), 2);
            // The first frame is what shows where nothing moves.
            let [left, right] = [0, 1].map(|eye| {
                let bytes = fs::read(&written[eye].path).unwrap();
                match format {
                    AnimationFormat::Gif => first_of_gif(&bytes),
                    AnimationFormat::Apng(_) => image::load_from_memory(&bytes).unwrap().into_rgb8().into_raw(),
                }
            });
            assert_eq!(left, [255, 0, 0].repeat(4));
            assert_eq!(right, [0; 12]);
            assert!(!path.exists());
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 4);
    }

    fn first_of_gif(bytes: &[u8]) -> Vec<u8> {
        let mut options = ::gif::DecodeOptions::new();
        options.set_color_output(::gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes).unwrap();
        let frame = decoder.read_next_frame().unwrap().unwrap();
        let pixels = frame.buffer.as_chunks::<4>().0.iter();
        pixels.flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
    }

    #[test]
    fn what_is_not_finished_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gif");
        fs::write(&path, "old").unwrap();
        let create = || AnimationFiles::create(&path, settings(AnimationFormat::Gif), false).unwrap();
        let mut files = create();
        files.add(stacked(), &Tone::default()).unwrap();
        drop(files);
        assert!(create().finish().is_err(), "there are no frames");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
