//! Playing a script in the window.

use super::ViewerError;
use super::adjustment::Adjustment;
use super::application::{Application, sentence};
use super::event::Event;
use super::grammar::step;
use super::input::Input;
use super::layers::Layers;
use super::notice::Image;
use super::player::{self, Counts, PATIENCE};
use super::seeing::See;
use super::state::{About, GpuState};
use super::step::{Expectation, Step};
use crate::output::PictureFile;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};
use winit::dpi::PhysicalSize;

/// How a step goes on.
enum Progress {
    /// It is done.
    Done,
    /// It waits for something.
    Waits,
}

impl Application {
    /// Plays what is due; says when there is more.
    pub(super) fn play(&mut self, now: Instant) -> Option<Instant> {
        let mut player = self.player.take()?;
        // The window must be there for what is played in it.
        while self.window.is_some() && !self.quits {
            if !player.is_idle() {
                match player.event(now) {
                    Some(event) => self.take_played(&event, now),
                    None => break,
                }
                continue;
            }
            let Some((line, step)) = player.step() else {
                self.quits = true;
                break;
            };
            let counts = Counts {
                frames: self.figures.frames,
                reloads: self.reloads,
            };
            let begins = player.begins(now, counts);
            let waited = player.elapsed(now);
            let progress = match self.step(&step, begins, &mut player, now) {
                Ok(Progress::Waits) if waited > PATIENCE + minimum(&step) => Err(format!(
                    "the step is not done after {} s; wait for something else",
                    waited.as_secs()
                )),
                progress => progress,
            };
            match progress {
                Ok(Progress::Done) => player.advance(),
                Ok(Progress::Waits) => break,
                Err(reason) => self.fail(ViewerError::Step {
                    file: player.file().into(),
                    line,
                    reason: reason.trim_end_matches('.').into(),
                }),
            }
        }
        let wakes = player.wakes(now);
        self.player = Some(player);
        Some(wakes)
    }

    fn step(
        &mut self,
        step: &Step,
        begins: bool,
        player: &mut player::Player,
        now: Instant,
    ) -> Result<Progress, String> {
        let (waited, since) = (player.elapsed(now), player.counts());
        let wait_for = |done| Ok(if done { Progress::Done } else { Progress::Waits });
        match step {
            Step::Drag {
                button,
                shift,
                right,
                down,
            } => player.queue(player::drag(self.session.size, *button, *shift, [*right, *down])),
            Step::Click(at) => player.queue(player::click(*at)),
            Step::DoubleClick => player.queue(player::double_click()),
            Step::Wheel(notches) => player.queue([Event::Wheel(*notches)]),
            Step::Key { key, modifiers } => player.queue(player::key(*key, *modifiers)),
            Step::Open(paths) => player.queue([Event::Dropped(paths.clone())]),
            Step::Resize(size) => {
                if let (true, Some(window)) = (begins, &self.window)
                    && let Some(size) = window.request_inner_size(PhysicalSize::new(size[0], size[1]))
                {
                    // Granted at once, without an event.
                    player.queue([self.resized([size.width, size.height])]);
                }
                return wait_for(self.session.size == *size);
            }
            Step::Minimise => {
                if let Some(window) = &self.window {
                    window.set_minimized(true);
                }
                // As Windows tells it; elsewhere nobody does.
                player.queue([self.resized([0, 0])]);
            }
            Step::Restore => {
                if let Some(window) = &self.window {
                    window.set_minimized(false);
                    let size = window.inner_size();
                    player.queue([self.resized([size.width, size.height])]);
                }
            }
            Step::Save(path) => {
                if begins {
                    self.last_save = None;
                    self.take_input(Input::Save(Some(path.clone())), now);
                }
                return match &self.last_save {
                    Some(Ok(_)) => Ok(Progress::Done),
                    Some(Err(error)) => Err(error.clone()),
                    None => Ok(Progress::Waits),
                };
            }
            Step::Move(at) => player.queue([Event::PointerMoved { x: at[0], y: at[1] }]),
            Step::Pin(at) => player.queue(player::pin(*at)),
            Step::LoseDevice => {
                let GpuState::Open(gpu) = &self.gpu else {
                    return Err("no GPU is open; wait for it with: wait settled".into());
                };
                gpu.lose();
                // Whoever does not look never finds out.
                self.schedule.change(now);
            }
            Step::WaitSettled => return wait_for(self.is_settled(now)),
            Step::WaitFrames(count) => return wait_for(self.figures.frames - since.frames >= *count),
            Step::WaitSamples(count) => return wait_for(self.is_shown && u64::from(self.samples) >= *count),
            Step::WaitReloaded => return wait_for(self.reloads > since.reloads),
            Step::WaitMilliseconds(time) => return wait_for(waited >= Duration::from_millis(*time)),
            Step::Expect(expectation) => self.expect(expectation)?,
            step => self.at_once(step, now)?,
        }
        Ok(Progress::Done)
    }

