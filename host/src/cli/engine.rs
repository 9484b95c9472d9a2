//! Choosing what renders.

use super::Failure;
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

impl EngineOptions {
    /// Whether the CPU may render what a GPU cannot: a kernel cannot do without one.
    fn may_fall_back(&self) -> bool {
        self.choice == BackendChoice::Auto && self.gpu.kernel.is_none()
    }
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
        Self::chosen(options, scene).or_else(|error| Self::instead(options, scene, error))
    }

    /// As [`Engine::new`]; but where `auto` finds that the triangles of a scene with the default parts are too large for the
    /// GPU, they become indices, in the scene that `compact` makes. Returns the scene that is rendered, too.
    pub fn of_any_size(
        options: &EngineOptions,
        scene: &Arc<Scene>,
        compact: impl FnOnce() -> Result<Scene, Failure>,
    ) -> Result<(Self, Arc<Scene>), Failure> {
        match Self::chosen(options, scene) {
            Ok(engine) => Ok((engine, scene.clone())),
            Err(error) if options.may_fall_back() && error.is_about_triangles() && scene.parts == Parts::STANDARD => {
                eprintln!(
                    "{}: the structure is built anew with triangles as indices.",
                    error.what()
                );
                let scene = Arc::new(compact()?);
                Ok((Self::new(options, &scene)?, scene))
            }
            Err(error) => Ok((Self::instead(options, scene, error)?, scene.clone())),
        }
    }

    /// What the options choose, if it can be had.
    fn chosen(options: &EngineOptions, scene: &Arc<Scene>) -> Result<Self, BackendError> {
        let kind = match options.choice {
            BackendChoice::Cpu => Kind::Cpu(Cpu::new(scene.clone())),
            BackendChoice::Auto | BackendChoice::Gpu => {
                let gpu = Gpu::open(&options.gpu)?;
                Kind::Gpu(GpuBackend::new(Arc::new(gpu), scene)?)
            }
        };
        Ok(Self::of(kind, options, scene))
    }

    /// The CPU, where nobody insisted on the GPU that cannot be had.
    fn instead(options: &EngineOptions, scene: &Arc<Scene>, error: BackendError) -> Result<Self, BackendError> {
        if !options.may_fall_back() {
            return Err(error);
        }
        eprintln!("{}", error.and_the_cpu_renders());
        Ok(Self::of(Kind::Cpu(Cpu::new(scene.clone())), options, scene))
    }

    fn of(kind: Kind, options: &EngineOptions, scene: &Arc<Scene>) -> Self {
        let engine = Engine {
            kind,
            fallback: options.may_fall_back().then(|| scene.clone()),
        };
        tracing::info!("rendered by {}", engine.name());
        engine
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
