//! What renders: one interface, the CPU and the GPU behind it.

pub mod cpu;
pub mod gpu;

use self::gpu::KernelError;
use crate::picture::Picture;
use crate::progress::Progress;
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::Parts;
use oktant_shared::ray::Ray;
use std::time::{Duration, Instant};

/// What is to render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BackendChoice {
    /// A real GPU if there is one, never a software adapter; else the CPU.
    #[default]
    Auto,
    /// The CPU.
    Cpu,
    /// The best GPU there is, even a software adapter.
    Gpu,
}

/// What a ray asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Query {
    /// The nearest hit.
    Closest,
    /// Whether there is a hit: triangle 0 at `t = 0` if so.
    Any,
}

/// A renderer with a scene.
pub trait Backend: Send {
    /// What it runs on, for people.
    fn name(&self) -> String;

    /// Renders all samples of a frame.
    ///
    /// # Errors
    /// [`BackendError`] where the device gives up or is too small.
    fn render(&mut self, frame: &Frame, progress: Progress<'_>) -> Result<Picture, BackendError>;

    /// What the first sample of each pixel of a frame sees, row by row from the upper left.
    ///
    /// # Errors
    /// As [`Backend::render`].
    fn hits(&mut self, frame: &Frame) -> Result<Vec<Hit>, BackendError>;

    /// Traces an array of rays; the scene's structure must be the one that the parts' traversal reads.
    ///
    /// # Errors
    /// As [`Backend::render`], and [`BackendError::Parts`] where the combination is not offered or needs another structure.
    fn cast(&mut self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, BackendError>;
}

/// Why a back end cannot do its work.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BackendError {
    /// No adapter, or none that qualifies.
    #[error("There is no GPU to use ({0}); use --backend cpu.")]
    NoAdapter(String),
    /// The adapter refused to open.
    #[error("The GPU {adapter} could not be opened ({reason}); update its driver or use --backend cpu.")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
    /// A buffer beyond the device's limits.
    #[error(
        "The {what} take {bytes} bytes and {adapter} binds at most {limit} at once; use --backend cpu, or a smaller mesh \
         or picture."
    )]
    TooLarge {
        /// Which array, in the plural.
        what: &'static str,
        /// Its size.
        bytes: u64,
        /// The largest size of a storage binding.
        limit: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// The device's memory is full.
    #[error(
        "The memory of {adapter}, which binds at most {limit} bytes at once, has no room for the {what}, {bytes} bytes; close \
         what else uses it, or use --traversal compact or --backend cpu, or a smaller mesh or picture."
    )]
    OutOfMemory {
        /// Which array, in the plural.
        what: &'static str,
        /// Its size.
        bytes: u64,
        /// The largest size of a storage binding.
        limit: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// The device is gone, with all that lay in its memory.
    #[error("The GPU {adapter} was lost ({reason}); try again, or use --backend cpu.")]
    Lost {
        /// Name of the adapter.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
    /// The kernel that was asked for cannot be run.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// The kernel that was asked for needs a GPU.
    #[error(
        "The kernel needs a GPU, and there is none to use ({0}); leave --kernel out, or take any with --backend gpu."
    )]
    KernelWithoutGpu(String),
    /// A combination of parts that there is not.
    #[error("There is no {0}; run `oktant kernels` for what is offered.")]
    Parts(Parts),
    /// Something went wrong on the device while it worked.
    #[error("The GPU {adapter} failed ({reason}); use --backend cpu.")]
    Failed {
        /// Name of the adapter.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
}

impl BackendError {
    /// What went wrong, in one sentence, where the CPU steps in.
    pub fn and_the_cpu_renders(&self) -> String {
        format!("{}: the CPU renders.", self.what())
    }

    /// Whether triangles as indices, which take less memory, may be of help.
    pub fn is_about_triangles(&self) -> bool {
        match self {
            BackendError::TooLarge { what, .. } | BackendError::OutOfMemory { what, .. } => {
                ["nodes", "references", "triangles", "triangle ids", "vertices"].contains(what)
            }
            _ => false,
        }
    }

    /// Whether pictures can be rendered that are not adaptive.
    pub fn is_about_lists(&self) -> bool {
        matches!(self, BackendError::Kernel(error) if error.is_about_lists())
    }

    /// What went wrong, without what to do.
    pub fn what(&self) -> String {
        match self {
            BackendError::NoAdapter(reason) => format!("There is no GPU to use ({reason})"),
            BackendError::NoDevice { adapter, reason } => {
                format!("The GPU {adapter} could not be opened ({reason})")
            }
            BackendError::TooLarge {
                what,
                bytes,
                limit,
                adapter,
            } => format!("The {what} take {bytes} bytes and {adapter} binds at most {limit} at once"),
            BackendError::OutOfMemory {
                what,
                bytes,
                limit,
                adapter,
            } => format!(
                "The memory of {adapter}, which binds at most {limit} bytes at once, has no room for the {what}, {bytes} bytes"
            ),
            BackendError::Lost { adapter, reason } => format!("The GPU {adapter} was lost ({reason})"),
            BackendError::Failed { adapter, reason } => format!("The GPU {adapter} failed ({reason})"),
            BackendError::Parts(parts) => format!("The GPU has no {parts}"),
            BackendError::Kernel(error) => error.to_string().trim_end_matches('.').into(),
            BackendError::KernelWithoutGpu(reason) => format!("There is no GPU for the kernel ({reason})"),
        }
    }
}

/// What takes long is not measured more often once it has taken so long altogether.
const MEASURING: Duration = Duration::from_secs(5);

/// Measures `repeats` times, or less, but once, where `limit` is over before.
fn measured(
    repeats: u32,
    limit: Duration,
    mut once: impl FnMut() -> Result<f64, BackendError>,
) -> Result<Vec<f64>, BackendError> {
    let start = Instant::now();
    let mut times = Vec::new();
    while times.len() < repeats as usize && (times.is_empty() || start.elapsed() < limit) {
        times.push(once()?);
    }
    Ok(times)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measuring_ends_after_the_repeats_or_when_its_time_is_over() {
        let mut calls = 0;
        let mut once = || {
            calls += 1;
            Ok(f64::from(calls))
        };
        let long = Duration::from_secs(3600);
        assert_eq!(measured(3, long, &mut once), Ok(vec![1.0, 2.0, 3.0]));
        assert_eq!(measured(3, Duration::ZERO, &mut once), Ok(vec![4.0]));
        assert_eq!(measured(0, long, &mut once), Ok(vec![]));
        let failed = || Err(BackendError::Parts(Parts::default()));
        assert!(measured(3, long, failed).is_err());
    }
}
