//! Names of the files of an animation's frames.

use std::path::{Path, PathBuf};

/// A name with a place for the number of a frame: `frame-####.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameNames {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl FrameNames {
    /// The names that a path stands for: the last run of `#` in the file's name is the number, padded with zeros to as many
    /// digits. None where there is no `#`, or the name is no text.
    pub fn new(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let end = name.rfind('#')? + 1;
        let start = name[..end].trim_end_matches('#').len();
        Some(FrameNames {
            folder: path.parent().unwrap_or(Path::new("")).to_path_buf(),
            before: name[..start].into(),
            digits: end - start,
            after: name[end..].into(),
        })
    }

    /// The file of a frame; a number with more digits than there is place for takes more.
    pub fn path(&self, number: u32) -> PathBuf {
        let FrameNames {
            folder,
            before,
            digits,
            after,
        } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_padded_to_their_place() {
        for (path, number, wanted) in [
            ("frame-####.png", 7, "frame-0007.png"),
            ("a/b#.exr", 12, "a/b12.exr"),
            ("a#b##.png", 3, "a#b03.png"),
            ("#/##-x", 100, "#/100-x"),
        ] {
            assert_eq!(
                FrameNames::new(Path::new(path)).unwrap().path(number),
                Path::new(wanted)
            );
        }
    }

    #[test]
    fn a_name_without_a_place_has_no_numbers() {
        for path in ["frame.png", "a##/b.png", "", "##/.."] {
            assert_eq!(FrameNames::new(Path::new(path)), None, "{path}");
        }
    }
}
