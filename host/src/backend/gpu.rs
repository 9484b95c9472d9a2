//! The GPU back end: the kernel compiled to SPIR-V, run by wgpu.

mod companion;
mod device;
mod failure;
mod hardship;
mod kernel;
mod kernel_error;
mod kernel_module;
mod layouts;
mod pass;
mod probe;
mod readback;
mod resources;
mod wakefulness;

pub use device::{Gpu, GpuOptions};
pub use kernel::Kernel;
pub use kernel_error::KernelError;
pub use kernel_module::{CompiledModule, KernelManifest, ModulePath, compiled_kernel};
pub use layouts::{READ, WRITE, compute_pipeline, group_of_buffers};
pub use probe::FusedMultiplyAdd;
pub use resources::{GpuPicture, GpuScene};

use super::{Backend, BackendError, MEASURING, Query, measured};
use crate::adaptive;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::scene::Scene;
use glam::{Vec4, uvec2};
use layouts::CHOOSE;
use oktant_shared::adaptive::Mark;
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::Parts;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use oktant_shared::trace::nearest_plane;
use pass::{Pass, in_rows};
use readback::Timer;
use std::sync::Arc;
use std::time::Instant;

/// Renders on a GPU with a scene that lies in its memory.
pub struct GpuBackend {
    gpu: Arc<Gpu>,
    scene: GpuScene,
}

/// Camera rays that one dispatch may have: more would keep a slow GPU busy longer than its driver's watchdog allows.
const RAYS_PER_DISPATCH: u64 = 1 << 24;
/// The same for camera rays that have trees of rays.
const TREES_PER_DISPATCH: u64 = 1 << 21;

/// Width of the workgroups of the entry points that look at pixels, and edge of those of the one that chooses.
const TILE: u32 = 8;
/// Height of the workgroups of the entry points that look at pixels.
const TILE_HEIGHT: u32 = 16;
/// Size of the workgroups of the entry points that take an array.
const LINE: u32 = 64;
/// Rays of an array that a dispatch may have where some take very long: as of a grid one of whose cells holds most triangles.
const RAYS_PER_PIECE: usize = 1 << 18;
/// Milliseconds up to which an array of rays is measured in dispatches of all of it: a hundredth of what watchdogs allow.
const WHOLE: f64 = 20.0;
/// Dispatches between two timestamps, one after the other: the start of a pass would count for more than a short kernel.
const AT_ONCE: u32 = 8;

