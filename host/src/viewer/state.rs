//! What the window remembers about the work of others.

use super::draft::Draft;
use crate::backend::gpu::Gpu;
use crate::source::Source;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// What the renderer shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Nothing.
    Idle,
    /// A picture for the window.
    Show {
        /// How it is simplified.
        draft: Draft,
        /// Whether the GPU renders it.
        on_gpu: bool,
    },
}

/// A picture on its way into a file.
#[derive(Clone, Debug)]
pub struct SaveProgress {
    /// The file, or the folder as long as it has no name.
    pub path: PathBuf,
    /// How far it is, 0 to 1.
    pub fraction: f32,
}

/// A scene on its way.
#[derive(Clone, Debug)]
pub struct Loading {
    pub source: Source,
    pub stage: &'static str,
    pub fraction: f32,
    /// Whether it is what is shown already, read again.
    pub is_reload: bool,
    /// Whether it is what is shown already, and something beside it.
    pub is_addition: bool,
}

/// A sentence for the person.
#[derive(Clone, Debug)]
pub struct Message {
    pub text: String,
    pub is_warning: bool,
    pub about: About,
    pub until: Instant,
}

/// What a message is about: done at last, it makes what is said of its failure untrue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// A file that was to be shown.
    Load,
    /// What is shown, which was to be read again.
    Reload,
    /// A step that was typed.
    Step,
    /// Anything else, which stays true.
    Other,
}

/// What is known of the GPU.
pub enum GpuState {
    /// Nobody has opened it, or that went wrong.
    Closed,
    /// It is being opened; the viewer ends if that fails and it was asked for on the command line.
    Opening {
        /// Whether it was.
        is_required: bool,
    },
    /// It can be used.
    Open(Arc<Gpu>),
}
