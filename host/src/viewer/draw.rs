//! Drawing the window.

use super::application::Application;
use super::caption::{self, Caption};
use super::layers::Layers;
use super::notice::Image;
use super::oracle::veiled;
use super::overlay::{Line, Overlay, fitted};
use super::screen::Screen;
use super::showing::Showing;
use super::state::GpuState;
use crate::picture::Picture;
use crate::view::Shading;
use glam::Vec3;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A drawing that failed for the moment is tried again after this.
const RETRY: Duration = Duration::from_millis(50);
/// Shown until there is a picture, linear RGB.
const EMPTY: Vec3 = Vec3::new(0.045, 0.06, 0.085);

impl Application {
    /// Draws the window.
    pub(super) fn draw(&mut self, now: Instant) {
        let (Some(window), true) = (self.window.clone(), self.session.is_visible()) else {
            return;
        };
        // How wide it is decides where lines of the overlay end.
        self.run_panel(now);
        self.update_overlay(now);
        let title = self.title();
        if title != self.title {
            window.set_title(&title);
            self.title = title;
        }
        let image = self
            .image
            .clone()
            .unwrap_or_else(|| Image::Cpu(Arc::new(Picture::of_sums(1, 1, vec![EMPTY.extend(1.0)]))));
        // The first picture of the GPU's: from now on it draws the window.
        if let (GpuState::Open(gpu), Image::Gpu(_)) = (&self.gpu, &image)
            && !self.screen.as_ref().is_some_and(|screen| screen.is_drawn_by(gpu))
        {
            let gpu = gpu.clone();
            self.screen = None;
            match Screen::gpu(window, gpu) {
                Ok(screen) => self.screen = Some(screen),
                Err(error) => {
                    self.screen_gave_up(error, now);
                    return;
                }
            }
        }
        let (image, showing) = self.shown().unwrap_or((image, self.showing()));
        let veiled = self.veiled_overlay();
        let Some(screen) = &mut self.screen else { return };
        if !screen.shows(&image) {
            return;
        }
        let layers = Layers {
            overlay: veiled.as_ref().unwrap_or(&self.overlay),
            panel: self.panel.as_ref().and_then(|panel| panel.painting(&self.session)),
            showing,
        };
        let drawn = screen.draw(&image, &layers, self.session.size);
        if drawn == Ok(true) {
            self.figures.drawn += 1;
            self.plan_turn(now);
        }
        match drawn {
            Ok(true) if self.image.is_some() && !self.is_shown => {
                self.is_shown = true;
                self.figures.frame(now);
                if let Some(asked) = self.schedule.answered() {
                    self.figures.response(asked, Instant::now());
                }
                let elapsed = self.start.elapsed();
                self.figures.first_picture.get_or_insert(elapsed);
            }
            Ok(true) => {}
            Ok(false) => self.retry = Some(now + RETRY),
            Err(error) => self.screen_gave_up(error, now),
        }
    }

    /// How the picture is shown now.
    pub(super) fn showing(&self) -> Showing {
        Showing {
            tone: self.session.view.tone,
            part: self.part,
        }
    }

    /// The overlay over what the oracle finds and over lines of cells, if those are to be seen.
    pub(super) fn veiled_overlay(&self) -> Option<Overlay> {
        let findings = self.findings();
        self.lined(findings.map(|findings| veiled(&self.overlay, findings, self.part, self.session.size)))
    }

    fn update_overlay(&mut self, now: Instant) {
        let scale = (self.session.scale.round() as u32).max(1);
        let columns = Overlay::columns(self.free_width(), scale);
        let mut panels = Vec::new();
        if self.session.figures {
            panels.push(fitted(caption::figures(&self.caption(now)), columns));
        } else {
            let under_way = self.under_way();
            panels.extend(under_way.iter().map(|text| caption::message(text, false, columns)));
        }
        if self.session.help {
            panels.push(caption::help());
        }
        panels.push(fitted(self.recent_lines(), columns));
        // Whoever wants no figures wants to see the picture, unless something went wrong.
        if let Some(message) = &self.message
            && (message.is_warning || self.session.figures)
        {
            panels.push(caption::message(&message.text, message.is_warning, columns.min(100)));
        }
        if self.session.oracle {
            panels.push(fitted(self.oracle_legend(), columns));
        }
        panels.extend(self.sight_panels(columns.min(60)));
        self.set_panels(panels, scale);
    }

    /// How wide the overlay may be, pixels: as the window, or as what the open panel leaves of it.
    fn free_width(&self) -> u32 {
        let width = self.session.size[0];
        let panel = self.panel.as_ref().filter(|_| self.session.panel);
        panel.map_or(width, |panel| panel.layout.width_beside(width, self.session.scale))
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
            triangles: self.scene.as_ref().map(|scene| scene.ids.len()),
            size: self.session.size,
            samples: [self.session.view.samples.count(), self.figures.samples],
            phong: self.session.view.shading == Shading::Phong,
            depth: self.session.view.depth,
            tone: self.session.view.tone,
            parallel: self.session.parallel_height(),
            flight: self.session.flying_speed(),
            stereo: self
                .session
                .view
                .stereo
                .map(|stereo| (stereo.mode, self.session.eye_distance())),
            backend: self.backend_name(),
            under_way: self.under_way(),
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
        let loading = self.loads.loading()?;
        let percent = (loading.fraction * 100.0).round();
        Some(format!("{} {}: {percent} %", loading.stage, loading.source))
    }

    /// What is done at this moment, and how far it is.
    fn under_way(&self) -> Vec<String> {
        let saving = self.saving.as_ref().map(|saving| {
            let percent = (saving.fraction * 100.0).round();
            format!("saving {}: {percent} %", saving.path.display())
        });
        self.loading_text().into_iter().chain(saving).collect()
    }

    fn title(&self) -> String {
        match (self.loads.loading(), &self.scene) {
            (Some(_), _) => format!("oktant - {}", self.loading_text().unwrap_or_default()),
            (None, Some(scene)) => format!(
                "oktant - {} - {} triangles - {}",
                self.source,
                caption::grouped(scene.ids.len()),
                self.backend_name()
            ),
            (None, None) => "oktant".into(),
        }
    }
}
