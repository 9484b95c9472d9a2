//! Rows of the panel: a name, and what can be done about it.

use crate::viewer::adjustment::Adjustment;
use crate::viewer::input::Input;
use egui::{CollapsingHeader, ComboBox, DragValue, Grid, Slider, Ui};
use glam::Vec3;
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// Characters that fit into a row beside its name.
const LONGEST: usize = 22;

/// Where rows are added, and what is asked for in them.
pub struct Fields<'a> {
    ui: &'a mut Ui,
    asked: &'a mut Vec<Input>,
}

impl<'a> Fields<'a> {
    /// Rows in a part of the window.
    pub fn new(ui: &'a mut Ui, asked: &'a mut Vec<Input>) -> Self {
        Fields { ui, asked }
    }

    /// The part of the window.
    pub fn ui(&mut self) -> &mut Ui {
        self.ui
    }

    /// Rows whose columns lie below each other.
    pub fn table(&mut self, name: &str, rows: impl FnOnce(&mut Fields<'_>)) {
        let asked = &mut *self.asked;
        Grid::new(name)
            .num_columns(2)
            .show(self.ui, |ui| rows(&mut Fields { ui, asked }));
    }

    /// What the rows below are about.
    pub fn heading(&mut self, text: &str) {
        self.ui.strong(text);
    }

    /// A row that says something; what would widen the panel is shown whole under the pointer only.
    pub fn text(&mut self, name: &str, text: impl Into<String>) {
        let text = text.into();
        self.ui.label(name);
        let short = shortened(&text);
        let label = self.ui.monospace(short.as_ref());
        if short != text {
            label.on_hover_text(text);
        }
        self.ui.end_row();
    }

    /// A row with one of some values.
    pub fn choice<T: Copy + PartialEq>(
        &mut self,
        name: &str,
        now: T,
        all: &[T],
        label: impl Fn(T) -> String,
        change: impl Fn(T) -> Adjustment,
    ) {
        self.ui.label(name);
        let mut chosen = now;
        ComboBox::from_id_salt(name)
            .selected_text(label(now))
            .show_ui(self.ui, |ui| {
                for value in all {
                    ui.selectable_value(&mut chosen, *value, label(*value));
                }
            });
        self.ui.end_row();
        if chosen != now {
            self.adjust(change(chosen));
        }
    }

    /// A row with a number in a range.
    pub fn slider(&mut self, name: &str, now: f32, range: RangeInclusive<f32>, change: impl Fn(f32) -> Adjustment) {
        let mut value = now;
        self.ui.label(name);
        let slider = Slider::new(&mut value, range).max_decimals(3);
        let is_changed = self.ui.add(slider).changed();
        self.ui.end_row();
        if is_changed && value != now {
            self.adjust(change(value));
        }
    }

    /// A row with a whole number in a range.
    pub fn counter(&mut self, name: &str, now: u32, range: RangeInclusive<u32>, change: impl Fn(u32) -> Adjustment) {
        let mut value = now;
        self.ui.label(name);
        let is_changed = self.ui.add(Slider::new(&mut value, range)).changed();
        self.ui.end_row();
        if is_changed && value != now {
            self.adjust(change(value));
        }
    }

    /// A row with a number that can be dragged or typed, a hundredth of it for each point.
    pub fn number(&mut self, name: &str, now: f32, range: RangeInclusive<f32>, change: impl Fn(f32) -> Adjustment) {
        let mut value = now;
        self.ui.label(name);
        let speed = (now.abs() * 0.01).max(1e-4);
        let field = DragValue::new(&mut value).speed(speed).range(range).max_decimals(4);
        let is_changed = self.ui.add(field).changed();
        self.ui.end_row();
        if is_changed && value != now {
            self.adjust(change(value));
        }
    }

    /// Something that can be unfolded, with rows of its own.
    pub fn item(&mut self, number: usize, title: &str, rows: impl FnOnce(&mut Fields<'_>)) {
        let asked = &mut *self.asked;
        CollapsingHeader::new(title)
            .id_salt(number)
            .show(self.ui, |ui| rows(&mut Fields { ui, asked }));
    }

    /// Whether a button is pressed.
    pub fn button(&mut self, text: &str) -> bool {
        self.ui.button(text).clicked()
    }

    /// Whether a button is pressed that is for what the pointer over it says.
    pub fn button_for(&mut self, text: &str, what: &str) -> bool {
        self.ui.button(text).on_hover_text(what).clicked()
    }

    /// A row with a colour, linear RGB.
    pub fn color(&mut self, name: &str, now: Vec3, change: impl Fn(Vec3) -> Adjustment) {
        self.ui.label(name);
        let color = color_button(self.ui, now);
        self.ui.end_row();
        if let Some(color) = color {
            self.adjust(change(color));
        }
    }

    /// A row with a part of the light that may have a colour: the colour, and its greatest channel.
    pub fn part(&mut self, name: &str, now: Vec3, change: impl Fn(Vec3) -> Adjustment) {
        self.ui.label(name);
        let greatest = now.max_element();
        let mut part = greatest;
        let mut wanted = None;
        self.ui.horizontal(|ui| {
            wanted = color_button(ui, now);
            if ui.add(Slider::new(&mut part, 0.0..=1.0).max_decimals(3)).changed() && part != greatest {
                let hue = if greatest > 0.0 { now / greatest } else { Vec3::ONE };
                wanted = Some(hue * part);
            }
        });
        self.ui.end_row();
        if let Some(color) = wanted {
            self.adjust(change(color));
        }
    }

    /// A row with a place, scene units.
    pub fn position(&mut self, name: &str, now: Vec3, change: impl Fn(Vec3) -> Adjustment) {
        self.ui.label(name);
        let mut coordinates = now.to_array();
        let speed = (now.abs().max_element() * 0.01).max(1e-4);
        let mut is_changed = false;
        self.ui.horizontal(|ui| {
            for coordinate in &mut coordinates {
                let field = DragValue::new(coordinate)
                    .speed(speed)
                    .range(-1e9..=1e9)
                    .max_decimals(3);
                is_changed |= ui.add(field).changed();
            }
        });
        self.ui.end_row();
        let wanted = Vec3::from_array(coordinates);
        if is_changed && wanted != now {
            self.adjust(change(wanted));
        }
    }

    /// Asks for something.
    pub fn ask(&mut self, input: Input) {
        self.asked.push(input);
    }

    fn adjust(&mut self, adjustment: Adjustment) {
        self.asked.push(Input::Adjust(adjustment));
    }
}

/// A text as far as it does not widen the panel.
pub fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(LONGEST) {
        None => text.into(),
        Some((end, _)) => format!("{}…", &text[..end]).into(),
    }
}

/// A button with a colour that unfolds what chooses another; that one, if it is chosen.
fn color_button(ui: &mut Ui, now: Vec3) -> Option<Vec3> {
    let mut color = now.to_array();
    let is_changed = ui.color_edit_button_rgb(&mut color).changed();
    let color = Vec3::from_array(color).max(Vec3::ZERO);
    (is_changed && color != now).then_some(color)
}
