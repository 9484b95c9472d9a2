//! Scene files: TOML that a person can write by hand. docs/scene-files.md describes every field.

mod assembly;
pub(crate) mod camera;
mod checkerboard;
mod color;
mod cuboid;
mod description;
mod deserializer;
pub(crate) mod document;
mod environment;
pub(crate) mod fault;
mod folder;
mod lathe;
mod light;
mod material;
mod mesh;
pub(crate) mod number;
pub(crate) mod place;
mod plane;
mod quad;
mod render;
mod sphere;
mod stereo;
mod texture;
pub(crate) mod vector;

pub(crate) use color::{Radiance, Reflectance};
pub(crate) use number::{
    Amount, Degrees, Depth, Elevation, Exponent, FieldOfView, Height, Ior, Length, Part, Priority, Quantity, Steps,
    Stops, Tolerance,
};

use crate::build_error::BuildError;
use crate::mesh::MOST;
use crate::progress::Progress;
use crate::scene::SceneError;
use crate::source::Setting;
use crate::toml_file::{Subject, TomlFileError};
use description::Description;
use folder::Folder;
use std::path::{Path, PathBuf};

/// What such a file describes.
const SUBJECT: Subject = Subject {
    file: "scene file",
    whole: "the scene",
    relief: "put large meshes into PLY files",
    top_fields: &["up", "ambient"],
};

/// Why a scene file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SceneFileError {
    /// It cannot be read, or what it says cannot be.
    #[error(transparent)]
    File(#[from] TomlFileError),
    /// There is nothing in it that a ray can meet.
    #[error(
        "{}: no triangle of the scene has an area, so there is nothing to see; add a shape or a mesh that has one",
        .0.display()
    )]
    NoArea(PathBuf),
    /// It is too small or too large to be traced.
    #[error("{}: {error}", path.display())]
    Build {
        /// The scene file.
        path: PathBuf,
        /// What is wrong.
        error: SceneError,
    },
}

impl SceneFileError {
    /// Why the scene that a file describes cannot be built.
    pub fn of_build(path: &Path, error: SceneError) -> Self {
        let path = path.to_path_buf();
        match error {
            SceneError::Build(BuildError::NoArea) => SceneFileError::NoArea(path),
            error => SceneFileError::Build { path, error },
        }
    }
}

/// Reads a scene file and everything that it refers to; `progress` hears of the meshes. Paths in it are relative to the
/// file.
///
/// # Errors
/// Says in one sentence what is wrong first, where, and what to do.
pub fn read(path: &Path, progress: Progress<'_>) -> Result<Setting, SceneFileError> {
    let text = SUBJECT.load(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut setting = of_text(&text, path, Folder(Some(folder)), MOST, progress)?;
    setting.files.insert(0, path.to_path_buf());
    Ok(setting)
}

/// Reads a scene that is in memory; `name` is what errors call it. It may have at most so many triangles, and so many
/// vertices, and refers to no files.
///
/// # Errors
/// As [`read`].
pub fn parse(text: &str, name: &Path, most: usize, progress: Progress<'_>) -> Result<Setting, SceneFileError> {
    of_text(text, name, Folder(None), most, progress)
}

fn of_text(
    text: &str,
    path: &Path,
    folder: Folder<'_>,
    most: usize,
    progress: Progress<'_>,
) -> Result<Setting, SceneFileError> {
    let setting = SUBJECT.parse(text, path, |document| {
        let description = document.deserialize::<Description>()?;
        assembly::assemble(&description, folder, most, progress)
    })?;
    Ok(setting)
}
