//! Temporary files of outputs that are not complete yet: who ends the process early removes them.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

/// Those that are there now.
static PATHS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A temporary file that is there, for as long as this value is.
#[derive(Debug)]
pub struct Unfinished(PathBuf);

impl Unfinished {
    /// Makes a temporary file, and takes note of it in the same moment.
    pub fn create(make: impl FnOnce() -> io::Result<NamedTempFile>) -> io::Result<(NamedTempFile, Self)> {
        let mut paths = paths();
        let file = make()?;
        // Relative paths mean something else once somebody changes the folder.
        let path = std::path::absolute(file.path()).unwrap_or_else(|_| file.path().to_path_buf());
        paths.insert(path.clone());
        Ok((file, Unfinished(path)))
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        paths().remove(&self.0);
    }
}

fn paths() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    PATHS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Does something, renaming files for example, that [`abandon`] waits for.
pub fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _paths = paths();
    work()
}

/// Removes the temporary files of all outputs. None is made, and none gets its name, from now on: whoever tries waits for
/// ever, so the process has to end.
pub fn abandon() {
    let paths = paths();
    remove(paths.iter().map(PathBuf::as_path));
    mem::forget(paths);
}

/// Removes files; one that is gone already is as good as removed.
fn remove<'a>(paths: impl Iterator<Item = &'a Path>) {
    for path in paths {
        drop(fs::remove_file(path));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_noted_for_as_long_as_they_are_there() {
        let folder = tempfile::tempdir().unwrap();
        let (file, noted) = Unfinished::create(|| NamedTempFile::new_in(folder.path())).unwrap();
        let path = file.path().to_path_buf();
        assert!(paths().contains(&path));
        remove([path.as_path(), &folder.path().join("missing")].into_iter());
        assert!(!path.exists());
        drop(noted);
        assert!(!paths().contains(&path));
    }
}
