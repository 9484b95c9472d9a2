//! What the event loop calls.

use super::ViewerError;
use super::application::Application;
use super::event::{Event, Modifiers};
use super::held;
use super::notice::Notice;
use super::panel::Panel;
use super::screen::Screen;
use super::state::GpuState;
use std::sync::Arc;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::{Window, WindowId};

impl Application {
    /// Puts off what can wait and says when to wake up.
    fn next_wake(&mut self, now: Instant) -> Option<Instant> {
        if self.message.as_ref().is_some_and(|message| message.until <= now) {
            self.message = None;
            self.redraw();
        }
        if self.figures.expiry().is_some_and(|expiry| expiry <= now) {
            self.figures.forget(now);
            self.redraw();
        }
        if self.retry.is_some_and(|retry| retry <= now) {
            self.retry = None;
            self.redraw();
        }
        if self.next_turn.is_some_and(|turn| turn <= now) {
            self.take_turn();
        }
        let flying = self.fly(now);
        let playing = self.play(now);
        let working = self.work(now);
        self.compare();
        self.look_into();
        let waiting = self.message.as_ref().map(|message| message.until);
        [
            flying,
            playing,
            working,
            waiting,
            self.figures.expiry(),
            self.retry,
            self.next_turn,
            self.panel_wake(now),
        ]
        .into_iter()
        .flatten()
        .min()
    }
}

impl ApplicationHandler<Notice> for Application {
    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        self.pulse.wakes(cause, Instant::now());
    }

    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.window.is_some() {
            return;
        }
        let [width, height] = self.session.size;
        let attributes = Window::default_attributes()
            .with_title("oktant")
            .with_inner_size(PhysicalSize::new(width, height));
        let window = match event_loop.create_window(attributes) {
            Ok(window) => Arc::new(window),
            Err(error) => {
                self.fail(ViewerError::Window(error.to_string()));
                event_loop.exit();
                return;
            }
        };
        match Screen::software(window.clone()) {
            Ok(screen) => self.screen = Some(screen),
            // A display with ten bits a colour, say: a GPU may still draw on it.
            Err(_) if matches!(self.gpu, GpuState::Opening { .. }) => {}
            Err(error) => {
                self.fail(error);
                event_loop.exit();
                return;
            }
        }
        let size = window.inner_size();
        let resized = Event::Resized {
            size: [size.width, size.height],
            scale: window.scale_factor(),
        };
        self.panel = Some(Panel::new(&window, self.state.remembered.layout.clone()));
        self.window = Some(window);
        self.take_event(&resized, Instant::now());
        self.redraw();
    }

    fn user_event(&mut self, _: &ActiveEventLoop, notice: Notice) {
        self.take_notice(notice, Instant::now());
    }

    fn window_event(&mut self, _: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let now = Instant::now();
        if event == WindowEvent::RedrawRequested {
            self.draw(now);
            return;
        }
        let meaning = Event::from_winit(&event, self.session.size, self.session.scale);
        // A script is not disturbed by the hand that happens to hold the mouse.
        let is_taken = self.player.is_none() && self.panel_takes(&event, meaning.as_ref(), now);
        // A key that was pressed before the panel took the keyboard is released for all.
        let is_for_all = !is_taken || matches!(meaning, Some(Event::Released(_)));
        let Some(event) = meaning.filter(|_| is_for_all) else {
            return;
        };
        if let Event::Dropped(paths) = event {
            // One by one, and all of them before the loop waits again; the source is told after that.
            if self.dropped.is_empty() {
                let window = self.window.as_ref().filter(|window| !window.has_focus());
                self.held_at_drop = window.and_then(|window| held::modifiers(window));
            }
            self.dropped.extend(paths);
            return;
        }
        let is_window = matches!(event, Event::Resized { .. } | Event::CloseRequested);
        if self.player.is_none() || is_window {
            self.take_event(&event, now);
        }
        if is_window {
            self.redraw();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let now = Instant::now();
        let dropped = std::mem::take(&mut self.dropped);
        if !dropped.is_empty() && self.player.is_none() {
            let held = self.held_at_drop.take();
            if let Some(held) = held {
                self.take_event(&Event::Modifiers(held), now);
            }
            self.take_event(&Event::Dropped(dropped), now);
            if held.is_some() {
                // Nobody will tell that they are let go.
                self.take_event(&Event::Modifiers(Modifiers::default()), now);
            }
        }
        let wake = self.next_wake(now);
        if self.quits {
            event_loop.exit();
            return;
        }
        event_loop.set_control_flow(wake.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
        self.pulse.rests(Instant::now());
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.renderer.cancel();
        self.comparison.stop();
        self.sight.stop();
        self.abandon_saves();
        self.remember();
        // The screen goes before the window, and both before the event loop.
        self.image = None;
        self.screen = None;
        self.panel = None;
        self.window = None;
    }
}
