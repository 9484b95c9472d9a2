//! What the window has rendered, and draws.

use super::application::{Application, GpuState, Work};
use super::caption::{self, Caption};
use super::notice::{Image, Notice};
use super::overlay::{Line, Overlay};
use super::pace::draft_size;
use super::renderer::{Destination, Engine, Purpose, Task};
use super::schedule::{Decision, Quality};
use super::screen::{Screen, ScreenError};
use crate::picture::Picture;
use crate::view::Samples;
use glam::Vec3;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A drawing that failed for the moment is tried again after this.
const RETRY: Duration = Duration::from_millis(50);
/// Shown until there is a picture, linear RGB.
const EMPTY: Vec3 = Vec3::new(0.045, 0.06, 0.085);

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
                    Ok(scene) => {
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

    /// Goes on with the CPU.
    fn gpu_failed(&mut self, sentence: String, now: Instant) {
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

    /// Draws the window.
    pub(super) fn draw(&mut self, now: Instant) {
        let (Some(window), true) = (self.window.clone(), self.session.is_visible()) else {
            return;
        };
        self.update_overlay(now);
        let title = self.title();
        if title != self.title {
            window.set_title(&title);
            self.title = title;
        }
        let image = self.image.clone().unwrap_or_else(|| {
            Image::Cpu(Arc::new(Picture {
                width: 1,
                height: 1,
                sums: vec![EMPTY.extend(1.0)],
            }))
        });
        // The first picture of the GPU's: from now on it draws the window.
        if let (GpuState::Open(gpu), Image::Gpu(_)) = (&self.gpu, &image)
            && !self.screen.as_ref().is_some_and(|screen| screen.is_drawn_by(gpu))
        {
            let gpu = gpu.clone();
            self.screen = None;
            match Screen::gpu(window, gpu) {
                Ok(screen) => self.screen = Some(screen),
                Err(error) => {
                    self.gpu_failed(error.to_string(), now);
                    return;
                }
            }
        }
        let Some(screen) = &mut self.screen else { return };
        if !screen.shows(&image) {
            return;
        }
        match screen.draw(&image, &self.overlay, self.session.size) {
            Ok(true) if self.image.is_some() && !self.is_shown => {
                self.is_shown = true;
                self.figures.frame(now);
                let elapsed = self.start.elapsed();
                self.figures.first_picture.get_or_insert(elapsed);
            }
            Ok(true) => {}
            Ok(false) => self.retry = Some(now + RETRY),
            Err(ScreenError::Backend(error)) => self.gpu_failed(error.and_the_cpu_renders(), now),
            Err(error @ ScreenError::Surface(_)) => self.gpu_failed(error.to_string(), now),
            Err(error @ ScreenError::Software(_)) => self.fail(error),
        }
    }

    fn update_overlay(&mut self, now: Instant) {
        let scale = (self.session.scale.round() as u32).max(1);
        let mut panels = Vec::new();
        if self.session.figures {
            panels.push(caption::figures(&self.caption(now)));
        } else if let Some(loading) = self.loading_text() {
            panels.push(caption::message(&loading, false, usize::MAX));
        }
        if self.session.help {
            panels.push(caption::help());
        }
        // Whoever wants no figures wants to see the picture, unless something went wrong.
        if let Some(message) = &self.message
            && (message.is_warning || self.session.figures)
        {
            let columns = Overlay::columns(self.session.size[0], scale).min(100);
            panels.push(caption::message(&message.text, message.is_warning, columns));
        }
        self.set_panels(panels, scale);
    }

    fn set_panels(&mut self, panels: Vec<Vec<Line>>, scale: u32) {
        if panels != self.panels {
            self.overlay = Overlay::new(&panels, scale);
            self.panels = panels;
        }
    }

    /// What the figures are now.
    pub(super) fn caption(&self, now: Instant) -> Caption {
        Caption {
            frames_a_second: self.figures.frames_a_second(now),
            kernel: self.figures.kernel,
            megarays_a_second: self.figures.megarays_a_second(),
            triangles: self.scene.as_ref().map(|scene| scene.triangles.len()),
            size: self.session.size,
            samples: [self.session.view.samples.count(), self.figures.samples],
            phong: self.session.view.shading == crate::view::Shading::Phong,
            backend: self.backend_name(),
            loading: self.loading_text(),
        }
    }

    /// What rendered the picture that is shown.
    pub(super) fn backend_name(&self) -> String {
        let cpu = || format!("CPU, {} threads", rayon::current_num_threads());
        match (&self.gpu, &self.image) {
            (GpuState::Open(gpu), Some(Image::Gpu(_))) => gpu.name.clone(),
            (GpuState::Opening { .. }, _) => format!("{} (the GPU is being opened)", cpu()),
            _ => cpu(),
        }
    }

    fn loading_text(&self) -> Option<String> {
        let loading = self.loading.as_ref()?;
        let percent = (loading.fraction * 100.0).round();
        Some(format!("{} {}: {percent} %", loading.stage, loading.source))
    }

    fn title(&self) -> String {
        match (&self.loading, &self.scene) {
            (Some(_), _) => format!("oktant - {}", self.loading_text().unwrap_or_default()),
            (None, Some(scene)) => format!(
                "oktant - {} - {} triangles - {}",
                self.source,
                caption::grouped(scene.triangles.len()),
                self.backend_name()
            ),
            (None, None) => "oktant".into(),
        }
    }
}
