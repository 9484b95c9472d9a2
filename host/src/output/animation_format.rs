//! Formats of files that hold all frames of an animation.

use super::{Bits, FormatError};
use std::path::Path;

/// The format of an animation's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationFormat {
    /// 256 colours a frame.
    Gif,
    /// Every colour, as a PNG file has it.
    Apng(Bits),
}

impl AnimationFormat {
    /// The format that a file's name stands for, with so many bits or as many as are usual; none where it is no animation.
    ///
    /// # Errors
    /// [`FormatError::BitsOfGif`].
    pub fn new(path: &Path, bits: Option<Bits>) -> Result<Option<Self>, FormatError> {
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        match extension.as_ref().and_then(|extension| extension.to_str()) {
            Some("gif") if bits.is_some() => Err(FormatError::BitsOfGif(path.to_path_buf())),
            Some("gif") => Ok(Some(AnimationFormat::Gif)),
            Some("apng") => Ok(Some(AnimationFormat::Apng(bits.unwrap_or_default()))),
            _ => Ok(None),
        }
    }

    /// The most frames that can be shown in a second, if there is a limit.
    pub fn most_frames_per_second(self) -> Option<u16> {
        match self {
            // Delays are hundredths of a second, and what shows them takes less than two for a mistake.
            AnimationFormat::Gif => Some(50),
            AnimationFormat::Apng(_) => None,
        }
    }

    /// Bits of each channel.
    pub fn bits(self) -> Bits {
        match self {
            AnimationFormat::Gif => Bits::Eight,
            AnimationFormat::Apng(bits) => bits,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_for_formats() {
        let format = |name: &str, bits| AnimationFormat::new(Path::new(name), bits);
        assert_eq!(format("a.GIF", None), Ok(Some(AnimationFormat::Gif)));
        assert_eq!(format("b/a.apng", None), Ok(Some(AnimationFormat::Apng(Bits::Eight))));
        let sixteen = Some(Bits::Sixteen);
        assert_eq!(
            format("a.apng", sixteen),
            Ok(Some(AnimationFormat::Apng(Bits::Sixteen)))
        );
        assert!(matches!(format("a.gif", sixteen), Err(FormatError::BitsOfGif(_))));
        for name in ["a.png", "gif", ".gif", "a.gif.png", ""] {
            assert_eq!(format(name, sixteen), Ok(None), "{name}");
        }
    }
}
