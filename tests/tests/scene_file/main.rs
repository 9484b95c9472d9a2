//! Scene files: those that come with oktant, broken ones and what is said about them, and what becomes of their parts.

#![cfg(test)]

mod broken;
mod content;
mod shapes;
mod shipped;

use oktant::progress::silent;
use oktant::scene_file::{self, SceneFileError};
use oktant::source::Setting;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::{TempDir, tempdir};

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The scene files of a folder, by name.
fn scenes(folder: &Path) -> Vec<PathBuf> {
    let mut scenes: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    scenes.sort();
    scenes
}

/// Reads a scene file with this content, in a folder of its own.
fn read_in(folder: &TempDir, content: &str) -> Result<Setting, SceneFileError> {
    let path = folder.path().join("scene.toml");
    fs::write(&path, content).unwrap();
    scene_file::read(&path, &silent)
}

#[track_caller]
fn read(content: &str) -> Setting {
    read_in(&tempdir().unwrap(), content).unwrap_or_else(|error| panic!("{error}"))
}
