//! Reading a mesh and building its octree beside the window.

use super::notice::{Mailbox, MeshError, Notice};
use crate::mesh_source::MeshSource;
use crate::octree::OctreeOptions;
use crate::scene::Scene;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Progress is not told more often than this.
const INTERVAL: Duration = Duration::from_millis(50);

/// Begins to load a mesh; the mailbox learns how far it is, and gets the scene. `load` is the number under which it does.
pub fn load(load: u64, source: MeshSource, octree: OctreeOptions, mailbox: &Mailbox) {
    let mailbox = mailbox.clone();
    thread::spawn(move || {
        let last = Mutex::new(Instant::now());
        let progress = |stage, fraction| {
            let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
            if last.elapsed() >= INTERVAL {
                *last = Instant::now();
                mailbox.send(Notice::Loading { load, stage, fraction });
            }
        };
        let scene = || -> Result<Scene, MeshError> {
            let mesh = source.load(&progress)?;
            Scene::new(&mesh, &octree, &progress).map_err(|error| MeshError::Scene {
                name: source.to_string(),
                source: error,
            })
        };
        let result = scene().map(Arc::new);
        mailbox.send(Notice::Loaded { load, result });
    });
}
