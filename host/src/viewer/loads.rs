//! What is loaded into the window, and again when it was saved.

use super::application::Application;
use super::draft::Paces;
use super::loader::{self, Arrival, Refusal};
use super::state::{About, Loading};
use super::warnings;
use crate::scene::Staging;
use crate::source::Source;
use crate::standpoint::Origin;
use crate::structure::StructureOptions;
use std::path::PathBuf;
use std::thread;
use std::time::Instant;
use winit::dpi::PhysicalSize;

impl Application {
    /// Begins to load a source in place of what is shown.
    pub(super) fn load(&mut self, source: Source) {
        let load = self.loads.open(source);
        self.begin_load(Some(load));
    }

    /// Begins to load what files hold in place of what is shown.
    pub(super) fn open_files(&mut self, paths: Vec<PathBuf>) {
        match Source::from_paths(paths) {
            Ok(source) => self.load(source),
            Err(error) => self.tell(error.to_string(), true),
        }
    }

    /// Begins to load what files hold beside what is shown, or is about to be.
    pub(super) fn add_files(&mut self, paths: Vec<PathBuf>) {
        let loading = self.loads.loading().filter(|loading| !loading.is_reload);
        let source = loading.map_or(&self.source, |loading| &loading.source);
        match source.with(paths) {
            Ok(source) => {
                let load = self.loads.extend(source);
                self.begin_load(Some(load));
            }
            Err(error) => self.tell(error.to_string(), true),
        }
    }

    /// Reads again what is shown: one of its files was saved.
    pub(super) fn reload(&mut self) {
        let load = self.loads.reload(&self.source);
        self.begin_load(load);
    }

    fn begin_load(&mut self, load: Option<u64>) {
        if let (Some(load), Some(loading)) = (load, self.loads.loading()) {
            self.building = self.session.structure;
            let source = loading.source.clone();
            // What is opened later has other materials.
            let set = if source == self.options.source {
                self.options.set.clone()
            } else {
                Vec::new()
            };
            loader::load(load, source, set, self.building, &self.mailbox);
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
                let (wanted, tried) = (self.session.structure, self.building);
                self.session.structure = still_wanted(wanted, tried, self.built, loading.is_reload);
                let about = if loading.is_reload { About::Reload } else { About::Load };
                self.warn(refusal.error.to_string(), about);
                if loading.is_reload {
                    self.watcher.watch_also(refusal.stamps);
                }
            }
        }
        let next = if self.session.structure == self.built {
            self.loads.next(&self.source)
        } else {
            // It was chosen meanwhile.
            self.loads.reload(&self.source)
        };
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
        } else if loading.is_addition {
            // Seen from where it was: distances are counted in what there is to see.
            self.session.update(view, focus, false);
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
        let old = self.scene.replace(arrival.scene);
        // Giving a large one back takes as long as dozens of frames.
        thread::spawn(move || drop(old));
        self.built = self.building;
        self.session.seeing.trace(self.built.parts.traversal);
        self.inventory = None;
        self.focus = arrival.focus;
        self.sight.shift = arrival.shift;
        if !loading.is_reload {
            self.session.seeing.pin = None;
            self.recent.opened(&loading.source);
        }
        self.source = loading.source;
        let saved = self.views_of_scene();
        self.session.arrive(shift, saved);
        self.watcher.watch(arrival.stamps);
        // What is read again says nothing of another file that was refused.
        self.message
            .take_if(|message| message.about == About::Reload || (message.about == About::Load && !loading.is_reload));
        if let Some(sentence) = warnings::sentence(&arrival.warnings) {
            // Whoever listens to standard error has heard all of them; read again, the files may be complete.
            self.show_message(sentence, true, About::Reload);
        }
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

/// The structure that is wanted after a load was refused. What was tried for what is shown cannot be had, which keeps the one
/// that was built; what was chosen otherwise stays chosen.
fn still_wanted(
    wanted: StructureOptions,
    tried: StructureOptions,
    built: StructureOptions,
    is_reload: bool,
) -> StructureOptions {
    if is_reload && wanted == tried { built } else { wanted }
}

#[cfg(test)]
mod tests {
    use super::*;
    use oktant_shared::parts::TraversalKind;

    #[test]
    fn only_a_structure_that_was_tried_in_vain_is_given_up() {
        let [octants, grid, bvh2] =
            [TraversalKind::Octants, TraversalKind::Grid, TraversalKind::Bvh2].map(StructureOptions::of);
        assert_eq!(still_wanted(grid, grid, octants, true), octants);
        assert_eq!(still_wanted(bvh2, grid, octants, true), bvh2, "chosen meanwhile");
        assert_eq!(
            still_wanted(grid, grid, octants, false),
            grid,
            "it was the file's fault"
        );
        assert_eq!(still_wanted(octants, octants, octants, false), octants);
    }
}
