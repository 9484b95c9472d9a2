//! Scene files: TOML that a person can write by hand. docs/scene-files.md describes every field.

mod assembly;
mod camera;
mod checkerboard;
mod color;
mod cuboid;
mod description;
mod deserializer;
mod document;
mod environment;
mod fault;
mod folder;
mod lathe;
mod light;
mod material;
mod mesh;
mod number;
mod place;
mod plane;
mod quad;
mod render;
mod sphere;
mod stereo;
mod texture;
mod vector;

use crate::build_error::BuildError;
use crate::progress::Progress;
use crate::scene::SceneError;
use crate::source::Setting;
use assembly::MOST;
use description::Description;
use document::Document;
use folder::Folder;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Scene files are not larger than this, bytes.
const LARGEST: u64 = 16 << 20;

/// Why a scene file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SceneFileError {
    /// The system does not give it.
    #[error("{}: the scene file cannot be read ({reason}); check the path", path.display())]
    Unreadable {
        /// The scene file.
        path: PathBuf,
        /// What the system says.
        reason: io::Error,
    },
    /// It is no text.
    #[error("{}: this is no text in UTF-8; give a scene file", .0.display())]
    NotText(PathBuf),
    /// It is too long for something that a person wrote.
    #[error("{}: a scene file has at most {LARGEST} bytes; put large meshes into PLY files", .0.display())]
    TooLong(PathBuf),
    /// It is not TOML.
    #[error("{}:{line}:{column}: this is not TOML ({message}); correct it", path.display())]
    Syntax {
        /// The scene file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// What the parser says.
        message: String,
    },
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
    /// What it says cannot be.
    #[error("{}:{line}:{column}: {sentence}", path.display())]
    Content {
        /// The scene file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// Which field is wrong, why, and what to do.
        sentence: String,
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
    let text = load(path)?;
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
    let document = Document::parse(text).map_err(|(position, message)| SceneFileError::Syntax {
        path: path.to_path_buf(),
        line: position.line,
        column: position.column,
        message,
    })?;
    let setting = document
        .deserialize::<Description>()
        .and_then(|description| assembly::assemble(&description, folder, most, progress));
    setting.map_err(|mut fault| {
        let position = document.locate(&mut fault);
        SceneFileError::Content {
            path: path.to_path_buf(),
            line: position.line,
            column: position.column,
            sentence: fault.to_string(),
        }
    })
}

fn load(path: &Path) -> Result<String, SceneFileError> {
    let unreadable = |reason| SceneFileError::Unreadable {
        path: path.to_path_buf(),
        reason,
    };
    let file = File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST {
        return Err(SceneFileError::TooLong(path.to_path_buf()));
    }
    String::from_utf8(bytes).map_err(|_| SceneFileError::NotText(path.to_path_buf()))
}
