//! Where the files lie that a scene names.

use super::fault::{Fault, Reason};
use super::place::Place;
use std::path::{Path, PathBuf};

/// The folder of a scene file; none of a scene that is in memory only.
#[derive(Clone, Copy)]
pub struct Folder<'a>(pub Option<&'a Path>);

impl Folder<'_> {
    /// The path of a file that the field at `place` names.
    ///
    /// # Errors
    /// Where there is no folder.
    pub fn path_of(self, file: &Path, place: &Place) -> Result<PathBuf, Fault> {
        let folder = self.0.ok_or_else(|| Fault::new(place, Reason::NoFolder))?;
        Ok(folder.join(file))
    }
}
