//! Opening the GPU beside the window.

use super::accident::caught;
use super::notice::{Mailbox, Notice, OpenGpu};
use crate::backend::BackendError;
use crate::backend::gpu::{Gpu, GpuOptions};
use std::sync::Arc;
use std::thread;

/// Begins to open the GPU and to make its pipelines; the mailbox gets it.
pub fn open_gpu(options: GpuOptions, mailbox: &Mailbox) {
    let mailbox = mailbox.clone();
    thread::spawn(move || {
        let opened = caught(|| Gpu::open(&options)).unwrap_or_else(|accident| {
            Err(BackendError::NoAdapter(format!(
                "it could not be opened by a mistake in oktant or its driver: {accident}; please report it"
            )))
        });
        let opened = opened.map(|gpu| OpenGpu(Arc::new(gpu)));
        mailbox.send(Notice::GpuOpened(opened));
    });
}
