//! The file of the kernel, which is read again when it is saved.

use super::application::Application;
use super::notice::{Mailbox, Notice, OpenGpu};
use super::opener::swap_kernel;
use super::state::GpuState;
use super::watcher::{Stamps, Watcher};
use crate::backend::BackendError;
use crate::backend::gpu::Kernel;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Instant, SystemTime};

/// A kernel from a file, and what is under way with it.
pub struct KernelFile {
    path: PathBuf,
    /// The last one that was good.
    pub kernel: Arc<Kernel>,
    /// Whether it is being read and made into pipelines.
    is_loading: bool,
    /// Whether it was saved since that began.
    is_stale: bool,
    /// Sees to the notices as long as it is there.
    _watcher: Watcher,
}

impl KernelFile {
    /// Reads the kernel; the mailbox gets a [`Notice::KernelChanged`] whenever it or its manifest was saved.
    ///
    /// # Errors
    /// [`BackendError::Kernel`].
    pub fn open(path: PathBuf, mailbox: &Mailbox) -> Result<Self, BackendError> {
        let began = SystemTime::now();
        let kernel = Arc::new(Kernel::read(&path)?);
        let watcher = Watcher::start(mailbox.clone(), || Notice::KernelChanged);
        watcher.watch(Stamps::new(Kernel::files(&path), began));
        Ok(KernelFile {
            path,
            kernel,
            is_loading: false,
            is_stale: false,
            _watcher: watcher,
        })
    }

    /// Whether what runs is not, or may not be, what is in the file.
    pub fn is_under_way(&self) -> bool {
        self.is_loading || self.is_stale
    }
}

impl Application {
    /// Reads the kernel again: its file was saved.
    pub(super) fn reload_kernel(&mut self) {
        if let Some(file) = &mut self.kernel {
            file.is_stale = true;
        }
        self.reload_stale_kernel();
    }

    /// Reads the kernel again if it was saved and nothing stands in the way.
    pub(super) fn reload_stale_kernel(&mut self) {
        let Some(file) = self.kernel.as_mut().filter(|file| file.is_stale && !file.is_loading) else {
            return;
        };
        match &self.gpu {
            // It comes back when that is done.
            GpuState::Opening { .. } => {}
            GpuState::Open(gpu) => {
                (file.is_stale, file.is_loading) = (false, true);
                swap_kernel(gpu.clone(), file.path.clone(), &self.mailbox);
            }
            // The last one may have been why.
            GpuState::Closed => {
                file.is_stale = false;
                self.reloads += 1;
                match Kernel::read(&file.path) {
                    Ok(kernel) => {
                        file.kernel = Arc::new(kernel);
                        self.open_gpu(true, false);
                    }
                    Err(error) => self.tell(error.to_string(), true),
                }
            }
        }
    }

    /// Goes on with another kernel, or with the old one where there is something wrong with it.
    pub(super) fn take_kernel(&mut self, result: Result<(Arc<Kernel>, OpenGpu), BackendError>, now: Instant) {
        let Some(file) = &mut self.kernel else { return };
        file.is_loading = false;
        self.reloads += 1;
        match result {
            Ok((kernel, gpu)) => {
                let sentence = format!("{}: the kernel was read again.", file.path.display());
                file.kernel = kernel;
                // What failed meanwhile stays closed until somebody opens it.
                if let GpuState::Open(old) = &mut self.gpu {
                    *old = gpu.0;
                    if self.wants_gpu {
                        self.schedule.change(now);
                    }
                    self.tell(sentence, false);
                }
            }
            Err(error) => {
                let sentence = error.to_string();
                self.tell(
                    format!("{}; the old kernel goes on.", sentence.trim_end_matches('.')),
                    true,
                );
            }
        }
        self.reload_stale_kernel();
    }
}
