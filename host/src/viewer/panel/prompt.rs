//! The panel's line for steps that are typed.

use super::fields::Fields;
use crate::viewer::input::Input;
use egui::{Id, Key, TextEdit};

/// What stands there while nothing does.
const HINT: &str = "a step, for example: set fov 30";

/// The line, which is there from when it is called until it is left.
#[derive(Default)]
pub struct Prompt {
    text: String,
    is_open: bool,
    /// Whether the keyboard is to be its, once it is laid out.
    is_wanted: bool,
}

impl Prompt {
    /// Gives it the keyboard.
    pub fn call(&mut self) {
        (self.is_open, self.is_wanted) = (true, true);
    }

    /// It is left.
    pub fn close(&mut self) {
        *self = Prompt::default();
    }

    /// What was typed is done.
    pub fn clear(&mut self) {
        self.text.clear();
    }

    /// Shows it where it is open, and asks for what was typed. It keeps the keyboard for the next step; what takes it,
    /// but the tabulator, closes it.
    pub fn show(&mut self, fields: &mut Fields<'_>) {
        if !self.is_open {
            return;
        }
        let id = Id::unique("prompt");
        let ui = fields.ui();
        if std::mem::take(&mut self.is_wanted) {
            // Before it is laid out: what was typed meanwhile is for it.
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let line = TextEdit::singleline(&mut self.text)
            .id(id)
            .hint_text(HINT)
            .desired_width(f32::INFINITY);
        let response = ui.add(line);
        if !response.lost_focus() {
            return;
        }
        let [enter, tab] = [Key::Enter, Key::Tab].map(|key| ui.input(|input| input.key_pressed(key)));
        if enter {
            response.request_focus();
            if !self.text.trim().is_empty() {
                fields.ask(Input::Typed(self.text.clone()));
            }
        } else if !tab {
            self.close();
            ui.ctx().request_repaint();
        }
    }
}
