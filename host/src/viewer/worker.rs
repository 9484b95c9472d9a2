//! What the renderer's thread does.

use super::accident::caught;
use super::draft::Draft;
use super::gpu_memory::GpuMemory;
use super::notice::{Image, Mailbox, Notice, RenderError, Rendered, SaveError};
use super::passes::{passes, rays, wanted};
use super::saving::Saving;
use super::task::{Destination, Effort, Engine, Plan, Purpose, Task};
use super::throttle::Throttle;
use crate::backend::BackendError;
use crate::backend::cpu::Cpu;
use crate::backend::gpu::{Gpu, GpuPicture};
use crate::picture::Picture;
use crate::progress::silent;
use oktant_shared::frame::Frame;
use oktant_shared::stereo::STACKED;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::{Duration, Instant};

/// While a picture is refined, it is shown no more often than this.
const REFINEMENT: Duration = Duration::from_millis(250);

/// Rays are counted in one pixel of a square with this edge.
const COUNTED: u32 = 8;

/// Renders one picture after the other.
pub struct Worker {
    mailbox: Mailbox,
    /// Gives up the picture that is to be shown.
    cancel: Arc<AtomicBool>,
    /// Gives up everything.
    closes: Arc<AtomicBool>,
    memory: GpuMemory,
    /// For the progress of what is saved.
    throttle: Throttle,
}

/// A picture that is refined, and when it was shown.
struct Refinement {
    wanted: u32,
    taken: u32,
    /// How many passes an adaptive picture has, and how many were taken; the samples of its pixels differ.
    passes: [u32; 2],
    shown: Instant,
}

impl Refinement {
    fn new(frame: &Frame, passes: usize) -> Self {
        Refinement {
            wanted: wanted(frame),
            taken: 0,
            passes: [passes as u32, 0],
            shown: Instant::now(),
        }
    }

    /// Takes note of a pass; whether what there is should be shown before the rest is there. An odd sample waits for the
    /// one opposite.
    fn shows(&mut self, pass: &Frame) -> bool {
        self.passes[1] += 1;
        let [passes, passed] = self.passes;
        let is_whole = if pass.most_samples != 0 {
            self.taken = (self.wanted * passed / passes).max(1);
            // Where blocks are interpolated, the first rounds leave holes.
            pass.block == 1 || passed == passes
        } else {
            self.taken += pass.sample_count;
            self.taken.is_multiple_of(2)
        };
        let shows = is_whole && self.taken < self.wanted && self.shown.elapsed() >= REFINEMENT;
        if shows {
            self.shown = Instant::now();
        }
        shows
    }
}

impl Worker {
    /// One that tells that mailbox, and gives up what it does when the flags are raised: the picture that is to be
    /// shown, or everything.
    pub fn new(mailbox: Mailbox, cancel: Arc<AtomicBool>, closes: Arc<AtomicBool>) -> Self {
        Worker {
            mailbox,
            cancel,
            closes,
            memory: GpuMemory::default(),
            throttle: Throttle::new(),
        }
    }

    /// Works until the window closes; returns where pictures were to be saved that are not. What is to be shown goes
    /// before the next pass of what is to be saved.
    pub fn work(mut self, queue: &Receiver<Task>) -> Vec<Destination> {
        let mut saving: Option<Saving> = None;
        while !self.closes.load(Ordering::Relaxed) {
            let task = match saving {
                None => queue.recv().map_err(|_| TryRecvError::Disconnected),
                Some(_) => queue.try_recv(),
            };
            match task {
                Ok(task) => match task.purpose.clone() {
                    Purpose::Save(destination) => saving = self.begin(task, &destination),
                    Purpose::Show { .. } => {
                        let result = self.show(&task);
                        self.mailbox.send(Notice::Finished(result));
                    }
                },
                Err(TryRecvError::Empty) => saving = saving.and_then(|saving| self.go_on(saving)),
                Err(TryRecvError::Disconnected) => break,
            }
        }
        let begun = saving.map(|saving| Destination::File(saving.path().to_path_buf()));
        let waiting = queue.try_iter().filter_map(|task| match task.purpose {
            Purpose::Save(destination) => Some(destination),
            Purpose::Show { .. } => None,
        });
        begun.into_iter().chain(waiting).collect()
    }

    fn begin(&mut self, task: Task, destination: &Destination) -> Option<Saving> {
        let begun = caught(|| Saving::begin(task, destination, &mut self.memory));
        match begun.unwrap_or_else(|accident| Err(SaveError::Accident(accident))) {
            Ok(saving) => {
                // A name may have been found for it.
                let path = saving.path().to_path_buf();
                self.mailbox.send(Notice::Saving { path, fraction: 0.0 });
                Some(saving)
            }
            Err(error) => {
                self.mailbox.send(Notice::Saved(Err(error)));
                None
            }
        }
    }

    /// Takes the next pass, and writes the file after the last one; none then, or if something went wrong.
    fn go_on(&mut self, mut saving: Saving) -> Option<Saving> {
        let path = saving.path().to_path_buf();
        let progress = |_, fraction| {
            if self.throttle.is_due() {
                self.mailbox.send(Notice::Saving {
                    path: path.clone(),
                    fraction,
                });
            }
        };
        let taken = caught(|| saving.pass(&mut self.memory, &self.closes, &progress));
        let result = match taken {
            Ok(Ok(false)) => return Some(saving),
            Ok(Ok(true)) => caught(|| saving.finish()).unwrap_or_else(|accident| Err(SaveError::Accident(accident))),
            Ok(Err(error)) => Err(error),
            Err(accident) => Err(SaveError::Accident(accident)),
        };
        self.mailbox.send(Notice::Saved(result));
        None
    }

