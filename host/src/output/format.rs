//! Formats of picture files.

use clap::ValueEnum;
use std::path::{Path, PathBuf};

/// Bits of each channel in a PNG file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Bits {
    /// 256 steps from black to white.
    #[default]
    #[value(name = "8")]
    Eight,
    /// 65,536 steps.
    #[value(name = "16")]
    Sixteen,
}

/// The format of a picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// What a screen shows, sRGB-encoded.
    Png(Bits),
    /// The light of the scene, linear, in f32.
    Exr,
}

/// Why a picture can have no such file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// A name that stands for no format.
    #[error("Pictures are PNG or EXR files: give {} a name that ends in .png or .exr.", .0.display())]
    Unknown(PathBuf),
    /// Bits for a format that has no choice of them.
    #[error("EXR files always have 32 bits a channel: leave --bits out, or give {} a name that ends in .png.", .0.display())]
    BitsOfExr(PathBuf),
    /// Bits for a format that has no choice of them.
    #[error("GIF files have 256 colours a frame: leave --bits out, or give {} a name that ends in .apng.", .0.display())]
    BitsOfGif(PathBuf),
}

impl Format {
    /// The format that a file's name stands for, with so many bits or as many as are usual.
    ///
    /// # Errors
    /// [`FormatError`] where there is no such format.
    pub fn new(path: &Path, bits: Option<Bits>) -> Result<Self, FormatError> {
        let ends_in = |wanted: &str| {
            path.extension()
                .is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
        };
        match bits {
            _ if ends_in("png") => Ok(Format::Png(bits.unwrap_or_default())),
            None if ends_in("exr") => Ok(Format::Exr),
            Some(_) if ends_in("exr") => Err(FormatError::BitsOfExr(path.to_path_buf())),
            _ => Err(FormatError::Unknown(path.to_path_buf())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_for_formats() {
        let format = |name: &str, bits| Format::new(Path::new(name), bits);
        assert_eq!(format("a.png", None), Ok(Format::Png(Bits::Eight)));
        assert_eq!(format("b/a.PNG", Some(Bits::Sixteen)), Ok(Format::Png(Bits::Sixteen)));
        assert_eq!(format("a.b.Exr", None), Ok(Format::Exr));
        assert!(matches!(
            format("a.exr", Some(Bits::Sixteen)),
            Err(FormatError::BitsOfExr(_))
        ));
        for name in ["a", "a.jpg", ".png", "png", "a.exr.txt", ""] {
            assert!(matches!(format(name, None), Err(FormatError::Unknown(_))), "{name}");
        }
    }
}
