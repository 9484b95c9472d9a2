//! What becomes of the window when the GPU gives up.

use super::application::Application;
use super::screen::ScreenError;
use super::state::GpuState;
use crate::backend::BackendError;
use oktant_shared::parts::Parts;
use std::time::Instant;

/// What was done for the GPU so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Recovery {
    /// Whether it was lost, and opened again.
    is_reopened: bool,
    /// The load whose triangles are too large for it.
    too_large: Option<u64>,
}

impl Recovery {
    /// Whether the GPU can have the triangles of a load, as far as is known.
    pub fn fits(&self, load: u64) -> bool {
        self.too_large != Some(load)
    }
}

impl Application {
    /// Opens a lost GPU again, once; builds a structure that takes less memory, where that may help; gives all pixels as many
    /// samples, where its kernel cannot choose; else goes on with the CPU.
    pub(super) fn gpu_gave_up(&mut self, error: &BackendError, now: Instant) {
        match error {
            BackendError::Lost { .. } if self.is_gpu_sound() => {
                // It was opened again already: whoever tells this worked on the old one.
                self.schedule.change(now);
            }
            BackendError::Lost { .. } if !self.recovery.is_reopened => {
                self.recovery.is_reopened = true;
                let sentence = format!("{}: it is opened again, and the CPU renders until then.", error.what());
                self.gpu_failed(sentence, now);
                self.open_gpu(self.takes_software, false);
            }
            _ if error.is_about_triangles() && self.session.structure.parts == Parts::STANDARD => {
                self.session.structure.parts = Parts::COMPACT;
                self.recovery.too_large = Some(self.shown_load);
                let sentence = format!(
                    "{}: the structure is built anew with triangles as indices, and the CPU renders until then.",
                    error.what()
                );
                self.tell(sentence, true);
                self.reload();
            }
            _ if error.is_about_lists() => {
                self.session.view.adaptive = false;
                let sentence = format!(
                    "{}: the GPU goes on with samples {} until adaptive ones are chosen again.",
                    error.what(),
                    self.session.view.samples.count()
                );
                self.tell(sentence, true);
                self.schedule.change(now);
            }
            _ => self.gpu_failed(error.and_the_cpu_renders(), now),
        }
    }

    /// The same, of what draws the window.
    pub(super) fn screen_gave_up(&mut self, error: ScreenError, now: Instant) {
        match error {
            ScreenError::Backend(error) => self.gpu_gave_up(&error, now),
            error @ ScreenError::Surface(_) => self.gpu_failed(error.to_string(), now),
            error @ ScreenError::Software(_) => self.fail(error),
        }
    }

    /// Whether a GPU is open that was not lost, or is being opened.
    fn is_gpu_sound(&self) -> bool {
        match &self.gpu {
            GpuState::Open(gpu) => gpu.check().is_ok(),
            GpuState::Opening { .. } => true,
            GpuState::Closed => false,
        }
    }
}
