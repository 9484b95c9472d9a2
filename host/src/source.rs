//! Where a scene comes from, and how it is first seen.

use crate::gathering::{self, GatheringError};
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
    /// Several meshes in one scene, as they lie.
    Several(Vec<MeshSource>),
    /// A scene file.
    Scene(PathBuf),
}

/// Why there is nothing to look at.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    /// The mesh cannot be had.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Meshes cannot be looked at together.
    #[error(transparent)]
    Gathering(#[from] GatheringError),
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

    /// What a person means who names any number of things on the command line.
    ///
    /// # Errors
    /// [`GatheringError::SceneAmong`] where one of several is a scene file.
    pub fn from_arguments(arguments: &[PathBuf]) -> Result<Self, GatheringError> {
        match arguments {
            [] => Ok(Source::default()),
            [one] => Ok(Self::from_argument(Some(one))),
            several => Self::together(several.iter().map(|argument| Self::from_argument(Some(argument)))),
        }
    }

    /// What files hold, by their names.
    ///
    /// # Errors
    /// [`GatheringError::SceneAmong`] where one of several is a scene file.
    pub fn from_paths(paths: Vec<PathBuf>) -> Result<Self, GatheringError> {
        Self::together(paths.into_iter().map(Self::from_path))
    }

    /// This one, and what files hold beside it.
    ///
    /// # Errors
    /// [`GatheringError::SceneAmong`] where one of them is a scene file.
    pub fn with(&self, paths: Vec<PathBuf>) -> Result<Self, GatheringError> {
        let others = paths.into_iter().map(Self::from_path);
        Self::together(std::iter::once(self.clone()).chain(others))
    }

    /// Meshes in one scene.
    fn together(sources: impl Iterator<Item = Source>) -> Result<Self, GatheringError> {
        let sources: Vec<_> = sources.collect();
        if let [one] = sources.as_slice() {
            return Ok(one.clone());
        }
        let mut meshes = Vec::new();
        for source in sources {
            match source {
                Source::Mesh(mesh) => meshes.push(mesh),
                Source::Several(several) => meshes.extend(several),
                Source::Scene(path) => return Err(GatheringError::SceneAmong(path)),
            }
        }
        Ok(Source::Several(meshes))
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
            Source::Mesh(mesh) => mesh.load_asset(progress)?.into_setting_seen(self.first_view()),
            Source::Several(meshes) => gathering::load(meshes, progress)?.into_setting_seen(self.first_view()),
            Source::Scene(path) => scene_file::read(path, progress)?,
        })
    }

    /// The view of meshes, where their files do not say it.
    fn first_view(&self) -> View {
        let mut view = Preferences::of_process().view;
        if self.says_up() {
            view.up = Up::Y;
        }
        view
    }

    /// Whether it says itself which axis points up.
    pub fn says_up(&self) -> bool {
        let is_gltf = |mesh: &MeshSource| match mesh {
            MeshSource::File(path) => MeshFormat::of(path) == MeshFormat::Gltf,
            _ => false,
        };
        match self {
            Source::Scene(_) => true,
            Source::Mesh(mesh) => is_gltf(mesh),
            Source::Several(meshes) => meshes.iter().any(is_gltf),
        }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Source::Mesh(mesh) => mesh.fmt(f),
            Source::Several(meshes) => match meshes.as_slice() {
                [] => f.write_str("nothing"),
                [one] => one.fmt(f),
                [one, other] => write!(f, "{one} and {other}"),
                [first, others @ ..] => write!(f, "{first} and {} others", others.len()),
            },
            Source::Scene(path) => write!(f, "{}", path.display()),
        }
    }
}

/// Scene files end in `.toml`.
fn is_scene(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(names: &[&str]) -> Vec<PathBuf> {
        names.iter().map(PathBuf::from).collect()
    }

    #[test]
    fn one_is_itself_and_several_are_meshes() {
        let named = |names: &[&str]| Source::from_arguments(&paths(names));
        assert_eq!(named(&[]).unwrap(), Source::default());
        assert_eq!(named(&["a.toml"]).unwrap(), Source::Scene("a.toml".into()));
        assert_eq!(named(&["balls"]).unwrap(), Source::Mesh(MeshSource::Balls));
        let two = named(&["balls", "a.stl"]).unwrap();
        assert_eq!(two.to_string(), "balls and a.stl");
        let more = two.with(paths(&["b.obj", "c.ply"])).unwrap();
        assert_eq!(more.to_string(), "balls and 3 others");
        assert_eq!(
            Source::from_paths(paths(&["a.ply"])).unwrap(),
            Source::from_path("a.ply".into())
        );
        for refused in [
            named(&["a.ply", "b.toml"]),
            two.with(paths(&["b.toml"])),
            Source::Scene("b.toml".into()).with(paths(&["a.ply"])),
        ] {
            let sentence = refused.unwrap_err().to_string();
            assert!(sentence.starts_with("b.toml is a scene file"), "{sentence}");
        }
    }

    #[test]
    fn one_that_says_up_says_it_for_all() {
        assert!(!Source::from_paths(paths(&["a.ply", "b.stl"])).unwrap().says_up());
        assert!(Source::from_paths(paths(&["a.ply", "b.glb"])).unwrap().says_up());
    }
}
