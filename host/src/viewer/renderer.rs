//! The thread that renders, so that the window never waits.

use super::accident::caught;
use super::depth_paces::DepthPaces;
use super::notice::{Image, Mailbox, Notice, RenderError, Rendered, SaveError};
use super::passes::{passes, rays};
use super::pictures;
use super::task::{Destination, Engine, Plan, Purpose, Task};
use crate::backend::cpu::Cpu;
use crate::backend::gpu::{Gpu, GpuPicture, GpuScene};
use crate::backend::{Backend, BackendError};
use crate::output::PictureFile;
use crate::picture::Picture;
use crate::progress::silent;
use crate::scene::Scene;
use oktant_shared::frame::Frame;
use oktant_shared::stereo::STACKED;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// A pass on the GPU takes no longer, if it has more than one sample, so that it can be given up.
const GPU_PASS: Duration = Duration::from_millis(25);
/// While a picture is refined, it is shown no more often than this.
const REFINEMENT: Duration = Duration::from_millis(250);
/// Pictures in the GPU's memory that are kept to be written again.
const SPARE_PICTURES: usize = 3;

/// The window's end of the thread.
pub struct Renderer {
    tasks: Sender<Task>,
    cancel: Arc<AtomicBool>,
}

impl Renderer {
    /// Starts the thread; it ends when the renderer is dropped.
    pub fn start(mailbox: Mailbox) -> Self {
        let (tasks, queue) = channel();
        let cancel = Arc::new(AtomicBool::new(false));
        let worker = Worker {
            mailbox,
            cancel: cancel.clone(),
            uploaded: None,
            spare: Vec::new(),
        };
        thread::spawn(move || worker.work(&queue));
        Renderer { tasks, cancel }
    }

    /// Gives the thread something to do. It must be idle: it says [`Notice::Finished`] after each task.
    pub fn render(&self, task: Task) {
        self.cancel.store(false, Ordering::Relaxed);
        // The thread is gone only when the window is.
        drop(self.tasks.send(task));
    }

    /// Makes the thread give up its picture soon.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.cancel();
    }
}

struct Worker {
    mailbox: Mailbox,
    cancel: Arc<AtomicBool>,
    uploaded: Option<Uploaded>,
    spare: Vec<Arc<GpuPicture>>,
}

/// A scene in a GPU's memory, which one it is, and how fast it is rendered.
struct Uploaded {
    gpu: Weak<Gpu>,
    scene: Weak<Scene>,
    there: GpuScene,
    paces: DepthPaces,
}

/// A picture that is refined, and when it was shown.
struct Refinement {
    wanted: u32,
    taken: u32,
    shown: Instant,
}

impl Refinement {
    fn new(frame: &Frame) -> Self {
        Refinement {
            wanted: frame.sample_count,
            taken: 0,
            shown: Instant::now(),
        }
    }

    /// Takes note of a pass; whether what there is should be shown before the rest is there. An odd sample waits for the
    /// one opposite.
    fn shows(&mut self, pass: &Frame) -> bool {
        self.taken += pass.sample_count;
        let shows = self.taken.is_multiple_of(2) && self.taken < self.wanted && self.shown.elapsed() >= REFINEMENT;
        if shows {
            self.shown = Instant::now();
        }
        shows
    }
}

impl Worker {
    fn work(mut self, queue: &Receiver<Task>) {
        while let Ok(task) = queue.recv() {
            let result = match &task.purpose {
                Purpose::Save(destination) => {
                    let saved = caught(|| self.save(&task, destination));
                    let saved = saved.unwrap_or_else(|accident| Err(SaveError::Accident(accident)));
                    self.mailbox.send(Notice::Saved(saved));
                    Ok(())
                }
                Purpose::Show { .. } => self.show(&task),
            };
            self.mailbox.send(Notice::Finished(result));
        }
    }

