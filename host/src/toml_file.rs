//! TOML files that a person writes, and errors that say where in them something is wrong.

use crate::scene_file::document::Document;
use crate::scene_file::fault::Fault;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Such files are not larger than this, bytes.
const LARGEST: u64 = 16 << 20;

/// What a file describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subject {
    /// The file, as in "the scene file".
    pub file: &'static str,
    /// What it describes, as in "the scene".
    pub whole: &'static str,
    /// What to do about a file that is too long.
    pub relief: &'static str,
    /// Fields at the top that are no tables.
    pub top_fields: &'static [&'static str],
}

/// Why a file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TomlFileError {
    /// The system does not give it.
    #[error("{}: the {file} cannot be read ({reason}); check the path", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What it should be.
        file: &'static str,
        /// What the system says.
        reason: io::Error,
    },
    /// It is no text.
    #[error("{}: this is no text in UTF-8; give a {file}", path.display())]
    NotText {
        /// The file.
        path: PathBuf,
        /// What it should be.
        file: &'static str,
    },
    /// It is too long for something that a person wrote.
    #[error("{}: a {} has at most {LARGEST} bytes; {}", path.display(), subject.file, subject.relief)]
    TooLong {
        /// The file.
        path: PathBuf,
        /// What it should be.
        subject: Subject,
    },
    /// It is not TOML.
    #[error("{}:{line}:{column}: this is not TOML ({message}); correct it", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// What the parser says.
        message: String,
    },
    /// What it says cannot be.
    #[error("{}:{line}:{column}: {sentence}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// Which field is wrong, why, and what to do.
        sentence: String,
    },
}

impl Subject {
    /// The text of a file.
    ///
    /// # Errors
    /// Where it cannot be had.
    pub fn load(&self, path: &Path) -> Result<String, TomlFileError> {
        let unreadable = |reason| TomlFileError::Unreadable {
            path: path.to_path_buf(),
            file: self.file,
            reason,
        };
        let file = File::open(path).map_err(unreadable)?;
        let mut bytes = Vec::new();
        file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 > LARGEST {
            return Err(TomlFileError::TooLong {
                path: path.to_path_buf(),
                subject: *self,
            });
        }
        String::from_utf8(bytes).map_err(|_| TomlFileError::NotText {
            path: path.to_path_buf(),
            file: self.file,
        })
    }

    /// What a text says, read by `read`; `path` is what errors call it.
    ///
    /// # Errors
    /// Where it is not TOML, or `read` finds fault with it.
    pub(crate) fn parse<T>(
        &self,
        text: &str,
        path: &Path,
        read: impl FnOnce(&Document<'_>) -> Result<T, Fault>,
    ) -> Result<T, TomlFileError> {
        let document = Document::parse(text).map_err(|(position, message)| TomlFileError::Syntax {
            path: path.to_path_buf(),
            line: position.line,
            column: position.column,
            message,
        })?;
        read(&document).map_err(|mut fault| {
            let position = document.locate(&mut fault);
            TomlFileError::Content {
                path: path.to_path_buf(),
                line: position.line,
                column: position.column,
                sentence: fault.sentence(self),
            }
        })
    }
}
