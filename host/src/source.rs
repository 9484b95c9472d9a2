//! Where a scene comes from, and how it is first seen.

use crate::mesh_format::MeshFormat;
use crate::mesh_source::{MeshError, MeshSource};
use crate::model::Model;
use crate::names::Names;
use crate::preferences::Preferences;
use crate::progress::Progress;
use crate::scene_file::{self, SceneFileError};
use crate::view::View;
use oktant_shared::orbit::Up;
use std::fmt;
use std::path::{Path, PathBuf};

/// A model, and the view that comes with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// What there is to see.
    pub model: Model,
    /// From where, and how.
    pub view: View,
    /// What its file calls its parts.
    pub names: Names,
    /// Width and height of the picture in pixels, where the scene says so.
    pub size: Option<[u32; 2]>,
    /// The files that it was read from: where one of them changes, it may look different.
    pub files: Vec<PathBuf>,
}

/// Something that can be looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A mesh, with what its file says of materials, lights and cameras.
    Mesh(MeshSource),
    /// A scene file.
    Scene(PathBuf),
}

/// Why there is nothing to look at.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    /// The mesh cannot be had.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The scene file cannot be used.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
}

impl Default for Source {
    fn default() -> Self {
        Source::Mesh(MeshSource::default())
    }
}

impl Source {
    /// What a person means who names something on the command line, or nothing.
    pub fn from_argument(argument: Option<&Path>) -> Self {
        match argument {
            Some(path) if is_scene(path) => Source::Scene(path.to_path_buf()),
            _ => Source::Mesh(MeshSource::from_argument(argument)),
        }
    }

    /// What a file holds, by its name.
    pub fn from_path(path: PathBuf) -> Self {
        if is_scene(&path) {
            Source::Scene(path)
        } else {
            Source::Mesh(MeshSource::File(path))
        }
    }

    /// Loads it.
    ///
    /// # Errors
    /// [`SourceError`].
    pub fn load(&self, progress: Progress<'_>) -> Result<Setting, SourceError> {
        Ok(match self {
            Source::Mesh(mesh) => {
                let mut view = Preferences::of_process().view;
                if self.says_up() {
                    view.up = Up::Y;
                }
                mesh.load_asset(progress)?.into_setting_seen(view)
            }
            Source::Scene(path) => scene_file::read(path, progress)?,
        })
    }

    /// Whether it says itself which axis points up.
    pub fn says_up(&self) -> bool {
        match self {
            Source::Scene(_) => true,
            Source::Mesh(MeshSource::File(path)) => MeshFormat::of(path) == MeshFormat::Gltf,
            Source::Mesh(_) => false,
        }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Source::Mesh(mesh) => mesh.fmt(f),
            Source::Scene(path) => write!(f, "{}", path.display()),
        }
    }
}

/// Scene files end in `.toml`.
fn is_scene(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}
