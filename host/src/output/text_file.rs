//! Files of text.

use super::{OutputError, PictureFile};
use std::io::Write;
use std::path::Path;

/// A file of text in the making, see [`PictureFile`].
#[derive(Debug)]
pub struct TextFile(PictureFile);

impl TextFile {
    /// Makes sure that the file can be written, without touching what is there.
    ///
    /// # Errors
    /// [`OutputError`] where it cannot.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        PictureFile::create(path).map(TextFile)
    }

    /// A file for whoever reads standard output, see [`PictureFile::standard_output`].
    ///
    /// # Errors
    /// [`OutputError`] where there is no place to keep the content until it is complete.
    pub fn standard_output() -> Result<Self, OutputError> {
        PictureFile::standard_output().map(TextFile)
    }

    /// Writes the text and gives the file its name.
    ///
    /// # Errors
    /// [`OutputError::Io`], with nothing left behind and what was there before untouched.
    pub fn save(mut self, text: &str) -> Result<(), OutputError> {
        self.0.write(|writer| writer.write_all(text.as_bytes()))?;
        self.0.publish()
    }
}