    fn show(&mut self, task: &Task) -> Result<(), RenderError> {
        self.render(task)?;
        if let Purpose::Show {
            effort: Effort::Full { .. },
            ..
        } = task.purpose
        {
            caught(|| self.count_rays(task)).map_err(RenderError::Accident)?;
        }
        Ok(())
    }

    /// Counts what rays a camera ray leads to, on the CPU, in a picture an eighth as wide and as high as the finished one.
    fn count_rays(&self, task: &Task) {
        let draft = Draft {
            edge: COUNTED,
            ..Draft::FINE
        };
        let frame = draft.frame(&task.view, &task.scene, task.size);
        let mut picture = Picture::unwritten(frame.size().x, frame.size().y);
        let cpu = Cpu::new(task.scene.clone());
        if cpu.render_pass(&frame, &mut picture, &self.cancel, &silent) {
            let effort = crate::effort::Effort::new(&picture, None);
            let camera = rays(&frame) as f64;
            self.mailbox.send(Notice::RaysCounted {
                closest: effort.closest / camera,
                shadow: effort.shadow / camera,
            });
        }
    }

    fn render(&mut self, task: &Task) -> Result<(), RenderError> {
        match &task.engine {
            Engine::Cpu => caught(|| {
                self.memory.clear();
                self.show_cpu(task);
            })
            .map_err(RenderError::Accident),
            Engine::Gpu(gpu) => {
                let shown = caught(|| self.show_gpu(task, gpu));
                Ok(shown.unwrap_or_else(|accident| Err(gpu.failed_by(&accident)))?)
            }
        }
    }

    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    fn send(&self, number: u64, frame: &Frame, image: Image, samples: u32, complete: bool) {
        self.mailbox.send(Notice::Rendered(Rendered {
            number,
            image,
            is_stacked: frame.stereo == STACKED,
            samples,
            complete,
        }));
    }

    /// Tells the window of a pass: so many samples are taken.
    fn passed(&self, taken: u32, pass: &Frame, milliseconds: f64) {
        self.mailbox.send(Notice::Refined {
            samples: taken,
            rays: rays(pass),
            milliseconds,
        });
    }

    fn show_cpu(&self, task: &Task) {
        let Some(plan) = Plan::new(task) else { return };
        let cpu = Cpu::new(task.scene.clone());
        for (frame, complete) in plan.pictures {
            let mut picture = Picture::unwritten(frame.size().x, frame.size().y);
            let passes = passes(&frame, frame.most_samples);
            let mut refinement = Refinement::new(&frame, passes.len());
            for pass in passes {
                let start = Instant::now();
                if !cpu.render_pass(&pass, &mut picture, &self.cancel, &silent) {
                    return;
                }
                let milliseconds = start.elapsed().as_secs_f64() * 1e3;
                let shows = refinement.shows(&pass);
                self.passed(refinement.taken, &pass, milliseconds);
                if shows {
                    // A copy: the window keeps it while the next samples are added.
                    let copy = Picture::of_sums(picture.width, picture.height, picture.sums.clone());
                    self.send(plan.number, &frame, Image::Cpu(Arc::new(copy)), refinement.taken, false);
                }
            }
            self.send(
                plan.number,
                &frame,
                Image::Cpu(Arc::new(picture)),
                wanted(&frame),
                complete,
            );
        }
    }

    fn show_gpu(&mut self, task: &Task, gpu: &Arc<Gpu>) -> Result<(), BackendError> {
        let Some(plan) = Plan::new(task) else { return Ok(()) };
        for (frame, complete) in plan.pictures {
            let picture = self
                .memory
                .spare_picture(gpu, frame.size().into(), frame.most_samples != 0)?;
            if !self.refine(task, gpu, &picture, &frame, plan.number)? {
                return Ok(());
            }
            self.send(plan.number, &frame, Image::Gpu(picture), wanted(&frame), complete);
        }
        Ok(())
    }

    /// Takes all samples of a frame, at once where that is quick; the picture is shown meanwhile. Returns false if it was
    /// cancelled.
    ///
    /// The window may show what the next pass adds to: the device does one after the other, so that it finds each pixel
    /// with its last pass or without.
    fn refine(
        &mut self,
        task: &Task,
        gpu: &Arc<Gpu>,
        picture: &Arc<GpuPicture>,
        frame: &Frame,
        number: u64,
    ) -> Result<bool, BackendError> {
        let frames = if frame.most_samples != 0 {
            passes(frame, self.memory.samples_of_a_pass(gpu, &task.scene, frame)?)
        } else if self.memory.is_quick(gpu, &task.scene, frame)? {
            vec![*frame]
        } else {
            passes(frame, 1)
        };
        let mut refinement = Refinement::new(frame, frames.len());
        for pass in frames {
            if self.cancelled() {
                return Ok(false);
            }
            let milliseconds = self.memory.render_pass(gpu, &task.scene, picture, &pass)?;
            let shows = refinement.shows(&pass);
            self.passed(refinement.taken, &pass, milliseconds);
            if shows {
                self.send(number, frame, Image::Gpu(picture.clone()), refinement.taken, false);
            }
        }
        Ok(true)
    }
}