    /// Does a step that is done as soon as it is said.
    fn at_once(&mut self, step: &Step, now: Instant) -> Result<(), String> {
        match step {
            Step::Screenshot(path) => self.screenshot(path, now)?,
            Step::Oracle(wanted) => {
                if self.session.oracle != *wanted {
                    self.take_input(Input::ToggleOracle, now);
                }
            }
            Step::Panel(wanted) => {
                if self.session.panel != *wanted {
                    self.take_input(Input::TogglePanel, now);
                }
            }
            Step::Show(aspect) => {
                if let Some(aspect) = aspect.filter(|aspect| !self.session.seeing.is_told(*aspect)) {
                    return Err(format!(
                        "{aspect} means nothing with --traversal {}; show something else",
                        self.built.parts.traversal
                    ));
                }
                self.take_input(Input::See(See::Aspect(*aspect)), now);
            }
            Step::Unpin => self.take_input(Input::See(See::Unpin), now),
            Step::Ask(input) => self.ask(input.clone(), now)?,
            Step::SetMaterial(material) => {
                let number = material.number(&self.names)?;
                self.ask(Input::Adjust(Adjustment::Material(number, material.adjustment)), now)?;
            }
            Step::PrintCamera(form) => print(&(self.written_camera(*form) + "\n")),
            Step::Print => print(&self.report(now)),
            Step::PrintSettings => print(&self.settings()),
            Step::Quit => self.quits = true,
            _ => return Err("only scripts take this step; give another one, for example: set fov 30".into()),
        }
        Ok(())
    }

    /// Carries out a step that was typed in the panel; else says what is wrong with it and what to do.
    pub(super) fn take_typed(&mut self, line: &str, now: Instant) {
        if let Err(reason) = self.carry_out(line, now) {
            self.warn(sentence(&reason), About::Step);
            return;
        }
        self.message.take_if(|message| message.about == About::Step);
        if let Some(panel) = &mut self.panel {
            panel.prompt.clear();
        }
        self.redraw();
    }

    fn carry_out(&mut self, line: &str, now: Instant) -> Result<(), String> {
        match step(line.trim())? {
            Step::Open(paths) => self.ask(Input::Open(paths), now),
            Step::Save(path) => self.ask(Input::Save(Some(path)), now),
            step => self.at_once(&step, now),
        }
    }

    pub(super) fn resized(&self, size: [u32; 2]) -> Event {
        Event::Resized {
            size,
            scale: self.session.scale,
        }
    }

    fn screenshot(&mut self, path: &Path, now: Instant) -> Result<(), String> {
        self.draw(now);
        let shown = self.shown();
        let veiled = self.veiled_overlay();
        let (Some(screen), Some((image, showing)), true) = (&mut self.screen, &shown, self.session.is_visible()) else {
            return Err("the window shows no picture yet; wait for it with: wait settled".into());
        };
        let size = self.session.size;
        let layers = Layers {
            overlay: veiled.as_ref().unwrap_or(&self.overlay),
            panel: self.panel.as_ref().and_then(|panel| panel.painting(&self.session)),
            showing: *showing,
        };
        let pixels = screen
            .screenshot(image, &layers, size)
            .map_err(|error| error.to_string())?;
        PictureFile::create(path)
            .and_then(|file| file.save_rgb8(&pixels, size))
            .map_err(|error| error.to_string())
    }

    fn expect(&self, expectation: &Expectation) -> Result<(), String> {
        let is_so = match expectation {
            Expectation::FirstPicture(limit) => {
                let first = self.figures.first_picture;
                first.is_some_and(|first| first <= Duration::from_millis(*limit))
            }
            Expectation::Gpu(wanted) => matches!(self.image, Some(Image::Gpu(_))) == *wanted,
            Expectation::Triangles(wanted) => self.scene.as_ref().is_some_and(|scene| scene.ids.len() == *wanted),
            Expectation::Message(part) => self
                .message
                .as_ref()
                .is_some_and(|message| message.text.contains(part.as_str())),
        };
        if is_so {
            return Ok(());
        }
        Err(match expectation {
            Expectation::FirstPicture(_) => match self.figures.first_picture {
                Some(first) => format!("the first picture came after {} ms", first.as_millis()),
                None => "there is no picture yet".into(),
            },
            Expectation::Gpu(_) => format!("the picture comes from: {}", self.backend_name()),
            Expectation::Triangles(_) => match &self.scene {
                Some(scene) => format!("the mesh has {} triangles", scene.ids.len()),
                None => "there is no mesh yet".into(),
            },
            Expectation::Message(_) => match &self.message {
                Some(message) => format!("the message is: {}", message.text),
                None => "there is no message".into(),
            },
        })
    }
}

/// Prints a text for whoever reads standard output; whoever closed it wants no more.
fn print(text: &str) {
    drop(std::io::stdout().write_all(text.as_bytes()));
}

/// How long a step takes at least.
fn minimum(step: &Step) -> Duration {
    match step {
        Step::WaitMilliseconds(time) => Duration::from_millis(*time),
        _ => Duration::ZERO,
    }
}