impl GpuBackend {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`BackendError::TooLarge`] where an array exceeds what the device can bind, [`BackendError::Failed`].
    pub fn new(gpu: Arc<Gpu>, scene: &Scene) -> Result<Self, BackendError> {
        let scene = gpu.upload(scene)?;
        Ok(GpuBackend { gpu, scene })
    }

    /// The device.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Milliseconds that the kernel takes for all samples of a frame, `repeats` times over, by the device's own clock.
    ///
    /// # Errors
    /// [`BackendError::Failed`], also where the device has no clock.
    pub fn time_render(&self, frame: &Frame, repeats: u32) -> Result<Vec<f64>, BackendError> {
        let size = frame.size();
        let picture = self.gpu.picture(size.x, size.y, frame.most_samples != 0)?;
        let timer = self.timer()?;
        let passes = if frame.most_samples == 0 {
            vec![*frame]
        } else {
            adaptive::passes(frame, frame.most_samples)
        };
        let passes: Vec<_> = passes.iter().map(Pass::whole).collect();
        self.timed(repeats, || {
            self.gpu.forget(&picture);
            let mut encoder = self.gpu.encoder();
            self.gpu
                .encode_passes(&mut encoder, &self.scene, &picture, &passes, Some(&timer))?;
            timer.finish(&self.gpu, encoder)
        })
    }

    /// Milliseconds that the kernel takes for an array of rays, `repeats` times over, by the device's own clock: each the
    /// mean of eight dispatches. Where one takes more than 20 ms, each is the sum of several dispatches of a part of the rays, and
    /// there are fewer of them, but one, if they take more than five seconds.
    ///
    /// # Errors
    /// As [`GpuBackend::time_render`].
    pub fn time_cast(&self, parts: Parts, query: Query, rays: &[Ray], repeats: u32) -> Result<Vec<f64>, BackendError> {
        let cast = self.prepare_cast(parts, query, rays)?;
        let timer = self.timer()?;
        let time = |piece: &Piece, times: u32| {
            let mut encoder = self.gpu.encoder();
            cast.encode(&mut encoder, piece, Some(&timer), times);
            timer.finish(&self.gpu, encoder)
        };
        let in_pieces = || cast.pieces.iter().map(|piece| time(piece, 1)).sum::<Result<f64, _>>();
        if self.gpu.awake(in_pieces)? > WHOLE {
            return measured(repeats, MEASURING, in_pieces);
        }
        self.timed(repeats, || Ok(time(&cast.whole, AT_ONCE)? / f64::from(AT_ONCE)))
    }

    /// Measures `repeats` times, after as many that do not count as the device needs to wake up.
    fn timed(&self, repeats: u32, once: impl Fn() -> Result<f64, BackendError>) -> Result<Vec<f64>, BackendError> {
        self.gpu.awake(&once)?;
        let times = (0..repeats).map(|_| once()).collect();
        self.gpu.wakefulness.was_busy();
        times
    }

    /// What the first sample of each pixel sees, with rays made by the host: the entry point for it has the default parts.
    fn cast_hits(&mut self, frame: &Frame) -> Result<Vec<Hit>, BackendError> {
        let (width, height) = frame.size().into();
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| uvec2(x, y)));
        let (rays, planes): (Vec<Ray>, Vec<Hit>) = pixels
            .map(|pixel| {
                let ray = sample_ray(frame, pixel, frame.first_sample);
                let plane = nearest_plane(&self.scene.planes, frame.plane_count, &ray);
                (Ray { t_max: plane.t, ..ray }, plane)
            })
            .unzip();
        let hits = self.cast(self.scene.parts, Query::Closest, &rays)?;
        let nearer = |(hit, plane): (Hit, Hit)| if hit.is_hit() { hit } else { plane };
        Ok(hits.into_iter().zip(planes).map(nearer).collect())
    }

    /// Camera rays that one dispatch may have.
    fn budget(&self) -> u64 {
        if self.scene.is_plain {
            RAYS_PER_DISPATCH
        } else {
            TREES_PER_DISPATCH
        }
    }

    /// The passes of a frame, a band of the picture each.
    fn bands(&self, frame: &Frame) -> Vec<Pass> {
        Pass::bands(frame, self.budget(), self.gpu.most_at_once(frame.sample_count))
    }

    /// The passes of a frame that is sampled adaptively.
    fn adaptive_passes(&self, frame: &Frame) -> Vec<Pass> {
        let mut passes = Vec::new();
        for pass in adaptive::passes(frame, self.gpu.most_at_once(frame.most_samples)) {
            if pass.is_listed == 0 {
                passes.extend(self.bands(&pass));
            } else {
                passes.extend(Pass::parts(&pass, self.budget()));
            }
        }
        passes
    }

    fn timer(&self) -> Result<Timer, BackendError> {
        Timer::new(&self.gpu).ok_or_else(|| self.gpu.failed("it has no timestamp queries"))
    }

    fn prepare_cast(&self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Cast<'_>, BackendError> {
        let entries = parts
            .entry_points()
            .filter(|_| parts.traversal == self.scene.parts.traversal);
        let (closest, any) = entries.ok_or(BackendError::Parts(parts))?;
        let entry = match query {
            Query::Closest => closest,
            Query::Any => any,
        };
        let gpu = &self.gpu;
        let frame = Frame {
            root: self.scene.root,
            ..bytemuck::Zeroable::zeroed()
        };
        let hits = gpu.output("hits", (rays.len() * size_of::<Hit>()) as u64)?;
        let input = gpu.input("rays", rays)?;
        let piece = |first: usize, count: usize| Piece {
            group: gpu.group_of_ranges(
                &gpu.layouts.cast,
                &[
                    (&hits, first * size_of::<Hit>(), count * size_of::<Hit>()),
                    (&input, first * size_of::<Ray>(), count * size_of::<Ray>()),
                ],
            ),
            workgroups: (count as u32).div_ceil(LINE),
        };
        let firsts = (0..rays.len()).step_by(RAYS_PER_PIECE);
        Ok(Cast {
            pipeline: gpu.pipeline(entry)?,
            scene: &self.scene,
            frame: gpu.frame_group(&frame),
            whole: piece(0, rays.len()),
            pieces: firsts
                .map(|first| piece(first, RAYS_PER_PIECE.min(rays.len() - first)))
                .collect(),
            hits,
        })
    }
}

