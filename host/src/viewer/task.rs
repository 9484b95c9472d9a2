//! A picture to render, and what for.

use super::draft::Draft;
use crate::backend::gpu::Gpu;
use crate::sampling::Samples;
use crate::scene::Scene;
use crate::view::View;
use oktant_shared::frame::Frame;
use std::fmt;
use std::path::{Path, PathBuf};
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
        effort: Effort,
    },
    /// To be saved in a file, or in a folder under the next free name.
    Save(Destination),
}

/// How good a picture is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Simplified, so that it is there soon.
    Draft(Draft),
    /// As it is wanted.
    Full {
        /// Whether a picture with one sample at all pixels is to come first.
        preview: bool,
    },
}

/// Where a saved picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// Into this file.
    File(PathBuf),
    /// Into this folder, under the next free name.
    Folder(PathBuf),
}

impl Destination {
    /// The file or the folder.
    pub fn path(&self) -> &Path {
        let (Destination::File(path) | Destination::Folder(path)) = self;
        path
    }
}

impl fmt::Display for Destination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Destination::File(path) => write!(f, "{}", path.display()),
            Destination::Folder(path) => write!(f, "a picture in {}", path.display()),
        }
    }
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
        let Purpose::Show { number, effort } = task.purpose else {
            return None;
        };
        let frame = |draft: &Draft| draft.frame(&task.view, &task.scene, task.size);
        let [width, height] = task.size;
        let wanted = task.view.frame(&task.scene, width, height);
        let frames = match effort {
            Effort::Draft(draft) => vec![frame(&draft)],
            // An adaptive picture begins with one of its own.
            Effort::Full { preview: true } if task.view.samples != Samples::One && !task.view.adaptive => {
                vec![frame(&Draft::FINE), wanted]
            }
            Effort::Full { .. } => vec![wanted],
        };
        let pictures = frames.into_iter().map(|frame| (frame, frame == wanted)).collect();
        Some(Plan { number, pictures })
    }
}
