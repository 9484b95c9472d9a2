//! Opening the GPU beside the window.

use super::notice::{Mailbox, Notice, OpenGpu};
use crate::backend::gpu::{Gpu, GpuOptions};
use std::sync::Arc;
use std::thread;

/// Begins to open the GPU and to make its pipelines; the mailbox gets it.
pub fn open_gpu(options: GpuOptions, mailbox: &Mailbox) {
    let mailbox = mailbox.clone();
    thread::spawn(move || {
        let opened = Gpu::open(&options).map(|gpu| OpenGpu(Arc::new(gpu)));
        mailbox.send(Notice::GpuOpened(opened));
    });
}