    fn show(&mut self, task: &Task) -> Result<(), RenderError> {
        match &task.engine {
            Engine::Cpu => caught(|| {
                self.uploaded = None;
                self.spare.clear();
                self.show_cpu(task);
            })
            .map_err(RenderError::Accident),
            Engine::Gpu(gpu) => {
                let shown = caught(|| self.show_gpu(task, gpu)).unwrap_or_else(|accident| {
                    Err(BackendError::Failed {
                        adapter: gpu.name.clone(),
                        reason: format!("by a mistake in oktant or its driver: {accident}; please report it"),
                    })
                });
                Ok(shown?)
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
            let mut refinement = Refinement::new(&frame);
            for pass in passes(&frame) {
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
                frame.sample_count,
                complete,
            );
        }
    }

    fn show_gpu(&mut self, task: &Task, gpu: &Arc<Gpu>) -> Result<(), BackendError> {
        let Some(plan) = Plan::new(task) else { return Ok(()) };
        for (frame, complete) in plan.pictures {
            let picture = self.spare_picture(gpu, frame.size().into())?;
            if !self.refine(task, gpu, &picture, &frame, Some(plan.number))? {
                return Ok(());
            }
            self.send(plan.number, &frame, Image::Gpu(picture), frame.sample_count, complete);
        }
        Ok(())
    }

    /// Takes all samples of a frame, at once where that is quick. A picture with a number is shown meanwhile, and may
    /// be cancelled: returns false then.
    ///
    /// The window may show what the next pass adds to: the device does one after the other, so that it finds each pixel
    /// with its last pass or without.
    fn refine(
        &mut self,
        task: &Task,
        gpu: &Arc<Gpu>,
        picture: &Arc<GpuPicture>,
        frame: &Frame,
        number: Option<u64>,
    ) -> Result<bool, BackendError> {
        let mut refinement = Refinement::new(frame);
        let is_quick = self.upload(gpu, &task.scene)?.paces.time(frame.depth, rays(frame)) <= GPU_PASS;
        let frames = if is_quick {
            vec![*frame]
        } else {
            passes(frame).collect()
        };
        for pass in frames {
            if number.is_some() && self.cancelled() {
                return Ok(false);
            }
            let uploaded = self.upload(gpu, &task.scene)?;
            let milliseconds = gpu.render_pass_timed(&uploaded.there, picture, &pass)?;
            uploaded.paces.measured(pass.depth, rays(&pass), milliseconds);
            let shows = refinement.shows(&pass);
            self.passed(refinement.taken, &pass, milliseconds);
            if let (true, Some(number)) = (shows, number) {
                self.send(number, frame, Image::Gpu(picture.clone()), refinement.taken, false);
            }
        }
        Ok(true)
    }

    /// The scene in the GPU's memory.
    fn upload(&mut self, gpu: &Arc<Gpu>, scene: &Arc<Scene>) -> Result<&mut Uploaded, BackendError> {
        let there = self.uploaded.take().filter(|uploaded| {
            std::ptr::eq(uploaded.gpu.as_ptr(), Arc::as_ptr(gpu))
                && std::ptr::eq(uploaded.scene.as_ptr(), Arc::as_ptr(scene))
        });
        // An old one is gone by now: both may not fit.
        let uploaded = match there {
            Some(uploaded) => uploaded,
            None => Uploaded {
                gpu: Arc::downgrade(gpu),
                scene: Arc::downgrade(scene),
                there: gpu.upload(scene)?,
                paces: DepthPaces::guessed(scene.is_plain()),
            },
        };
        Ok(self.uploaded.insert(uploaded))
    }

    /// A picture in the GPU's memory that nobody looks at.
    fn spare_picture(&mut self, gpu: &Arc<Gpu>, size: [u32; 2]) -> Result<Arc<GpuPicture>, BackendError> {
        let free =
            |picture: &&Arc<GpuPicture>| Arc::strong_count(picture) == 1 && [picture.width, picture.height] == size;
        if let Some(picture) = self.spare.iter().find(free) {
            return Ok(picture.clone());
        }
        let picture = Arc::new(gpu.picture(size[0], size[1])?);
        if self.spare.len() >= SPARE_PICTURES {
            self.spare.remove(0);
        }
        self.spare.push(picture.clone());
        Ok(picture)
    }

    /// Renders the picture as the command `render` does and writes it.
    fn save(&mut self, task: &Task, destination: &Destination) -> Result<PathBuf, SaveError> {
        let path = match destination {
            Destination::File(path) => path.clone(),
            Destination::Folder(folder) => pictures::next_free(folder),
        };
        let file = PictureFile::create(&path)?;
        let [width, height] = task.size;
        let frame = task.view.frame(&task.scene, width, height);
        let picture = match &task.engine {
            Engine::Cpu => Cpu::new(task.scene.clone()).render(&frame, &silent)?,
            Engine::Gpu(gpu) => {
                let picture = self.spare_picture(gpu, frame.size().into())?;
                self.refine(task, gpu, &picture, &frame, None)?;
                Picture::of_sums(picture.width, picture.height, gpu.read_picture(&picture)?)
            }
        };
        file.save(&picture, &task.view.tone)?;
        Ok(path)
    }
}
