//! What follows from the notices of the threads.

use super::application::Application;
use super::notice::{Notice, RenderError, Rendered, SaveError};
use super::schedule::Quality;
use super::screen::Screen;
use super::showing::Part;
use super::state::{GpuState, SaveProgress, Work};
use crate::backend::BackendError;
use std::time::Instant;

impl Application {
    /// Takes news from a thread.
    pub(super) fn take_notice(&mut self, notice: Notice, now: Instant) {
        match notice {
            Notice::Loading { load, stage, fraction } => {
                if self.loads.progressed(load, stage, fraction) {
                    self.redraw();
                }
            }
            Notice::Loaded { load, result } => self.take_load(load, result, now),
            Notice::Counted { load, inventory } => {
                if load == self.shown_load {
                    self.inventory = Some(inventory);
                    self.redraw();
                }
            }
            Notice::Chosen { paths, beside } => self.take_chosen(paths, beside, now),
            Notice::Changed => self.reload(),
            Notice::KernelChanged => self.reload_kernel(),
            Notice::KernelSwapped(result) => self.take_kernel(result, now),
            Notice::GpuOpened(Ok(gpu)) => {
                self.gpu = GpuState::Open(gpu.0);
                if self.wants_gpu {
                    self.schedule.change(now);
                }
                self.reload_stale_kernel();
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
                    self.reload_stale_kernel();
                }
            }
            Notice::Rendered(rendered) => self.take_picture(rendered),
            Notice::Refined {
                samples,
                rays,
                milliseconds,
            } => {
                self.figures.pass(samples, rays, milliseconds);
                if let Work::Show { draft, on_gpu } = self.work {
                    self.paces[usize::from(on_gpu)].measured(draft.is_shallow, rays, milliseconds);
                    self.redraw();
                }
            }
            Notice::RaysCounted { closest, shadow } => {
                self.figures.kinds = Some([closest, shadow]);
                self.redraw();
            }
            Notice::Finished(result) => {
                if let Err(error @ RenderError::Accident(_)) = &result {
                    // The same picture would go wrong again.
                    self.schedule.gives_up();
                    self.tell(error.to_string(), true);
                }
                if matches!(self.work, Work::Show { .. }) {
                    self.schedule.finished();
                }
                self.work = Work::Idle;
                if let Err(RenderError::Backend(error)) = result {
                    self.gpu_gave_up(&error, now);
                }
            }
            Notice::Compared { number, result } => self.take_comparison(number, result),
            Notice::Told { desk, number, told } => self.take_told(desk, number, told),
            Notice::Saving { path, fraction } => {
                self.saving = Some(SaveProgress { path, fraction });
                self.redraw();
            }
            Notice::Saved(result) => {
                self.saving = None;
                self.last_save = Some(match &result {
                    Ok(path) => Ok(path.clone()),
                    Err(error) => Err(error.to_string()),
                });
                match result {
                    Ok(path) => self.tell(format!("The picture is in {}.", path.display()), false),
                    Err(SaveError::Backend(error @ BackendError::Lost { .. })) => self.gpu_gave_up(&error, now),
                    Err(error) => self.tell(error.to_string(), true),
                }
            }
        }
    }

    fn take_picture(&mut self, rendered: Rendered) {
        if !self.schedule.takes(rendered.number) {
            return;
        }
        let quality = if rendered.complete {
            Quality::Final
        } else {
            Quality::Draft
        };
        self.schedule.shows(rendered.number, quality);
        self.image = Some(rendered.image);
        self.samples = rendered.samples;
        // The eye whose turn it was keeps it.
        self.part = match (rendered.is_stacked, self.part) {
            (false, _) => Part::Whole,
            (true, Part::Whole) => Part::Upper,
            (true, part) => part,
        };
        self.is_shown = false;
        self.redraw();
    }

    /// Goes on with the CPU.
    pub(super) fn gpu_failed(&mut self, sentence: String, now: Instant) {
        self.wants_gpu = false;
        self.gpu = GpuState::Closed;
        self.image = None;
        self.part = Part::Whole;
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
