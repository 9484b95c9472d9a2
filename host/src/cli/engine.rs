//! Choosing what renders.

use super::Failure;
use super::arguments::EngineArguments;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions};
use oktant::backend::{Backend, BackendChoice, BackendError};
use oktant::scene::Scene;
use oktant_shared::frame::Frame;
use std::sync::Arc;
use std::time::Instant;

/// A back end with a scene.
pub enum Engine {
    Cpu(Cpu),
    Gpu(GpuBackend),
}

impl Engine {
    /// The back end that the arguments choose. `auto` says why where it does not take a GPU.
    pub fn new(arguments: &EngineArguments, scene: &Arc<Scene>) -> Result<Self, Failure> {
        let cpu = || Engine::Cpu(Cpu::new(scene.clone()));
        let gpu = |software| -> Result<Engine, BackendError> {
            let gpu = Gpu::open(&GpuOptions {
                software,
                module: arguments.module(),
            })?;
            Ok(Engine::Gpu(GpuBackend::new(Arc::new(gpu), scene)?))
        };
        match arguments.choice() {
            BackendChoice::Cpu => Ok(cpu()),
            BackendChoice::Gpu => Ok(gpu(true)?),
            BackendChoice::Auto => Ok(gpu(false).unwrap_or_else(|error| {
                eprintln!("{}", error.and_the_cpu_renders());
                cpu()
            })),
        }
    }

    pub fn as_backend(&mut self) -> &mut dyn Backend {
        match self {
            Engine::Cpu(cpu) => cpu,
            Engine::Gpu(gpu) => gpu,
        }
    }

    /// Milliseconds that the kernel takes for a frame, several times over: by the GPU's clock, or by the wall's.
    pub fn time_render(&mut self, frame: &Frame, repeats: u32) -> Result<Vec<f64>, BackendError> {
        match self {
            Engine::Gpu(gpu) => gpu.time_render(frame, repeats),
            Engine::Cpu(cpu) => (0..repeats)
                .map(|_| {
                    let start = Instant::now();
                    cpu.render(frame, &oktant::progress::silent)?;
                    Ok(start.elapsed().as_secs_f64() * 1e3)
                })
                .collect(),
        }
    }
}
