//! The sections, one below the other.

use super::fields::Fields;
use super::layout::{Layout, Section};
use super::prompt::Prompt;
use super::{Facts, files, kernel, lights, materials, picture, statistics, surroundings};
use crate::viewer::input::Input;
use egui::{CollapsingHeader, Frame, Panel, Rect, ScrollArea, Ui};

/// Narrowest and widest, points.
const WIDTHS: [f32; 2] = [240.0, 600.0];

/// Shows all of them in what is left of a window, below the line for steps, and keeps the layout; returns where they lie. What
/// is asked for is added to `asked`.
pub fn show(ui: &mut Ui, layout: &mut Layout, prompt: &mut Prompt, facts: &Facts<'_>, asked: &mut Vec<Input>) -> Rect {
    let frame = Frame::side_top_panel(ui.style());
    let shown = Panel::right("panel")
        .default_size(layout.width.clamp(WIDTHS[0], WIDTHS[1]))
        .size_range(WIDTHS[0]..=WIDTHS[1])
        .frame(frame)
        .show(ui, |ui| {
            prompt.show(&mut Fields::new(ui, asked));
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                for section in Section::ALL {
                    fold(ui, section, layout, |ui, material| {
                        let mut fields = Fields::new(ui, asked);
                        match section {
                            Section::Files => files::show(&mut fields, facts),
                            Section::Kernel => kernel::show(&mut fields, facts),
                            Section::Lights => lights::show(&mut fields, facts),
                            Section::Materials => materials::show(&mut fields, facts, material),
                            Section::Environment => surroundings::show(&mut fields, facts),
                            Section::Picture => picture::show(&mut fields, facts),
                            Section::Statistics => statistics::show(&mut fields, facts),
                        }
                    });
                }
            });
        });
    let area = shown.response.rect;
    layout.width = area.width();
    area
}

/// A section, folded or not.
fn fold(ui: &mut Ui, section: Section, layout: &mut Layout, content: impl FnOnce(&mut Ui, &mut usize)) {
    let is_unfolded = layout.unfolded.contains(&section);
    let shown = CollapsingHeader::new(section.title())
        .open(Some(is_unfolded))
        .show(ui, |ui| content(ui, &mut layout.material));
    if shown.header_response.clicked() {
        if is_unfolded {
            layout.unfolded.remove(&section);
        } else {
            layout.unfolded.insert(section);
        }
        ui.ctx().request_repaint();
    }
}

#[cfg(test)]
mod tests;
