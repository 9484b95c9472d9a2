//! What is loaded into the window, and again when it was saved.

use super::application::Application;
use super::draft::Paces;
use super::loader::{self, Arrival, Refusal};
use super::state::Loading;
use crate::scene::Staging;
use crate::source::Source;
use crate::standpoint::Origin;
use std::time::Instant;
use winit::dpi::PhysicalSize;

impl Application {
    /// Begins to load a source in place of what is shown.
    pub(super) fn load(&mut self, source: Source) {
        let load = self.loads.open(source);
        self.begin_load(Some(load));
    }

    /// Reads again what is shown: one of its files was saved.
    pub(super) fn reload(&mut self) {
        let load = self.loads.reload(&self.source);
        self.begin_load(load);
    }

    fn begin_load(&mut self, load: Option<u64>) {
        if let (Some(load), Some(loading)) = (load, self.loads.loading()) {
            self.building = self.session.structure;
            loader::load(load, loading.source.clone(), self.building, &self.mailbox);
            self.redraw();
        }
    }

    /// Takes what the loader made of a load.
    pub(super) fn take_load(&mut self, load: u64, result: Result<Box<Arrival>, Refusal>, now: Instant) {
        let Some(loading) = self.loads.ended(load, result.is_ok()) else {
            return;
        };
        self.reloads += u64::from(loading.is_reload);
        match result {
            Ok(arrival) => {
                self.shown_load = load;
                self.take_arrival(loading, *arrival, now);
            }
            Err(refusal) if self.scene.is_none() => self.fail(refusal.error),
            Err(refusal) => {
                // What is shown still has its old structure.
                self.session.structure = self.built;
                self.tell(refusal.error.to_string(), true);
                if let Some(message) = &mut self.message {
                    message.is_about_load = true;
                }
                if loading.is_reload {
                    self.watcher.watch_also(refusal.stamps);
                }
            }
        }
        let next = self.loads.next(&self.source);
        self.begin_load(next);
    }

    fn take_arrival(&mut self, loading: Loading, arrival: Arrival, now: Instant) {
        let focus = arrival.scene.focus;
        let shift = arrival.shift;
        let view = self.options.look.applied(arrival.view, &Origin { focus, shift });
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
        let staging = Staging::of(&arrival.scene);
        self.session.restage(staging.clone(), loading.is_reload);
        let is_staged = self.session.staging == staging;
        self.names = arrival.names;
        self.scene = Some(arrival.scene);
        self.built = self.building;
        self.inventory = None;
        self.focus = arrival.focus;
        self.sight.shift = arrival.shift;
        if !loading.is_reload {
            self.session.seeing.pin = None;
        }
        self.source = loading.source;
        let saved = self.views_of_scene();
        self.session.arrive(shift, saved);
        self.watcher.watch(arrival.stamps);
        self.message.take_if(|message| message.is_about_load);
        if is_staged {
            self.schedule.change(now);
        } else {
            self.restage(now);
        }
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
