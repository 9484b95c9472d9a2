//! The panel at the window's right side: all that can be set, and figures. What it is asked for becomes an `Input`.

mod facts;
mod fields;
mod files;
mod gpu_painter;
mod graph;
mod kernel;
mod layout;
mod lights;
mod materials;
mod painting;
mod picture;
mod prompt;
mod raster;
mod sections;
mod statistics;
mod surroundings;
mod touch;

pub use facts::{Facts, Inventory};
pub use gpu_painter::GpuPainter;
pub use layout::Layout;
#[cfg(test)]
pub use layout::Section;
pub use painting::Painting;
pub use raster::paint;

use super::input::Input;
use super::session::Session;
use egui::{Context, Order, Pos2, Rect, Theme, ViewportId};
use egui_winit::State;
use prompt::Prompt;
use std::num::NonZero;
use std::time::{Duration, Instant};
use winit::window::Window;

/// The edge of the panel can be taken hold of so far outside of it, points.
const GRIP: f32 = 5.0;
/// The widest and longest texture that is asked of the screens.
const LARGEST_TEXTURE: usize = 2048;

/// The panel of a window.
pub struct Panel {
    context: Context,
    winit: State,
    /// How wide it is, and which sections are unfolded.
    pub layout: Layout,
    /// The line for steps.
    pub prompt: Prompt,
    painting: Painting,
    /// Where it lies, points.
    area: Rect,
    /// Where the pointer is, points.
    pointer: Pos2,
    /// Buttons that were pressed on it and are still held down.
    held: u32,
    /// When it wants to be drawn again, if nothing happens.
    wake: Option<Instant>,
    /// Whether something happened to it that it was not drawn after, or it was never drawn.
    is_stale: bool,
}

impl Panel {
    /// The panel of a window, nothing of it drawn yet.
    pub fn new(window: &Window, layout: Layout) -> Self {
        let context = Context::default();
        context.set_theme(Theme::Dark);
        context.options_mut(|options| {
            // The keys are the viewer's, and what was asked for in a pass that is repeated would be asked for twice.
            options.zoom_with_keyboard = false;
            options.quit_shortcuts.clear();
            options.sync_window_theme = false;
            options.max_passes = NonZero::<usize>::MIN;
        });
        // Nothing moves on its own: what is idle computes nothing.
        context.all_styles_mut(|style| {
            style.animation_time = 0.0;
            style.visuals.text_cursor.blink = false;
        });
        let scale = Some(window.scale_factor() as f32);
        let winit = State::new(
            context.clone(),
            ViewportId::ROOT,
            window,
            scale,
            None,
            Some(LARGEST_TEXTURE),
        );
        Panel {
            context,
            winit,
            layout,
            prompt: Prompt::default(),
            painting: Painting::default(),
            area: Rect::NOTHING,
            pointer: Pos2::ZERO,
            held: 0,
            wake: None,
            is_stale: true,
        }
    }

    /// What is to be drawn, if it is open.
    pub fn painting(&self, session: &Session) -> Option<&Painting> {
        session.panel.then_some(&self.painting)
    }

    /// Takes what has happened to it, and lays it out anew. Returns what is asked for.
    pub fn run(&mut self, window: &Window, facts: &Facts<'_>, now: Instant) -> Vec<Input> {
        let input = self.winit.take_egui_input(window);
        let mut asked = Vec::new();
        let (layout, prompt, area) = (&mut self.layout, &mut self.prompt, &mut self.area);
        let output = self.context.run_ui(input, |ui| {
            *area = sections::show(ui, layout, prompt, facts, &mut asked);
        });
        self.winit.handle_platform_output(window, output.platform_output);
        let scale = output.pixels_per_point;
        let primitives = self.context.tessellate(output.shapes, scale);
        self.painting.update(primitives, scale, output.textures_delta);
        let delay = output.viewport_output.get(&ViewportId::ROOT);
        let delay = delay.map_or(Duration::MAX, |viewport| viewport.repaint_delay);
        self.wake = now.checked_add(delay);
        self.is_stale = false;
        asked
    }

    /// Unfolds what is said of a material, with the next drawing.
    pub fn show_material(&mut self, index: usize) {
        self.layout.show_material(index);
        self.is_stale = true;
    }

    /// When it wants to be drawn again, if nothing happens.
    pub fn wake(&self) -> Option<Instant> {
        self.wake
    }

    /// Whether what is drawn is what it would show.
    pub fn is_settled(&self, now: Instant) -> bool {
        !self.is_stale && self.wake.is_none_or(|wake| wake > now)
    }

    /// Whether the panel, or something that belongs to it, lies there.
    fn covers(&self, at: Pos2) -> bool {
        let layer = self.context.layer_id_at(at);
        layer.is_some_and(|layer| layer.order != Order::Background)
            || self.area.expand2(egui::vec2(GRIP, 0.0)).contains(at)
    }
}
