//! Where the scene comes from.

use super::Failure;
use super::arguments::{MeshArguments, StructureArguments};
use super::progress_bar::ProgressBar;
use glam::DVec3;
use oktant::scene::{Scene, SceneError};
use oktant::scene_file::SceneFileError;
use oktant::source::Source;
use oktant::view::View;
use oktant::viewer::{GivenSetting, Unsettable};
use oktant_shared::parts::TraversalKind;
use std::time::{Duration, Instant};

/// A scene with its view, figures of its mesh, and how long everything took.
pub struct Loaded {
    pub scene: Scene,
    pub view: View,
    pub size: Option<[u32; 2]>,
    pub triangles: usize,
    pub vertices: usize,
    pub shift: DVec3,
    pub reading: Duration,
    pub building: Duration,
}

/// Why what a source holds cannot be rendered.
pub fn refused(source: Source, error: SceneError) -> Failure {
    match source {
        Source::Mesh(_) | Source::Several(_) => Failure::from(error),
        Source::Scene(path) => SceneFileError::of_build(&path, error).into(),
    }
}

/// What is given does not go with what was loaded.
pub fn unsettable(error: Unsettable) -> Failure {
    Failure::usage(error.to_string())
}

impl MeshArguments {
    /// What to load.
    ///
    /// # Errors
    /// A scene file among several.
    pub fn source(&self) -> Result<Source, Failure> {
        Source::from_arguments(&self.meshes).map_err(|error| Failure::usage(error.to_string()))
    }

    /// The same, to be built with triangles as indices.
    pub fn compact(&self) -> Self {
        MeshArguments {
            meshes: self.meshes.clone(),
            structure: StructureArguments {
                traversal: TraversalKind::Compact,
                ..self.structure.clone()
            },
        }
    }

    /// Reads the scene, sets what is given of it, and builds its structure, with progress on a terminal.
    pub fn load(&self, set: &[GivenSetting]) -> Result<Loaded, Failure> {
        // First of all, so that nobody waits for a mesh that is not built upon.
        let options = self.structure.options()?;
        let bar = ProgressBar::new();
        let start = Instant::now();
        let source = self.source()?;
        let mut setting = source.load(&|stage, fraction| bar.show(stage, fraction))?;
        GivenSetting::put_all(set, &mut setting).map_err(unsettable)?;
        let reading = start.elapsed();
        let start = Instant::now();
        let mesh = &setting.model.mesh;
        let (triangles, vertices) = (mesh.triangles.len(), mesh.positions.len());
        let shift = mesh.shift;
        let scene = Scene::of_model(setting.model, &options, &|stage, fraction| bar.show(stage, fraction))
            .map_err(|error| refused(source, error))?;
        let building = start.elapsed();
        tracing::info!(
            "read in {:.3} s, built in {:.3} s",
            reading.as_secs_f64(),
            building.as_secs_f64()
        );
        Ok(Loaded {
            scene,
            view: setting.view,
            size: setting.size,
            triangles,
            vertices,
            shift,
            reading,
            building,
        })
    }
}
