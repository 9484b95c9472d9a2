//! What the renderer is given to do, and when.

use super::application::Application;
use super::draft::Draft;
use super::kernel_file::KernelFile;
use super::schedule::{Decision, Quality};
use super::state::{GpuState, SaveProgress, Work};
use super::task::{Destination, Effort, Engine, Purpose, Task};
use crate::stereo::StereoMode;
use std::time::Instant;

impl Application {
    /// Gives the renderer what is due; says when there will be something else.
    pub(super) fn work(&mut self, now: Instant) -> Option<Instant> {
        if self.saving.is_none()
            && let Some((destination, task)) = self.saves.pop_front()
        {
            self.saving = Some(SaveProgress {
                path: destination.path().to_path_buf(),
                fraction: 0.0,
            });
            self.renderer.save(task);
            self.redraw();
        }
        if !self.session.is_visible() {
            return None;
        }
        let scene = self.scene.clone()?;
        match self.schedule.next(now) {
            Decision::Nothing => None,
            Decision::Wait(time) => Some(time),
            Decision::Cancel => {
                self.renderer.cancel();
                None
            }
            Decision::Start(quality) => {
                let engine = self.engine();
                let on_gpu = matches!(engine, Engine::Gpu(_));
                let full = self.session.size;
                let view = self.session.view;
                let draft = match quality {
                    Quality::Draft => self.paces[usize::from(on_gpu)].draft(&view, &scene.light, full, self.target),
                    Quality::Final => Draft::FINE,
                };
                let effort = match quality {
                    Quality::Draft => Effort::Draft(draft),
                    Quality::Final => Effort::Full {
                        preview: self.last_draft.is_coarse(),
                    },
                };
                self.last_draft = draft;
                let number = self.schedule.started(quality);
                self.work = Work::Show { draft, on_gpu };
                self.renderer.show(Task {
                    engine,
                    scene,
                    view,
                    size: full,
                    purpose: Purpose::Show { number, effort },
                });
                None
            }
        }
    }

    /// The task to save the picture as it is wanted now.
    pub(super) fn save_task(&self, destination: Destination) -> Option<Task> {
        let mut view = self.session.view;
        let mut size = self.session.size.map(|side| side.max(1));
        // In a file there are no turns: both whole pictures stand side by side.
        if let Some(stereo) = &mut view.stereo
            && stereo.mode == StereoMode::Sequential
        {
            stereo.mode = StereoMode::SideBySide;
            size[0] *= 2;
        }
        Some(Task {
            engine: self.engine(),
            scene: self.scene.clone()?,
            view,
            size,
            purpose: Purpose::Save(destination),
        })
    }

    pub(super) fn engine(&self) -> Engine {
        match &self.gpu {
            GpuState::Open(gpu) if self.wants_gpu && self.recovery.fits(self.shown_load) => Engine::Gpu(gpu.clone()),
            _ => Engine::Cpu,
        }
    }

    /// Gives up what is not saved yet, and says so: the window closes.
    pub(super) fn abandon_saves(&mut self) {
        // Nobody waits for a picture that was only to be shown.
        let mut unsaved = match self.saving {
            Some(_) => self.renderer.close(),
            None => Vec::new(),
        };
        unsaved.extend(self.saves.drain(..).map(|(destination, _)| destination));
        if !unsaved.is_empty() {
            let names: Vec<String> = unsaved.iter().map(ToString::to_string).collect();
            eprintln!(
                "Not saved, because the window was closed: {}; next time, wait until it says where the picture is.",
                names.join(", ")
            );
        }
    }

    /// Whether everything that was asked for is done and shown.
    pub(super) fn is_settled(&self, now: Instant) -> bool {
        self.schedule.is_settled()
            && self.is_panel_settled(now)
            && self.is_shown
            && self.is_compared()
            && self.has_looked()
            && self.loads.loading().is_none()
            && self.work == Work::Idle
            && self.saving.is_none()
            && self.saves.is_empty()
            && !matches!(self.gpu, GpuState::Opening { .. })
            && !self.kernel.as_ref().is_some_and(KernelFile::is_under_way)
    }
}
