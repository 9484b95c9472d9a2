//! What happens to the panel, and what of that is for nobody else.

use super::Panel;
use crate::viewer::event::{Button, Event, Key};
use egui::{Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, TouchPhase, pos2, vec2};
use winit::event::WindowEvent;
use winit::window::Window;

impl Panel {
    /// Takes an event of the window's, and what it is for the viewer; whether it is for nobody else.
    pub fn take(&mut self, window: &Window, event: &WindowEvent, meaning: Option<&Event>, is_open: bool) -> bool {
        let scale = window.scale_factor();
        let is_key = matches!(event, WindowEvent::KeyboardInput { .. } | WindowEvent::Ime(_));
        if is_key && !(is_open && self.has_keyboard()) {
            return false;
        }
        self.is_stale |= is_key;
        let is_pointer = meaning.is_some_and(|event| self.claims(event, scale, is_open));
        let _ = self.winit.on_window_event(window, event);
        if !is_open {
            self.ignore();
        }
        is_key || is_pointer
    }

    /// Takes an event that a script makes; whether it is for nobody else.
    pub fn take_played(&mut self, event: &Event, scale: f64, is_open: bool) -> bool {
        if !is_open {
            return false;
        }
        let is_claimed = match event {
            Event::Key(_) => self.has_keyboard(),
            _ => self.claims(event, scale, is_open),
        };
        let at = self.pointer;
        let modifiers = Modifiers::NONE;
        let events = &mut self.winit.egui_input_mut().events;
        match *event {
            Event::PointerMoved { .. } => events.push(egui::Event::PointerMoved(at)),
            Event::Button { button, pressed } => events.push(egui::Event::PointerButton {
                pos: at,
                button: match button {
                    Button::Left => PointerButton::Primary,
                    Button::Right => PointerButton::Secondary,
                    Button::Middle => PointerButton::Middle,
                },
                pressed,
                modifiers,
            }),
            Event::Wheel(notches) if is_claimed => events.push(egui::Event::MouseWheel {
                unit: MouseWheelUnit::Line,
                delta: vec2(0.0, notches),
                phase: TouchPhase::Move,
                source: MouseWheelSource::Wheel,
                modifiers,
            }),
            Event::Key(Key::Character(character) | Key::Keypad(character)) if is_claimed => {
                events.push(egui::Event::Text(character.to_string()));
            }
            Event::Key(key) if is_claimed => {
                let key = match key {
                    Key::Tab => egui::Key::Tab,
                    _ => egui::Key::Escape,
                };
                events.extend([true, false].map(|pressed| egui::Event::Key {
                    key,
                    physical_key: None,
                    pressed,
                    repeat: false,
                    modifiers,
                }));
            }
            _ => {}
        }
        is_claimed
    }

    /// Whether keys are for something in the panel.
    fn has_keyboard(&self) -> bool {
        self.context.egui_wants_keyboard_input()
    }

    /// Whether an event of the pointer is for the panel alone: a press on it, what follows until the release, and the
    /// wheel over it. Moves are for everybody: whoever holds no button does nothing then.
    fn claims(&mut self, event: &Event, scale: f64, is_open: bool) -> bool {
        let was_covered = is_open && self.covers(self.pointer);
        match *event {
            Event::PointerMoved { x, y } => {
                self.pointer = pos2((x / scale) as f32, (y / scale) as f32);
                self.is_stale |= is_open && (was_covered || self.held > 0 || self.covers(self.pointer));
                false
            }
            Event::Button { pressed: true, .. } => {
                let is_claimed = was_covered || self.held > 0;
                self.held += u32::from(is_claimed);
                is_claimed
            }
            Event::Button { pressed: false, .. } => {
                let is_claimed = self.held > 0;
                self.held = self.held.saturating_sub(1);
                is_claimed
            }
            Event::Wheel(_) => {
                self.is_stale |= was_covered;
                was_covered
            }
            Event::Unfocused => {
                self.held = 0;
                false
            }
            _ => false,
        }
    }

    /// Whether something happened to it that it was not drawn after.
    pub fn is_stale(&self) -> bool {
        self.is_stale
    }

    /// Forgets what has happened: nobody sees the panel.
    fn ignore(&mut self) {
        self.winit.egui_input_mut().events.clear();
    }
}
