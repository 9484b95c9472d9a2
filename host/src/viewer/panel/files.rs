//! What is opened, and what was.

use super::Facts;
use super::fields::{Fields, shortened};
use crate::viewer::input::Input;

/// Buttons to open files, and one for each time that some were opened.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    if fields.button("open...") {
        fields.ask(Input::Choose { beside: false });
    }
    if fields.button("open beside...") {
        fields.ask(Input::Choose { beside: true });
    }
    for (index, (label, whole)) in facts.recent.labels().enumerate() {
        if fields.button_for(&shortened(&label), &whole) {
            fields.ask(Input::Recent(index));
        }
    }
}