/// An array of rays in the device's memory.
struct Cast<'a> {
    pipeline: Arc<wgpu::ComputePipeline>,
    scene: &'a GpuScene,
    frame: wgpu::BindGroup,
    /// All rays, and the same in pieces.
    whole: Piece,
    pieces: Vec<Piece>,
    hits: wgpu::Buffer,
}

/// Some of the rays, and where their hits go.
struct Piece {
    group: wgpu::BindGroup,
    workgroups: u32,
}

impl Cast<'_> {
    fn encode(&self, encoder: &mut wgpu::CommandEncoder, piece: &Piece, timer: Option<&Timer>, times: u32) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("cast"),
            timestamp_writes: timer.map(Timer::writes),
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.scene.group, &[]);
        pass.set_bind_group(1, &self.frame, &[]);
        pass.set_bind_group(2, &piece.group, &[]);
        let [x, y] = in_rows(piece.workgroups);
        for _ in 0..times {
            pass.dispatch_workgroups(x, y, 1);
        }
    }
}

impl Backend for GpuBackend {
    fn name(&self) -> String {
        self.gpu.name.clone()
    }

    fn render(&mut self, frame: &Frame, progress: Progress<'_>) -> Result<Picture, BackendError> {
        let (width, height) = frame.size().into();
        let pixels = u64::from(width) * u64::from(height);
        let is_adaptive = frame.most_samples != 0;
        let picture = self.gpu.picture_and_work(width, height, pixels, is_adaptive)?;
        let passes = if is_adaptive {
            self.adaptive_passes(frame)
        } else {
            self.bands(frame)
        };
        for pass in &passes {
            // What cannot be rendered is said before anything is.
            self.gpu.pipeline(self.scene.entry_for(&pass.frame))?;
        }
        for (done, pass) in (1..).zip(passes.chunks(1)) {
            let mut encoder = self.gpu.encoder();
            self.gpu
                .encode_passes(&mut encoder, &self.scene, &picture, pass, None)?;
            self.gpu.queue.submit([encoder.finish()]);
            self.gpu.wait()?;
            progress("rendering", done as f32 / passes.len() as f32);
        }
        Ok(Picture {
            width,
            height,
            sums: self.gpu.read(&picture.sums)?,
            work: self.gpu.read(&picture.work)?,
            marks: if is_adaptive {
                self.gpu.read(&picture.marks)?
            } else {
                Vec::new()
            },
        })
    }

    fn hits(&mut self, frame: &Frame) -> Result<Vec<Hit>, BackendError> {
        if self.scene.parts != Parts::default() {
            return self.cast_hits(frame);
        }
        let (width, height) = frame.size().into();
        let gpu = &self.gpu;
        let hits = gpu.output("hits", u64::from(width) * u64::from(height) * size_of::<Hit>() as u64)?;
        let pipeline = gpu.pipeline("hits")?;
        let frame = gpu.frame_group(frame);
        let group = gpu.group(&gpu.layouts.hits, &[&hits]);
        let mut encoder = gpu.encoder();
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &self.scene.group, &[]);
            pass.set_bind_group(1, &frame, &[]);
            pass.set_bind_group(2, &group, &[]);
            pass.set_bind_group(3, &self.scene.appearance, &[]);
            pass.dispatch_workgroups(width.div_ceil(TILE), height.div_ceil(TILE_HEIGHT), 1);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.read(&hits)
    }

    fn cast(&mut self, parts: Parts, query: Query, rays: &[Ray]) -> Result<Vec<Hit>, BackendError> {
        if rays.is_empty() {
            return Ok(Vec::new());
        }
        let cast = self.prepare_cast(parts, query, rays)?;
        for piece in &cast.pieces {
            let mut encoder = self.gpu.encoder();
            cast.encode(&mut encoder, piece, None, 1);
            self.gpu.queue.submit([encoder.finish()]);
        }
        self.gpu.read(&cast.hits)
    }
}

