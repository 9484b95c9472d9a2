//! The thread that renders, so that the window never waits.

use super::notice::{Image, Mailbox, Notice, Rendered, SaveError};
use super::pace::Pace;
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
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// A pass on the GPU takes no longer, so that it can be given up.
const GPU_PASS: Duration = Duration::from_millis(25);
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
            pace: Pace::default(),
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
    pace: Pace,
}

/// A scene in a GPU's memory, and which one it is.
struct Uploaded {
    gpu: Weak<Gpu>,
    scene: Weak<Scene>,
    there: GpuScene,
}

impl Worker {
    fn work(mut self, queue: &Receiver<Task>) {
        while let Ok(task) = queue.recv() {
            let result = match (&task.purpose, &task.engine) {
                (Purpose::Save(destination), _) => {
                    let saved = self.save(&task, destination);
                    self.mailbox.send(Notice::Saved(saved));
                    Ok(())
                }
                (Purpose::Show { .. }, Engine::Cpu) => {
                    self.uploaded = None;
                    self.spare.clear();
                    self.show_cpu(&task);
                    Ok(())
                }
                (Purpose::Show { .. }, Engine::Gpu(gpu)) => self.show_gpu(&task, gpu),
            };
            self.mailbox.send(Notice::Finished(result));
        }
    }

    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    fn send(&self, number: u64, image: Image, complete: bool) {
        self.mailbox.send(Notice::Rendered(Rendered {
            number,
            image,
            complete,
        }));
    }

    /// Tells the window of a pass and remembers how long it took.
    fn passed(&mut self, frame: &Frame, milliseconds: f64) {
        let size = frame.size();
        let rays = u64::from(size.x) * u64::from(size.y) * u64::from(frame.sample_count);
        self.pace.measured(rays, milliseconds);
        self.mailbox.send(Notice::Refined {
            samples: frame.first_sample + frame.sample_count,
            rays,
            milliseconds,
        });
    }

    fn show_cpu(&mut self, task: &Task) {
        let Some(plan) = Plan::new(task) else { return };
        let cpu = Cpu::new(task.scene.clone());
        let cancel = self.cancel.clone();
        for (frame, complete) in plan.pictures {
            let mut picture = Picture::unwritten(frame.size().x, frame.size().y);
            // One sample at a time: the CPU can be stopped at any tile, but the figures are to move.
            for sample in 0..frame.sample_count {
                let pass = Frame {
                    first_sample: sample,
                    sample_count: 1,
                    ..frame
                };
                let start = Instant::now();
                if !cpu.render_pass(&pass, &mut picture, &cancel, &silent) {
                    return;
                }
                self.passed(&pass, start.elapsed().as_secs_f64() * 1e3);
            }
            self.send(plan.number, Image::Cpu(Arc::new(picture)), complete);
        }
    }

    fn show_gpu(&mut self, task: &Task, gpu: &Arc<Gpu>) -> Result<(), BackendError> {
        let Some(plan) = Plan::new(task) else { return Ok(()) };
        for (frame, complete) in plan.pictures {
            let picture = self.spare_picture(gpu, frame.size().into())?;
            if !self.passes(task, gpu, &picture, &frame, true)? {
                return Ok(());
            }
            self.send(plan.number, Image::Gpu(picture), complete);
        }
        Ok(())
    }

    /// Takes all samples of a frame, as many at once as are quick; false where it was cancelled.
    fn passes(
        &mut self,
        task: &Task,
        gpu: &Arc<Gpu>,
        picture: &GpuPicture,
        frame: &Frame,
        can_cancel: bool,
    ) -> Result<bool, BackendError> {
        self.upload(gpu, &task.scene)?;
        let pixels = u64::from(picture.width) * u64::from(picture.height);
        let mut done = 0;
        while done < frame.sample_count {
            if can_cancel && self.cancelled() {
                return Ok(false);
            }
            let pass = Frame {
                first_sample: done,
                sample_count: self.pace.samples(pixels, frame.sample_count - done, GPU_PASS),
                ..*frame
            };
            let uploaded = self.uploaded.as_ref().expect("uploaded above");
            let milliseconds = gpu.render_pass_timed(&uploaded.there, picture, &pass)?;
            self.passed(&pass, milliseconds);
            done += pass.sample_count;
        }
        Ok(true)
    }

    /// Makes sure that the scene is in the GPU's memory.
    fn upload(&mut self, gpu: &Arc<Gpu>, scene: &Arc<Scene>) -> Result<(), BackendError> {
        let there = self.uploaded.as_ref().is_some_and(|uploaded| {
            std::ptr::eq(uploaded.gpu.as_ptr(), Arc::as_ptr(gpu))
                && std::ptr::eq(uploaded.scene.as_ptr(), Arc::as_ptr(scene))
        });
        if !there {
            // First of all the old one goes: both may not fit.
            self.uploaded = None;
            self.uploaded = Some(Uploaded {
                gpu: Arc::downgrade(gpu),
                scene: Arc::downgrade(scene),
                there: gpu.upload(scene)?,
            });
        }
        Ok(())
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
                self.passes(task, gpu, &picture, &frame, false)?;
                Picture::of_sums(picture.width, picture.height, gpu.read_picture(&picture)?)
            }
        };
        file.save(&picture, &task.view.tone)?;
        Ok(path)
    }
}
