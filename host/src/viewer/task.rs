//! A picture to render, and what for.

use super::schedule::Quality;
use crate::backend::gpu::Gpu;
use crate::sampling::Samples;
use crate::scene::Scene;
use crate::view::View;
use oktant_shared::frame::Frame;
use std::path::PathBuf;
use std::sync::Arc;

/// What renders.
#[derive(Clone)]
pub enum Engine {
    /// The CPU.
    Cpu,
    /// A GPU.
    Gpu(Arc<Gpu>),
}

/// A picture to render.
#[derive(Clone)]
pub struct Task {
    /// What with.
    pub engine: Engine,
    /// What of.
    pub scene: Arc<Scene>,
    /// From where and how.
    pub view: View,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What for.
    pub purpose: Purpose,
}

/// What a picture is for.
#[derive(Clone, Debug)]
pub enum Purpose {
    /// To be shown.
    Show {
        /// Its number.
        number: u64,
        /// How good it is to be.
        quality: Quality,
        /// Whether a picture with one sample at all pixels is to come first.
        preview: bool,
    },
    /// To be saved in a file, or in a folder under the next free name.
    Save(Destination),
}

/// Where a saved picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// Into this file.
    File(PathBuf),
    /// Into this folder, under the next free name.
    Folder(PathBuf),
}

/// Which pictures a task to show something makes, and whether each is what is wanted in the end.
pub struct Plan {
    /// Number of the picture.
    pub number: u64,
    /// Frames, each with all its samples.
    pub pictures: Vec<(Frame, bool)>,
}

impl Plan {
    /// The plan of a task; none for one that saves.
    pub fn new(task: &Task) -> Option<Self> {
        let Purpose::Show {
            number,
            quality,
            preview,
        } = task.purpose
        else {
            return None;
        };
        let [width, height] = task.size;
        let frame = |samples| View { samples, ..task.view }.frame(&task.scene, width, height);
        let mut pictures = Vec::new();
        match quality {
            Quality::Draft => pictures.push((frame(Samples::One), false)),
            Quality::Final => {
                if preview && task.view.samples != Samples::One {
                    pictures.push((frame(Samples::One), false));
                }
                pictures.push((frame(task.view.samples), true));
            }
        }
        Some(Plan { number, pictures })
    }
}
