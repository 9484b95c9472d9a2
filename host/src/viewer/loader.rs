//! Reading a mesh and building its octree beside the window.

use super::notice::{LoadError, Mailbox, Notice};
use crate::octree::OctreeOptions;
use crate::scene::Scene;
use crate::source::Source;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Progress is not told more often than this.
const INTERVAL: Duration = Duration::from_millis(50);

/// Begins to load a mesh; the mailbox learns how far it is, and gets the scene. `load` is the number under which it does.
pub fn load(load: u64, source: Source, octree: OctreeOptions, mailbox: &Mailbox) {
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
        let load_scene = || -> Result<_, LoadError> {
            let setting = source.load(&progress)?;
            let scene = Scene::of_model(setting.model, &octree, &progress).map_err(|error| LoadError::Scene {
                name: source.to_string(),
                source: error,
            })?;
            Ok((Arc::new(scene), setting.view))
        };
        let result = load_scene();
        mailbox.send(Notice::Loaded { load, result });
    });
}
