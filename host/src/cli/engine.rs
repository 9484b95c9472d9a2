//! Choosing what renders.

use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions};
use oktant::backend::{Backend, BackendChoice, BackendError, Query};
use oktant::picture::Picture;
use oktant::progress::Progress;
use oktant::scene::Scene;
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::Parts;
use oktant_shared::ray::Ray;
use std::sync::Arc;
use std::time::Instant;

/// What is to render.
#[derive(Clone, Debug, Default)]
pub struct EngineOptions {
    pub choice: BackendChoice,
    pub gpu: GpuOptions,
}

/// A back end with a scene.
pub struct Engine {
    kind: Kind,
    /// What the CPU renders should the GPU give up; none where the person asked for a certain back end.
    fallback: Option<Arc<Scene>>,
}

enum Kind {
    Cpu(Cpu),
    Gpu(GpuBackend),
}

impl Engine {
    /// The back end that the options choose. `auto` says why where it does not take a GPU; a kernel needs one.
    pub fn new(options: &EngineOptions, scene: &Arc<Scene>) -> Result<Self, BackendError> {
        let gpu = || {
            let gpu = Gpu::open(&options.gpu)?;
            GpuBackend::new(Arc::new(gpu), scene).map(Kind::Gpu)
        };
        let may_fall_back = options.choice == BackendChoice::Auto && options.gpu.kernel.is_none();
        let mut engine = Engine {
            kind: Kind::Cpu(Cpu::new(scene.clone())),
            fallback: may_fall_back.then(|| scene.clone()),
        };
        match options.choice {
            BackendChoice::Cpu => {}
            BackendChoice::Auto if may_fall_back => match gpu() {
                Ok(gpu) => engine.kind = gpu,
                Err(error) => eprintln!("{}", error.and_the_cpu_renders()),
            },
            BackendChoice::Auto | BackendChoice::Gpu => engine.kind = gpu()?,
        }
        tracing::info!("rendered by {}", engine.name());
        Ok(engine)
    }

    /// What it runs on, for people.
    pub fn name(&self) -> String {
        match &self.kind {
            Kind::Cpu(cpu) => cpu.name(),
            Kind::Gpu(gpu) => gpu.name(),
        }
    }

    /// Renders a frame. Where nobody insisted on the GPU and it cannot, the CPU does, here and from now on.
    pub fn render(&mut self, frame: &Frame, progress: Progress<'_>) -> Result<Picture, BackendError> {
        self.attempt(|backend| backend.render(frame, progress))
    }

    /// What the first sample of each pixel sees; by whom, as in [`Engine::render`].
    pub fn hits(&mut self, frame: &Frame) -> Result<Vec<Hit>, BackendError> {
        self.attempt(|backend| backend.hits(frame))
    }

    /// Traces an array of rays; by whom, as in [`Engine::render`].
    pub fn cast(&mut self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, BackendError> {
        self.attempt(|backend| backend.cast(parts, query, rays))
    }

    fn attempt<T>(&mut self, work: impl Fn(&mut dyn Backend) -> Result<T, BackendError>) -> Result<T, BackendError> {
        let result = match &mut self.kind {
            Kind::Cpu(cpu) => work(cpu),
            Kind::Gpu(gpu) => work(gpu),
        };
        match (result, self.fallback.take()) {
            (Err(error), Some(scene)) => {
                eprintln!("{}", error.and_the_cpu_renders());
                let mut cpu = Cpu::new(scene);
                let result = work(&mut cpu);
                self.kind = Kind::Cpu(cpu);
                result
            }
            (result, fallback) => {
                self.fallback = fallback;
                result
            }
        }
    }

    /// Milliseconds that the kernel takes for a frame, several times over: by the GPU's clock, or by the wall's.
    pub fn time_render(&mut self, frame: &Frame, repeats: u32) -> Result<Vec<f64>, BackendError> {
        match &mut self.kind {
            Kind::Gpu(gpu) => gpu.time_render(frame, repeats),
            Kind::Cpu(cpu) => (0..repeats)
                .map(|_| {
                    let start = Instant::now();
                    cpu.render(frame, &oktant::progress::silent)?;
                    Ok(start.elapsed().as_secs_f64() * 1e3)
                })
                .collect(),
        }
    }

    /// Milliseconds that tracing an array of rays takes, several times over: the kernel alone by the GPU's clock, or by the
    /// wall's, without what leads to and from it.
    pub fn time_cast(
        &mut self,
        parts: Parts,
        query: Query,
        rays: &[Ray],
        repeats: u32,
    ) -> Result<Vec<f64>, BackendError> {
        match &mut self.kind {
            Kind::Gpu(gpu) => gpu.time_cast(parts, query, rays, repeats),
            Kind::Cpu(cpu) => cpu.time_cast(parts, query, rays, repeats),
        }
    }
}
