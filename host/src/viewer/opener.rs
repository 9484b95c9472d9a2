//! Opening the GPU beside the window, and giving it another kernel.

use super::accident::caught;
use super::notice::{Mailbox, Notice, OpenGpu};
use super::presenter::Presenter;
use crate::backend::BackendError;
use crate::backend::gpu::{Gpu, GpuOptions, Kernel};
use std::path::{Path, PathBuf};
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

/// Begins to read a kernel again and to make all pipelines anew that the GPU has; the mailbox gets a GPU with them.
pub fn swap_kernel(gpu: Arc<Gpu>, path: PathBuf, mailbox: &Mailbox) {
    let mailbox = mailbox.clone();
    thread::spawn(move || {
        let swapped = caught(|| swapped(&gpu, &path)).unwrap_or_else(|accident| Err(gpu.failed_by(&accident)));
        let swapped = swapped.map(|(kernel, gpu)| (kernel, OpenGpu(Arc::new(gpu))));
        mailbox.send(Notice::KernelSwapped(swapped));
    });
}

fn swapped(gpu: &Gpu, path: &Path) -> Result<(Arc<Kernel>, Gpu), BackendError> {
    let kernel = Arc::new(Kernel::read(path)?);
    let gpu = gpu.with_kernel(kernel.clone())?;
    // What shows the picture is part of the kernel, too; the window makes its own later, in a format of its own.
    gpu.attempt(|| Presenter::new(&gpu, wgpu::TextureFormat::Rgba8UnormSrgb))?;
    Ok((kernel, gpu))
}
