//! What follows from the notices of the threads.

use super::application::Application;
use super::notice::{Image, Notice};
use super::schedule::Quality;
use super::screen::Screen;
use super::state::{GpuState, Work};
use crate::sampling::Samples;
use std::time::Instant;

impl Application {
    /// Takes news from a thread.
    pub(super) fn take_notice(&mut self, notice: Notice, now: Instant) {
        match notice {
            Notice::Loading { load, stage, fraction } => {
                if load == self.loads
                    && let Some(loading) = &mut self.loading
                {
                    (loading.stage, loading.fraction) = (stage, fraction);
                    self.redraw();
                }
            }
            // An older mesh: another one was dropped meanwhile.
            Notice::Loaded { load, .. } if load != self.loads => {}
            Notice::Loaded { result, .. } => {
                let loading = self.loading.take();
                match result {
                    Ok((scene, _)) => {
                        if self.scene.replace(scene).is_some() {
                            self.session.reset();
                        }
                        if let Some(loading) = loading {
                            self.source = loading.source;
                        }
                        self.schedule.change(now);
                    }
                    Err(error) if self.scene.is_none() => self.fail(error),
                    Err(error) => self.tell(error.to_string(), true),
                }
            }
            Notice::GpuOpened(Ok(gpu)) => {
                self.gpu = GpuState::Open(gpu.0);
                if self.wants_gpu {
                    self.schedule.change(now);
                }
            }
            Notice::GpuOpened(Err(error)) => {
                let is_required = matches!(self.gpu, GpuState::Opening { is_required: true });
                self.gpu = GpuState::Closed;
                self.wants_gpu = false;
                if is_required {
                    self.fail(error);
                } else {
                    self.tell(error.and_the_cpu_renders(), true);
                    self.ensure_screen();
                }
            }
            Notice::Rendered(rendered) => self.take_picture(rendered.number, rendered.image, rendered.complete),
            Notice::Refined {
                samples,
                rays,
                milliseconds,
            } => {
                self.figures.pass(samples, rays, milliseconds);
                if let Work::Show { on_gpu, .. } = self.work {
                    self.paces[usize::from(on_gpu)].measured(rays, milliseconds);
                    self.redraw();
                }
            }
            Notice::Finished(result) => {
                if matches!(self.work, Work::Show { .. }) {
                    self.schedule.finished();
                }
                self.work = Work::Idle;
                if let Err(error) = result {
                    self.gpu_failed(error.and_the_cpu_renders(), now);
                }
            }
            Notice::Saved(result) => {
                self.last_save = Some(match &result {
                    Ok(path) => Ok(path.clone()),
                    Err(error) => Err(error.to_string()),
                });
                match result {
                    Ok(path) => self.tell(format!("The picture is in {}.", path.display()), false),
                    Err(error) => self.tell(error.to_string(), true),
                }
            }
        }
    }

    fn take_picture(&mut self, number: u64, image: Image, complete: bool) {
        if !self.schedule.takes(number) {
            return;
        }
        let is_whole = matches!(self.work, Work::Show { edge: 1, .. }) && self.session.view.samples == Samples::One;
        let quality = if complete || is_whole {
            Quality::Final
        } else {
            Quality::Draft
        };
        self.schedule.shows(number, quality);
        self.image = Some(image);
        self.is_shown = false;
        self.redraw();
    }

    /// Goes on with the CPU.
    pub(super) fn gpu_failed(&mut self, sentence: String, now: Instant) {
        self.wants_gpu = false;
        self.gpu = GpuState::Closed;
        self.image = None;
        self.screen = None;
        self.schedule.shows_nothing(now);
        self.ensure_screen();
        self.tell(sentence, true);
    }

    /// Lets the CPU draw the window if nobody does.
    fn ensure_screen(&mut self) {
        if let (Some(window), None) = (&self.window, &self.screen) {
            match Screen::software(window.clone()) {
                Ok(screen) => self.screen = Some(screen),
                Err(error) => self.fail(error),
            }
        }
    }
}
