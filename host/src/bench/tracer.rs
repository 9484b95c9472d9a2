//! Who traces and renders, and how long that takes.

use crate::backend::cpu::Cpu;
use crate::backend::gpu::{Gpu, GpuBackend};
use crate::backend::{Backend, BackendError, Query};
use crate::picture::Picture;
use crate::progress::silent;
use crate::scene::Scene;
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::Parts;
use oktant_shared::ray::Ray;
use std::sync::Arc;
use std::time::Instant;

/// Where scenes are traced.
#[derive(Clone)]
pub enum Device {
    /// On all threads of rayon's pool.
    Cpu,
    /// On a GPU that is open.
    Gpu(Arc<Gpu>),
}

/// A back end with a scene.
pub enum Tracer {
    /// The CPU.
    Cpu(Cpu),
    /// A GPU.
    Gpu(GpuBackend),
}

/// lavapipe leaves all loops of an invocation when they have taken 65,535 turns together, without a word: so many triangles are
/// tested before, with the turns that reading them in tiles takes.
const SOFTWARE_TRIANGLES: usize = 50_000;

impl Device {
    /// What it is, for people.
    pub fn name(&self) -> String {
        match self {
            Device::Cpu => format!("CPU, {} threads", rayon::current_num_threads()),
            Device::Gpu(gpu) => gpu.name.clone(),
        }
    }

    /// How many triangles brute force can test for a ray.
    pub fn most_brute(&self) -> usize {
        match self {
            Device::Gpu(gpu) if gpu.is_software() => SOFTWARE_TRIANGLES,
            _ => usize::MAX,
        }
    }

    /// Takes a scene there.
    ///
    /// # Errors
    /// As [`GpuBackend::new`].
    pub fn with(&self, scene: &Arc<Scene>) -> Result<Tracer, BackendError> {
        match self {
            Device::Cpu => Ok(Tracer::Cpu(Cpu::new(scene.clone()))),
            Device::Gpu(gpu) => GpuBackend::new(gpu.clone(), scene).map(Tracer::Gpu),
        }
    }
}

impl Tracer {
    /// As [`Backend::cast`].
    ///
    /// # Errors
    /// As there.
    pub fn cast(&mut self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, BackendError> {
        match self {
            Tracer::Cpu(cpu) => cpu.cast(parts, query, rays),
            Tracer::Gpu(gpu) => gpu.cast(parts, query, rays),
        }
    }

    /// As [`Backend::render`].
    ///
    /// # Errors
    /// As there.
    pub fn render(&mut self, frame: &Frame) -> Result<Picture, BackendError> {
        match self {
            Tracer::Cpu(cpu) => cpu.render(frame, &silent),
            Tracer::Gpu(gpu) => gpu.render(frame, &silent),
        }
    }

    /// Milliseconds that tracing an array of rays takes, `repeats` times over: by the wall's clock around the tracing, or
    /// by the GPU's around the kernel.
    ///
    /// # Errors
    /// As [`GpuBackend::time_cast`].
    pub fn time_cast(&self, parts: Parts, query: Query, rays: &[Ray], repeats: u32) -> Result<Vec<f64>, BackendError> {
        match self {
            Tracer::Cpu(cpu) => cpu.time_cast(parts, query, rays, repeats),
            Tracer::Gpu(gpu) => gpu.time_cast(parts, query, rays, repeats),
        }
    }

    /// Milliseconds that a frame takes, `repeats` times over, by the same clocks, after once that does not count.
    ///
    /// # Errors
    /// As [`GpuBackend::time_render`].
    pub fn time_render(&mut self, frame: &Frame, repeats: u32) -> Result<Vec<f64>, BackendError> {
        let times = match self {
            Tracer::Gpu(gpu) => gpu.time_render(frame, repeats + 1),
            Tracer::Cpu(cpu) => (0..=repeats)
                .map(|_| {
                    let start = Instant::now();
                    cpu.render(frame, &silent)?;
                    Ok(start.elapsed().as_secs_f64() * 1e3)
                })
                .collect(),
        };
        times.map(|times| times[1..].to_vec())
    }
}
