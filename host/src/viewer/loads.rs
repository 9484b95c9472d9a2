//! What is loaded into the window, and again when it was saved.

use super::application::Application;
use super::draft::Paces;
use super::loader::{self, Arrival};
use super::notice::LoadError;
use super::state::Loading;
use crate::source::Source;
use std::time::Instant;
use winit::dpi::PhysicalSize;

impl Application {
    /// Begins to load a source in place of what is shown.
    pub(super) fn load(&mut self, source: Source) {
        self.begin_load(source, false);
    }

    /// Reads again what is shown: one of its files was saved.
    pub(super) fn reload(&mut self) {
        // What somebody just dropped takes the place of what was saved.
        if self.loading.as_ref().is_none_or(|loading| loading.is_reload) {
            self.begin_load(self.source.clone(), true);
        }
    }

    fn begin_load(&mut self, source: Source, is_reload: bool) {
        self.loads += 1;
        self.loading = Some(Loading {
            source: source.clone(),
            stage: "reading",
            fraction: 0.0,
            is_reload,
        });
        loader::load(self.loads, source, self.options.octree, &self.mailbox);
        self.redraw();
    }

    /// Takes what the loader made of the newest load.
    pub(super) fn take_load(&mut self, result: Result<Box<Arrival>, LoadError>, now: Instant) {
        let Some(loading) = self.loading.take() else { return };
        self.reloads += u64::from(loading.is_reload);
        match result {
            Ok(arrival) => self.take_arrival(loading, *arrival, now),
            Err(error) if self.scene.is_none() => self.fail(error),
            Err(error) => {
                self.tell(error.to_string(), true);
                if let Some(message) = &mut self.message {
                    message.is_about_load = true;
                }
            }
        }
    }

    fn take_arrival(&mut self, loading: Loading, arrival: Arrival, now: Instant) {
        let view = self.options.look.applied(arrival.view);
        let focus = arrival.scene.focus;
        let is_first = self.scene.is_none();
        if is_first || loading.is_reload {
            let is_elsewhere = arrival.focus != self.focus;
            self.session.update(view, focus, is_elsewhere);
        } else {
            self.session.open(view, focus);
        }
        if let (true, None, Some(size)) = (is_first, self.options.size, arrival.size) {
            self.fit_window(size, now);
        }
        self.paces = [Paces::guessed(arrival.scene.is_plain()); 2];
        self.scene = Some(arrival.scene);
        self.focus = arrival.focus;
        self.source = loading.source;
        self.watcher.watch(arrival.stamps);
        self.message.take_if(|message| message.is_about_load);
        self.schedule.change(now);
    }

    /// Gives the window's inside the size that the scene asks for.
    fn fit_window(&mut self, size: [u32; 2], now: Instant) {
        let Some(window) = &self.window else {
            // It opens with that size.
            self.session.size = size;
            return;
        };
        if let Some(granted) = window.request_inner_size(PhysicalSize::new(size[0], size[1])) {
            // At once, without an event.
            let resized = self.resized([granted.width, granted.height]);
            self.take_event(&resized, now);
        }
    }
}
