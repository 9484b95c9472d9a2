//! Where the mesh comes from.

use super::Failure;
use super::arguments::MeshArguments;
use super::progress_bar::ProgressBar;
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::scene::Scene;
use std::time::{Duration, Instant};

/// A mesh with its scene, and how long both took.
pub struct Loaded {
    pub mesh: Mesh,
    pub scene: Scene,
    pub reading: Duration,
    pub building: Duration,
}

impl MeshArguments {
    /// What to load.
    pub fn source(&self) -> MeshSource {
        MeshSource::from_argument(self.mesh.as_deref())
    }

    /// Reads the mesh and builds its octree, with progress on a terminal.
    pub fn load(&self) -> Result<Loaded, Failure> {
        let bar = ProgressBar::new();
        let start = Instant::now();
        let mesh = self.source().load(&|stage, fraction| bar.show(stage, fraction))?;
        let reading = start.elapsed();
        let start = Instant::now();
        let scene = Scene::new(&mesh, &self.octree.0, &|stage, fraction| bar.show(stage, fraction))?;
        Ok(Loaded {
            mesh,
            scene,
            reading,
            building: start.elapsed(),
        })
    }
}