impl Gpu {
    /// Renders a pass of samples and waits for it; they are added to the picture, or overwrite it where the pass begins with
    /// sample 0. The frame's size must be the picture's. Returns the milliseconds that the kernel took by the device's own
    /// clock, or by the host's where the device has none or is software, whose clock does not wait for its threads.
    ///
    /// # Errors
    /// [`BackendError::Failed`] where the device is lost.
    pub fn render_pass_timed(
        &self,
        scene: &GpuScene,
        picture: &GpuPicture,
        frame: &Frame,
    ) -> Result<f64, BackendError> {
        let mut encoder = self.encoder();
        let timer = if self.is_software() { None } else { Timer::new(self) };
        let pass = [Pass::whole(frame)];
        if let Some(timer) = timer {
            self.encode_passes(&mut encoder, scene, picture, &pass, Some(&timer))?;
            timer.finish(self, encoder)
        } else {
            // Not to be counted, should they be made only now.
            self.pipeline(scene.entry_for(frame))?;
            if adaptive::makes_list(frame) {
                self.pipeline(CHOOSE)?;
            }
            let start = Instant::now();
            self.encode_passes(&mut encoder, scene, picture, &pass, None)?;
            self.queue.submit([encoder.finish()]);
            self.wait()?;
            Ok(start.elapsed().as_secs_f64() * 1e3)
        }
    }

    /// Samples of a pixel that a dispatch may take where `most` are wanted.
    pub(crate) fn most_at_once(&self, most: u32) -> u32 {
        // lavapipe leaves all loops of a pixel when they have taken 65,535 turns together: a sample at a time.
        if self.is_software() { 1 } else { most }
    }

    /// Passes one after the other.
    fn encode_passes(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        picture: &GpuPicture,
        passes: &[Pass],
        timer: Option<&Timer>,
    ) -> Result<(), BackendError> {
        for (number, pass) in passes.iter().enumerate() {
            let frame = &pass.frame;
            let [x, y] = pass.workgroups();
            let pipeline = self.pipeline(scene.entry_for(frame))?;
            debug_assert_eq!(frame.size(), uvec2(picture.width, picture.height));
            debug_assert!(frame.most_samples == 0 || picture.is_adaptive());
            let frame_group = self.frame_group(frame);
            let is_first = number == 0;
            let makes_list = adaptive::makes_list(frame);
            if makes_list {
                encoder.clear_buffer(&picture.count, 0, None);
                let choose = self.pipeline(CHOOSE)?;
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some("choose"),
                    timestamp_writes: timer.and_then(|timer| timer.writes_of(is_first, false)),
                });
                pass.set_pipeline(&choose);
                pass.set_bind_group(1, &frame_group, &[]);
                pass.set_bind_group(2, &picture.choice, &[]);
                pass.dispatch_workgroups(picture.width.div_ceil(TILE), picture.height.div_ceil(TILE), 1);
            }
            let is_last = number + 1 == passes.len();
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("render"),
                timestamp_writes: timer.and_then(|timer| timer.writes_of(is_first && !makes_list, is_last)),
            });
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &scene.group, &[]);
            pass.set_bind_group(1, &frame_group, &[]);
            pass.set_bind_group(2, &picture.group, &[]);
            pass.set_bind_group(3, &scene.appearance, &[]);
            pass.dispatch_workgroups(x, y, 1);
        }
        Ok(())
    }

    /// A new picture's sums, for tests of what is written.
    ///
    /// # Errors
    /// [`BackendError::Failed`] where the device is lost.
    pub fn read_picture(&self, picture: &GpuPicture) -> Result<Vec<Vec4>, BackendError> {
        self.read(&picture.sums)
    }

    /// What is known of the pixels of a new picture that is sampled adaptively, for tests of what is listed.
    ///
    /// # Errors
    /// [`BackendError::Failed`] where the device is lost.
    pub fn read_marks(&self, picture: &GpuPicture) -> Result<Vec<Mark>, BackendError> {
        self.read(&picture.marks)
    }
}
