//! Where the frames of an animation go.

use super::Failure;
use super::arguments::{FileArguments, FrameArguments, FrameRange, LookArguments};
use super::render::{check_one_picture, format};
use oktant::aov::Aov;
use oktant::output::{
    AnimationFiles, AnimationFormat, AnimationSettings, Format, FrameNames, OutputError, RenderingFiles, Written,
};
use oktant::picture::Picture;
use oktant::seen::Seen;
use oktant::tone::Tone;
use std::path::PathBuf;

/// Frames of a GIF or APNG file in a second, where nobody says it.
const FRAMES_PER_SECOND: u16 = 25;

/// The place that was asked for.
#[derive(Clone, Debug)]
pub enum Sequence {
    /// A file for each frame, or some.
    Numbered(Numbered),
    /// A file for all of them.
    Animation(Animation),
}

/// Files of one frame each.
#[derive(Clone, Debug)]
pub struct Numbered {
    names: FrameNames,
    format: Format,
    aovs: Vec<Aov>,
}

/// A file of all frames.
#[derive(Clone, Debug)]
pub struct Animation {
    /// None is standard output.
    path: Option<PathBuf>,
    settings: AnimationSettings,
}

impl Sequence {
    /// What the arguments mean.
    ///
    /// # Errors
    /// What does not go together.
    pub fn new(
        files: &FileArguments,
        frames: &FrameArguments,
        look: &LookArguments,
        range: &FrameRange,
    ) -> Result<Self, Failure> {
        Ok(match files.animation()? {
            Some(format) => Sequence::Animation(Animation::new(format, files, frames, range)?),
            None => Sequence::Numbered(Numbered::new(files, frames, look)?),
        })
    }

    /// Makes sure that a frame can be written, without touching what is there.
    ///
    /// # Errors
    /// Where it cannot.
    pub fn check(&self, frame: u32, is_pair: bool) -> Result<(), Failure> {
        match self {
            Sequence::Numbered(numbered) => drop(numbered.create(frame, is_pair)?),
            Sequence::Animation(animation) => drop(animation.create(is_pair)?),
        }
        Ok(())
    }

    /// The frames of some that are there already, with all their files.
    pub fn there(&self, range: &FrameRange, is_pair: bool) -> Vec<u32> {
        match self {
            Sequence::Numbered(numbered) => range
                .wanted
                .clone()
                .filter(|frame| numbered.is_there(*frame, is_pair))
                .collect(),
            Sequence::Animation(_) => Vec::new(),
        }
    }

    /// Begins to write.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn open(&self, is_pair: bool) -> Result<Album, Failure> {
        Ok(match self {
            Sequence::Numbered(numbered) => Album::Numbered {
                numbered: numbered.clone(),
                is_pair,
                written: Vec::new(),
            },
            Sequence::Animation(animation) => Album::Animation(animation.create(is_pair)?),
        })
    }
}

impl Numbered {
    fn new(files: &FileArguments, frames: &FrameArguments, look: &LookArguments) -> Result<Self, Failure> {
        let Some(names) = FrameNames::new(&files.output) else {
            return Err(Failure::usage(
                "Frames are files each, or one of all: give -o a name with # in the place of the number, for example \
                 frame-####.png, or one that ends in .gif or .apng, or - with --format gif or --format apng.",
            ));
        };
        if frames.fps.is_some() {
            return Err(Failure::usage(
                "Frames that are files each have no speed: leave --fps out, or give -o a name that ends in .gif or .apng.",
            ));
        }
        Ok(Numbered {
            names,
            format: format(files, look)?,
            aovs: files.aov.0.clone(),
        })
    }

    fn create(&self, frame: u32, is_pair: bool) -> Result<RenderingFiles, OutputError> {
        RenderingFiles::create(&self.names.path(frame), self.format, &self.aovs, is_pair)
    }

    fn is_there(&self, frame: u32, is_pair: bool) -> bool {
        let names = RenderingFiles::names(&self.names.path(frame), self.format, &self.aovs, is_pair);
        names.iter().all(|name| name.is_file())
    }
}

impl Animation {
    fn new(
        format: AnimationFormat,
        files: &FileArguments,
        frames: &FrameArguments,
        range: &FrameRange,
    ) -> Result<Self, Failure> {
        if !files.aov.0.is_empty() {
            return Err(Failure::usage(
                "An animation in one file has colours alone: leave --aov out, or give each frame a file, for example \
                 with -o frame-####.png.",
            ));
        }
        if frames.overwrite {
            return Err(Failure::usage(
                "An animation in one file is always made anew: leave --overwrite out.",
            ));
        }
        let frames_per_second = frames.fps.map_or(FRAMES_PER_SECOND, u16::from);
        if let Some(most) = format.most_frames_per_second()
            && frames_per_second > most
        {
            return Err(Failure::usage(format!(
                "A GIF shows at most {most} frames in a second: give --fps {most} or less, or make it an APNG."
            )));
        }
        Ok(Animation {
            path: (!files.is_standard_output()).then(|| files.output.clone()),
            settings: AnimationSettings {
                format,
                frame_count: range.len(),
                frames_per_second,
            },
        })
    }

    fn create(&self, is_pair: bool) -> Result<AnimationFiles, Failure> {
        match &self.path {
            Some(path) => Ok(AnimationFiles::create(path, self.settings, is_pair)?),
            None => {
                check_one_picture(is_pair)?;
                Ok(AnimationFiles::standard_output(self.settings)?)
            }
        }
    }
}

/// A sequence that is being written.
pub enum Album {
    Numbered {
        numbered: Numbered,
        is_pair: bool,
        written: Vec<Written>,
    },
    Animation(AnimationFiles),
}

impl Album {
    /// Adds a frame, and returns its own files.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn add(&mut self, frame: u32, picture: Picture, seen: Seen, tone: &Tone) -> Result<Vec<Written>, OutputError> {
        match self {
            Album::Numbered {
                numbered,
                is_pair,
                written,
            } => {
                let files = numbered.create(frame, *is_pair)?.save(picture, seen, tone)?;
                written.extend_from_slice(&files);
                Ok(files)
            }
            Album::Animation(files) => files.add(picture, tone).map(|()| Vec::new()),
        }
    }

    /// Ends with all frames added, and returns all files.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn finish(self) -> Result<Vec<Written>, OutputError> {
        match self {
            Album::Numbered { written, .. } => Ok(written),
            Album::Animation(files) => files.finish(),
        }
    }
}
