//! The frames of an animation.

use crate::cli::Failure;
use clap::Args;
use oktant::camera_path::CameraPath;
use std::num::NonZeroU16;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// Which frames are rendered, and what changes between them.
#[derive(Clone, Debug, Default, Args)]
pub struct FrameArguments {
    /// Render so many frames, 1 to 1000000, along --path: a file each with -o NAME-####.png (# is the number, from 1) or .exr,
    /// one file of all with -o NAME.gif or .apng. FIRST..LAST/N renders a part of N frames.
    #[arg(long, value_name = "N|FIRST..LAST/N", value_parser = frames, conflicts_with = "reference")]
    pub frames: Option<FrameRange>,
    /// What changes from frame to frame: the camera turns once (turntable), or key frames from a file, which docs/output.md
    /// describes [default: turntable].
    #[arg(long, value_name = "turntable|FILE.toml", value_parser = path, requires = "frames")]
    pub path: Option<PathArgument>,
    /// Frames that a GIF or APNG file shows in a second, 1 to 65535, of a GIF at most 50 [default: 25].
    #[arg(long, value_name = "N", requires = "frames")]
    pub fps: Option<NonZeroU16>,
    /// Render numbered frames anew that are there already.
    #[arg(long, requires = "frames")]
    pub overwrite: bool,
}

impl FrameArguments {
    /// What changes from frame to frame.
    ///
    /// # Errors
    /// Of a file that cannot be used.
    pub fn camera_path(&self) -> Result<CameraPath, Failure> {
        match &self.path {
            None | Some(PathArgument::Turntable) => Ok(CameraPath::Turntable),
            Some(PathArgument::File(path)) => Ok(CameraPath::read(path)?),
        }
    }
}

/// Some of an animation's frames, counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameRange {
    /// Those that are meant, at least one.
    pub wanted: RangeInclusive<u32>,
    /// All that the animation has.
    pub count: u32,
}

impl FrameRange {
    /// How many are meant.
    pub fn len(&self) -> u32 {
        self.wanted.end() - self.wanted.start() + 1
    }
}

/// Where the numbers of frames end.
const MOST: u32 = 1_000_000;

fn frames(text: &str) -> Result<FrameRange, String> {
    let wanted = format!("give a number of frames from 1 to {MOST}, or a part of them, for example 1..60/240");
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| wanted.clone());
    let (part, count) = match text.split_once('/') {
        Some((part, count)) => (Some(part), number(count)?),
        None => (None, number(text)?),
    };
    if !(1..=MOST).contains(&count) {
        return Err(wanted);
    }
    let part = match part {
        None => 1..=count,
        Some(part) => {
            let (first, last) = part.split_once("..").ok_or_else(|| wanted.clone())?;
            number(first)?..=number(last)?
        }
    };
    if part.is_empty() || *part.start() == 0 || *part.end() > count {
        return Err(format!(
            "give a part of the frames 1 to {count}, the first before the last"
        ));
    }
    Ok(FrameRange { wanted: part, count })
}

/// What changes from frame to frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PathArgument {
    Turntable,
    File(PathBuf),
}

fn path(text: &str) -> Result<PathArgument, String> {
    let is_file = Path::new(text)
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    match text {
        "turntable" => Ok(PathArgument::Turntable),
        _ if is_file => Ok(PathArgument::File(text.into())),
        _ => Err("give turntable, or a file of key frames whose name ends in .toml".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_frames() {
        let all = |wanted, count| Ok(FrameRange { wanted, count });
        assert_eq!(frames("48"), all(1..=48, 48));
        assert_eq!(frames("1..1/1"), all(1..=1, 1));
        assert_eq!(frames("3 .. 7 / 48"), all(3..=7, 48));
        for bad in ["", "0", "-1", "1.5", "1000001", "1..4", "3/4", "1../4", "x..2/4"] {
            assert!(frames(bad).unwrap_err().contains("1..60/240"), "{bad}");
        }
        for bad in ["0..4/4", "2..1/4", "1..5/4"] {
            assert!(frames(bad).unwrap_err().contains("1 to 4"), "{bad}");
        }
    }

    #[test]
    fn paths_have_names() {
        assert_eq!(path("turntable"), Ok(PathArgument::Turntable));
        assert_eq!(path("a/b.TOML"), Ok(PathArgument::File("a/b.TOML".into())));
        for bad in ["", "Turntable", "orbit", "a.json", "toml"] {
            assert!(path(bad).is_err(), "{bad}");
        }
    }
}
