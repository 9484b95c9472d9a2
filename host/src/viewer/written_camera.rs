//! The camera as text, on the clipboard.

use super::application::Application;
use crate::standpoint::{Standpoint, arguments};
use arboard::Clipboard;

/// What a camera is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Arguments of `oktant render`, for the same scene.
    Arguments,
    /// The table `[camera]` of a scene file.
    Table,
}

impl Form {
    /// For whom it is.
    fn purpose(self) -> &'static str {
        match self {
            Form::Arguments => "as arguments of oktant render",
            Form::Table => "as a table of a scene file",
        }
    }
}

impl Application {
    /// The camera as text, without an end of line.
    pub(super) fn written_camera(&self, form: Form) -> String {
        let session = &self.session;
        match form {
            Form::Arguments => arguments(&session.view),
            Form::Table => {
                let table = Standpoint::of(&session.view, &session.origin()).to_toml();
                table.trim_end().into()
            }
        }
    }

    /// Puts the camera on the clipboard; where there is none, on standard error.
    pub(super) fn copy_camera(&mut self, form: Form) {
        let text = self.written_camera(form);
        let purpose = form.purpose();
        match self.put_on_clipboard(&text) {
            Ok(()) => self.tell(format!("The camera is on the clipboard, {purpose}."), false),
            Err(error) => {
                eprintln!("{text}");
                let reason = error.to_string();
                let reason = reason.trim_end_matches('.');
                self.tell(
                    format!("The clipboard cannot be used ({reason}); the camera is on standard error, {purpose}."),
                    true,
                );
            }
        }
    }

    /// Some systems ask the program for its text when it is pasted, so the connection is kept.
    fn put_on_clipboard(&mut self, text: &str) -> Result<(), arboard::Error> {
        let clipboard = match &mut self.clipboard {
            Some(clipboard) => clipboard,
            none => none.insert(Clipboard::new()?),
        };
        clipboard.set_text(text)
    }
}
