//! Reading a scene and building its structure beside the window.

use super::accident::caught;
use super::given::GivenSetting;
use super::mentioned::mentioned;
use super::notice::{LoadError, Mailbox, Notice};
use super::panel::Inventory;
use super::throttle::Throttle;
use super::warnings::overheard;
use super::watcher::Stamps;
use crate::model::Focus;
use crate::names::Names;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::source::Source;
use crate::structure::StructureOptions;
use crate::view::View;
use glam::DVec3;
use std::sync::Arc;
use std::thread;
use std::time::SystemTime;

/// A scene that was loaded, and what came with it.
#[derive(Debug)]
pub struct Arrival {
    /// What there is to see.
    pub scene: Arc<Scene>,
    /// From where, and how.
    pub view: View,
    /// What is looked at, where the source says so.
    pub focus: Option<Focus>,
    /// What the mesh was moved by: see [`crate::mesh::Mesh::shift`].
    pub shift: DVec3,
    /// What its file calls its parts.
    pub names: Names,
    /// Size of the picture in pixels, where the source says so.
    pub size: Option<[u32; 2]>,
    /// The files that were read.
    pub stamps: Stamps,
    /// What was left out or missing.
    pub warnings: Vec<String>,
}

/// A scene that was not.
#[derive(Debug)]
pub struct Refusal {
    /// Why.
    pub error: LoadError,
    /// The files that it may have been because of.
    pub stamps: Stamps,
}

/// Begins to load a source in which `set` is set; the mailbox learns how far it is, and gets the scene. `load` is the number
/// under which it does.
pub fn load(load: u64, source: Source, set: Vec<GivenSetting>, structure: StructureOptions, mailbox: &Mailbox) {
    let mailbox = mailbox.clone();
    thread::spawn(move || {
        let throttle = Throttle::new();
        let progress = |stage, fraction| {
            if throttle.is_due() {
                mailbox.send(Notice::Loading { load, stage, fraction });
            }
        };
        let began = SystemTime::now();
        let result = caught(|| arrive(&source, &set, &structure, began, &progress)).unwrap_or_else(|accident| {
            Err(LoadError::Accident {
                name: source.to_string(),
                accident,
            })
        });
        let result = result.map_err(|error| Refusal {
            error,
            stamps: Stamps::new(mentioned(&source), began),
        });
        let scene = result.as_ref().ok().map(|arrival| arrival.scene.clone());
        mailbox.send(Notice::Loaded { load, result });
        // It is shown already while it is counted.
        if let Some(scene) = scene {
            let inventory = Inventory::of(&scene);
            mailbox.send(Notice::Counted { load, inventory });
        }
    });
}

fn arrive(
    source: &Source,
    set: &[GivenSetting],
    structure: &StructureOptions,
    began: SystemTime,
    progress: Progress<'_>,
) -> Result<Box<Arrival>, LoadError> {
    let (setting, warnings) = overheard(|| source.load(progress));
    let mut setting = setting?;
    GivenSetting::put_all(set, &mut setting)?;
    let stamps = Stamps::new(setting.files, began);
    let (focus, shift) = (setting.model.focus, setting.model.mesh.shift);
    let scene = Scene::of_model(setting.model, structure, progress).map_err(|error| LoadError::Scene {
        name: source.to_string(),
        source: error,
    })?;
    Ok(Box::new(Arrival {
        scene: Arc::new(scene),
        view: setting.view,
        focus,
        shift,
        names: setting.names,
        size: setting.size,
        stamps,
        warnings,
    }))
}
