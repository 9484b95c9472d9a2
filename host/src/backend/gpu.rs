//! The GPU back end: the kernel compiled to SPIR-V, run by wgpu.

mod device;
mod failure;
mod hardship;
mod kernel;
mod kernel_error;
mod kernel_module;
mod layouts;
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
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::parts::Parts;
use oktant_shared::ray::Ray;
use oktant_shared::render::sample_ray;
use oktant_shared::trace::nearest_plane;
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
/// Workgroups in a row of such a dispatch; the kernel counts on it.
const LINES_PER_ROW: u32 = 32_768;

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
        self.gpu.pipeline(self.scene.entry)?;
        let timer = self.timer()?;
        let passes = if frame.most_samples == 0 {
            vec![*frame]
        } else {
            adaptive::passes(frame, frame.most_samples)
        };
        self.timed(repeats, || {
            self.gpu.forget(&picture);
            let mut encoder = self.gpu.encoder();
            self.gpu
                .encode_passes(&mut encoder, &self.scene, &picture, &passes, size.y, Some(&timer))?;
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

    /// Camera rays that one dispatch may have, and how many samples of a pixel may be among them.
    fn budget(&self, frame: &Frame, most: u32) -> (u64, u32) {
        let size = frame.size();
        let budget = if self.scene.is_plain {
            RAYS_PER_DISPATCH
        } else {
            TREES_PER_DISPATCH
        };
        // lavapipe leaves all loops of a pixel when they have taken 65,535 turns together: a sample at a time.
        let most = if self.gpu.is_software() { 1 } else { most };
        let pixels = u64::from(size.x) * u64::from(size.y);
        (budget, (budget / pixels.max(1)).clamp(1, u64::from(most)) as u32)
    }

    /// The passes of a frame, each with the rows of its band.
    fn bands(&self, frame: &Frame) -> Vec<(Frame, u32)> {
        let (width, height) = frame.size().into();
        let (budget, samples) = self.budget(frame, frame.sample_count);
        // Whole workgroups: a row of the next band must not be added twice.
        let rows = (budget / u64::from(width.max(1) * samples)) as u32 / TILE_HEIGHT * TILE_HEIGHT;
        let rows = rows.clamp(TILE_HEIGHT, height.next_multiple_of(TILE_HEIGHT));
        let mut bands = Vec::new();
        for first_sample in (0..frame.sample_count).step_by(samples as usize) {
            for first_row in (0..height).step_by(rows as usize) {
                let pass = Frame {
                    first_sample: frame.first_sample + first_sample,
                    sample_count: samples.min(frame.sample_count - first_sample),
                    first_row,
                    ..*frame
                };
                bands.push((pass, rows.min(height - first_row)));
            }
        }
        bands
    }

    /// The passes of a frame that is sampled adaptively.
    fn adaptive_passes(&self, frame: &Frame) -> Vec<(Frame, u32)> {
        let (budget, samples) = self.budget(frame, frame.most_samples);
        let mut passes = Vec::new();
        for pass in adaptive::passes(frame, samples) {
            if pass.is_listed == 0 {
                passes.extend(self.bands(&pass));
            } else {
                let pixels = (budget / u64::from(pass.sample_count)).min(u64::from(u32::MAX)) as u32;
                passes.extend(adaptive::parts(&pass, pixels).into_iter().map(|part| {
                    let rows = pixels.div_ceil(part.size().x.max(1)).min(part.size().y);
                    (part, rows)
                }));
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
        for _ in 0..times {
            pass.dispatch_workgroups(
                piece.workgroups.min(LINES_PER_ROW),
                piece.workgroups.div_ceil(LINES_PER_ROW),
                1,
            );
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
        for (done, (pass, rows)) in (1..).zip(&passes) {
            let mut encoder = self.gpu.encoder();
            self.gpu
                .encode_passes(&mut encoder, &self.scene, &picture, &[*pass], *rows, None)?;
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
        let (pass, rows) = ([*frame], picture.height);
        if let Some(timer) = timer {
            self.encode_passes(&mut encoder, scene, picture, &pass, rows, Some(&timer))?;
            timer.finish(self, encoder)
        } else {
            // Not to be counted, should they be made only now.
            self.pipeline(scene.entry)?;
            if adaptive::makes_list(frame) {
                self.pipeline(CHOOSE)?;
            }
            let start = Instant::now();
            self.encode_passes(&mut encoder, scene, picture, &pass, rows, None)?;
            self.queue.submit([encoder.finish()]);
            self.wait()?;
            Ok(start.elapsed().as_secs_f64() * 1e3)
        }
    }

    /// Passes one after the other, each over so many rows of the picture, or over as many pixels of its list.
    fn encode_passes(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        picture: &GpuPicture,
        passes: &[Frame],
        rows: u32,
        timer: Option<&Timer>,
    ) -> Result<(), BackendError> {
        let pipeline = self.pipeline(scene.entry)?;
        for (number, frame) in passes.iter().enumerate() {
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
            if frame.is_listed == 0 {
                pass.dispatch_workgroups(picture.width.div_ceil(TILE), rows.div_ceil(TILE_HEIGHT), 1);
            } else {
                // Most find nothing to do, which takes less than asking first how many are needed.
                let workgroups = (picture.width * rows).div_ceil(TILE * TILE_HEIGHT);
                pass.dispatch_workgroups(workgroups.min(LINES_PER_ROW), workgroups.div_ceil(LINES_PER_ROW), 1);
            }
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
}
