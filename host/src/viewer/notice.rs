//! What the threads tell the window.

use super::accident::Accident;
use super::given::Unsettable;
use super::loader::{Arrival, Refusal};
use super::oracle::Findings;
use super::panel::Inventory;
use super::sight::Told;
use crate::backend::BackendError;
use crate::backend::gpu::{Gpu, GpuPicture, Kernel};
use crate::output::OutputError;
use crate::picture::Picture;
use crate::scene::SceneError;
use crate::source::SourceError;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use winit::event_loop::EventLoopProxy;

/// News from a thread.
#[derive(Debug)]
pub enum Notice {
    /// How far a load is.
    Loading {
        /// Number of the load.
        load: u64,
        /// "reading", "building".
        stage: &'static str,
        /// Of the stage, 0 to 1.
        fraction: f32,
    },
    /// A scene is there, or cannot be had.
    Loaded {
        /// Number of the load.
        load: u64,
        /// What came of it.
        result: Result<Box<Arrival>, Refusal>,
    },
    /// What a scene that is there consists of.
    Counted {
        /// Number of its load.
        load: u64,
        /// Figures.
        inventory: Inventory,
    },
    /// The person has chosen files, or none; nobody was there to ask where there is no list at all.
    Chosen {
        /// The files.
        paths: Option<Vec<PathBuf>>,
        /// Whether they are to be beside what is shown.
        beside: bool,
    },
    /// A file of what is shown was saved.
    Changed,
    /// The GPU is open, or cannot be.
    GpuOpened(Result<OpenGpu, BackendError>),
    /// The file of the kernel was saved.
    KernelChanged,
    /// The kernel of the file runs on this GPU, or cannot.
    KernelSwapped(Result<(Arc<Kernel>, OpenGpu), BackendError>),
    /// A picture, or a better one.
    Rendered(Rendered),
    /// A pass is done: so many of the wanted samples are taken.
    Refined {
        /// Samples of each pixel so far.
        samples: u32,
        /// Camera rays of the pass.
        rays: u64,
        /// Time of the pass.
        milliseconds: f64,
    },
    /// What rays a camera ray of the finished picture leads to, in the mean.
    RaysCounted {
        /// Rays that ask for their closest hit, itself among them.
        closest: f64,
        /// Rays that ask whether a light is seen.
        shadow: f64,
    },
    /// What was to be shown is over, because it is done or was cancelled, or because the back end failed.
    Finished(Result<(), RenderError>),
    /// In what the picture that is shown disagrees with the oracle, as far as it is compared, or why that cannot be told.
    Compared {
        /// Number of the comparison.
        number: u64,
        /// What came of it.
        result: Result<Arc<Findings>, String>,
    },
    /// What was found out about the work behind the picture.
    Told {
        /// Who found it out.
        desk: usize,
        /// Number of the question.
        number: u64,
        /// What.
        told: Told,
    },
    /// How far a picture is that is to be written.
    Saving {
        /// The file.
        path: PathBuf,
        /// 0 to 1.
        fraction: f32,
    },
    /// A picture was written, or could not be.
    Saved(Result<PathBuf, SaveError>),
}

/// An open device, wrapped to be printable.
#[derive(Clone)]
pub struct OpenGpu(pub Arc<Gpu>);

impl std::fmt::Debug for OpenGpu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.name)
    }
}

/// A picture to show.
#[derive(Debug)]
pub struct Rendered {
    /// Number of the picture.
    pub number: u64,
    /// Where it lies.
    pub image: Image,
    /// Whether it is two, the left eye's above the right eye's.
    pub is_stacked: bool,
    /// Samples of each of its pixels.
    pub samples: u32,
    /// Whether it is all that is wanted.
    pub complete: bool,
}

/// A picture, in the memory of who rendered it.
#[derive(Clone)]
pub enum Image {
    /// In the computer's.
    Cpu(Arc<Picture>),
    /// In the GPU's.
    Gpu(Arc<GpuPicture>),
}

impl Image {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        match self {
            Image::Cpu(picture) => [picture.width, picture.height],
            Image::Gpu(picture) => [picture.width, picture.height],
        }
    }

    /// Whether both are the same memory.
    pub fn is_same(&self, other: &Image) -> bool {
        match (self, other) {
            (Image::Cpu(one), Image::Cpu(other)) => Arc::ptr_eq(one, other),
            (Image::Gpu(one), Image::Gpu(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let kind = match self {
            Image::Cpu(_) => "CPU",
            Image::Gpu(_) => "GPU",
        };
        write!(f, "{kind} {:?}", self.size())
    }
}

/// Why there is nothing to show.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// There is nothing in it to see.
    #[error("{name}: {source}")]
    Scene {
        /// Where it came from.
        name: String,
        /// What is missing.
        source: SceneError,
    },
    /// What is set does not go with it.
    #[error(transparent)]
    Unsettable(#[from] Unsettable),
    /// Reading it panicked.
    #[error("{name}: this could not be read by a mistake in oktant ({accident}); please report it, with the file.")]
    Accident {
        /// Where it came from.
        name: String,
        /// What the panic says.
        accident: Accident,
    },
}

/// Why there is no picture to show.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The GPU failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// The CPU panicked.
    #[error(
        "The picture could not be rendered by a mistake in oktant ({0}); please report it, with the scene's files."
    )]
    Accident(Accident),
}

/// Why a picture was not saved.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// It cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// It cannot be rendered.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// Rendering or writing it panicked.
    #[error("The picture could not be saved by a mistake in oktant ({0}); please report it, with the scene's files.")]
    Accident(Accident),
}

/// The way to the window, for any number of threads.
#[derive(Clone)]
pub struct Mailbox(Arc<Mutex<EventLoopProxy<Notice>>>);

impl Mailbox {
    /// The mailbox of an event loop.
    pub fn new(proxy: EventLoopProxy<Notice>) -> Self {
        Mailbox(Arc::new(Mutex::new(proxy)))
    }

    /// Leaves a notice and wakes the window; nobody cares for it once the window is closed.
    pub fn send(&self, notice: Notice) {
        let proxy = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        drop(proxy.send_event(notice));
    }
}
