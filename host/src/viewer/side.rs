//! The panel in the window: what it is told, and what it asks for.

use super::application::Application;
use super::event::Event;
use super::panel::Facts;
use super::pick::material_at;
use super::remembered::Remembered;
use std::time::Instant;
use winit::event::{ElementState, WindowEvent};

impl Application {
    /// Lets the panel have an event of the window's; whether it is for nobody else.
    pub(super) fn panel_takes(&mut self, event: &WindowEvent, meaning: Option<&Event>, now: Instant) -> bool {
        let (Some(window), Some(panel)) = (&self.window, &mut self.panel) else {
            return false;
        };
        let is_taken = panel.take(window, event, meaning, self.session.panel);
        let may_turn = match event {
            WindowEvent::KeyboardInput { event, .. } => is_taken && event.state == ElementState::Pressed,
            event => matches!(event, WindowEvent::MouseInput { .. }),
        };
        self.heed_panel(may_turn, now);
        is_taken
    }

    /// Takes an event that a script made: it is the panel's, or the window's.
    pub(super) fn take_played(&mut self, event: &Event, now: Instant) {
        let is_open = self.session.panel;
        let scale = self.session.scale;
        let panel = self.panel.as_mut();
        let is_taken = panel.is_some_and(|panel| panel.take_played(event, scale, is_open));
        let may_turn = match event {
            Event::Key(_) => is_taken,
            event => matches!(event, Event::Button { .. }),
        };
        self.heed_panel(may_turn, now);
        if !is_taken {
            self.take_event(event, now);
        }
    }

    /// Sees to it that the panel shows what has happened to it. What may have given the keyboard to another is heeded before
    /// anything else happens: the next key may be there before the window is drawn, and is another's then; and egui's fields
    /// drop what follows an Enter that they are told with it.
    fn heed_panel(&mut self, may_turn: bool, now: Instant) {
        if !self.session.panel {
            return;
        }
        if may_turn {
            self.run_panel(now);
        }
        if may_turn || self.panel.as_ref().is_some_and(|panel| panel.is_stale()) {
            self.redraw();
        }
    }

    /// Lays the panel out, if it is open, and does what it asks for.
    pub(super) fn run_panel(&mut self, now: Instant) {
        let (true, Some(window)) = (self.session.panel, self.window.clone()) else {
            return;
        };
        let Some(mut panel) = self.panel.take() else { return };
        let facts = Facts {
            session: &self.session,
            inventory: self.inventory.as_ref(),
            names: &self.names,
            recent: &self.recent,
            wants_gpu: self.wants_gpu,
            figures: &self.figures,
            caption: self.caption(now),
        };
        let asked = panel.run(&window, &facts, now);
        self.panel = Some(panel);
        for input in asked {
            self.take_input(input, now);
        }
    }

    /// Gives the panel's line for steps the keyboard.
    pub(super) fn prompt(&mut self, now: Instant) {
        if let Some(panel) = &mut self.panel {
            panel.prompt.call();
        }
        self.heed_panel(true, now);
    }

    /// Shows the material of what is there in the panel, if there is something.
    pub(super) fn pick(&mut self, at: [f64; 2]) {
        let (Some(scene), Some(panel)) = (&self.scene, &mut self.panel) else {
            return;
        };
        if let Some(material) = material_at(scene, &self.session.view, self.session.size, at) {
            panel.show_material(material);
            self.session.panel = true;
            self.redraw();
        }
    }

    /// When the panel wants to be drawn again; it is drawn if that is now.
    pub(super) fn panel_wake(&mut self, now: Instant) -> Option<Instant> {
        let panel = self
            .panel
            .as_ref()
            .filter(|_| self.session.panel && self.session.is_visible())?;
        let wake = panel.wake()?;
        if wake > now {
            return Some(wake);
        }
        self.redraw();
        None
    }

    /// Whether what the panel shows is what it would show now.
    pub(super) fn is_panel_settled(&self, now: Instant) -> bool {
        !self.session.panel || self.panel.as_ref().is_none_or(|panel| panel.is_settled(now))
    }

    /// Writes down how the panel is left, the views that were saved, and what was opened.
    pub(super) fn remember(&self) {
        let Some(panel) = &self.panel else { return };
        let mut views = self.state.views_now();
        views.extend(&self.saved_views);
        let remembered = Remembered {
            panel: self.session.panel,
            recent: self.recent.clone(),
            layout: panel.layout.clone(),
            views,
        };
        if let Err(sentence) = self.state.write(&remembered) {
            eprintln!("{sentence}");
        }
    }
}
