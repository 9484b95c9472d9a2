//! What the renderer is given to do, and when.

use super::application::Application;
use super::pace::draft_size;
use super::schedule::{Decision, Quality};
use super::state::{GpuState, Work};
use super::task::{Destination, Engine, Purpose, Task};
use std::time::Instant;

impl Application {
    /// Gives the renderer what is due; says when there will be something else.
    pub(super) fn work(&mut self, now: Instant) -> Option<Instant> {
        if self.work == Work::Save {
            return None;
        }
        if self.work == Work::Idle
            && let Some(task) = self.saves.pop_front()
        {
            self.work = Work::Save;
            self.renderer.render(task);
            return None;
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
                let edge = match quality {
                    Quality::Draft => self.paces[usize::from(on_gpu)].coarseness(full),
                    Quality::Final => 1,
                };
                let number = self.schedule.started(quality);
                let is_coarse = self.image.as_ref().is_none_or(|image| image.size() != full);
                self.work = Work::Show { edge, on_gpu };
                self.renderer.render(Task {
                    engine,
                    scene,
                    view: self.session.view,
                    size: draft_size(full, edge),
                    purpose: Purpose::Show {
                        number,
                        quality,
                        preview: is_coarse,
                    },
                });
                None
            }
        }
    }

    /// The task to save the picture as it is wanted now.
    pub(super) fn save_task(&self, destination: Destination) -> Option<Task> {
        Some(Task {
            engine: self.engine(),
            scene: self.scene.clone()?,
            view: self.session.view,
            size: self.session.size.map(|side| side.max(1)),
            purpose: Purpose::Save(destination),
        })
    }

    fn engine(&self) -> Engine {
        match &self.gpu {
            GpuState::Open(gpu) if self.wants_gpu => Engine::Gpu(gpu.clone()),
            _ => Engine::Cpu,
        }
    }

    /// Whether everything that was asked for is done and shown.
    pub(super) fn is_settled(&self) -> bool {
        self.schedule.is_settled()
            && self.is_shown
            && self.loading.is_none()
            && self.work == Work::Idle
            && self.saves.is_empty()
            && !matches!(self.gpu, GpuState::Opening { .. })
    }
}
