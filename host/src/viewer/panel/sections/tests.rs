//! What the panel asks for, and that it asks for nothing on its own.

use super::*;
use crate::names::Names;
use crate::scene::Memory;
use crate::source::Source;
use crate::stereo::{Stereo, StereoMode};
use crate::structure;
use crate::view::View;
use crate::viewer::caption::Caption;
use crate::viewer::figures::Figures;
use crate::viewer::panel::Inventory;
use crate::viewer::recent::Recent;
use crate::viewer::session::Session;
use egui::{Context, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Shape, pos2};
use std::time::{Duration, Instant};

const WINDOW: egui::Vec2 = egui::vec2(800.0, 2000.0);

struct Window {
    context: Context,
    layout: Layout,
    prompt: Prompt,
    figures: Figures,
    recent: Recent,
    inventory: Option<Inventory>,
}

impl Window {
    fn new() -> Self {
        let context = Context::default();
        context.all_styles_mut(|style| style.animation_time = 0.0);
        let layout = Layout {
            unfolded: Section::ALL.into(),
            ..Layout::default()
        };
        let mut figures = Figures::default();
        let start = Instant::now();
        for i in 0..30 {
            figures.pass(1, 1000, 3.0);
            figures.frame(start + Duration::from_millis(20 * i));
        }
        Window {
            context,
            layout,
            prompt: Prompt::default(),
            figures,
            recent: Recent::default(),
            inventory: None,
        }
    }

    /// What is asked for when these things happen, and where texts stand then.
    fn after(&mut self, session: &Session, events: Vec<Event>) -> (Vec<Input>, Vec<(String, Pos2)>) {
        let facts = Facts {
            session,
            inventory: self.inventory.as_ref(),
            names: &Names::default(),
            recent: &self.recent,
            wants_gpu: false,
            figures: &self.figures,
            caption: Caption::default(),
        };
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, WINDOW)),
            events,
            ..RawInput::default()
        };
        let mut asked = Vec::new();
        let mut area = Rect::NOTHING;
        let mut output = self.context.run_ui(input, |ui| {
            area = show(ui, &mut self.layout, &mut self.prompt, &facts, &mut asked);
        });
        assert!(area.right() == WINDOW.x && area.width() < 400.0, "{area}");
        output.textures_delta.clear();
        let mut texts = Vec::new();
        for clipped in output.shapes {
            collect(&clipped.shape, &mut texts);
        }
        (asked, texts)
    }

    fn click(&mut self, session: &Session, at: Pos2) -> Vec<Input> {
        let button = |pressed| Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let mut asked = self.after(session, vec![Event::PointerMoved(at)]).0;
        asked.extend(self.after(session, vec![button(true)]).0);
        asked.extend(self.after(session, vec![button(false)]).0);
        asked
    }
}

fn collect(shape: &Shape, texts: &mut Vec<(String, Pos2)>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, texts)),
        Shape::Text(text) => texts.push((text.galley.text().into(), text.visual_bounding_rect().center())),
        _ => {}
    }
}

fn session() -> Session {
    Session::new(View::default(), [800, 600], 1.0)
}

#[test]
fn nothing_is_asked_for_unless_somebody_does() {
    let mut strange = session();
    strange.view.tone.exposure = 29.0;
    strange.view.camera.azimuth = 500.0;
    strange.view.cutoff = 1.0 / 3.0;
    strange.view.adaptive = true;
    strange.view.tolerance = 0.123_456_78;
    strange.view.stereo = Some(Stereo::new(StereoMode::Rows));
    for session in [session(), strange] {
        let mut window = Window::new();
        for _ in 0..3 {
            let (asked, texts) = window.after(&session, Vec::new());
            assert_eq!(asked, []);
            for name in ["samples", "fov", "exposure", "kernel"] {
                assert!(texts.iter().any(|(text, _)| text == name), "{name}: {texts:?}");
            }
        }
        for x in (0..40).map(|i| 480.0 + 8.0 * i as f32) {
            let (asked, _) = window.after(&session, vec![Event::PointerMoved(pos2(x, 3.0 * x - 1400.0))]);
            assert_eq!(asked, [], "a pointer that passes by");
        }
    }
}

#[test]
fn a_choice_is_made_with_two_clicks() {
    let session = session();
    let mut window = Window::new();
    window.after(&session, Vec::new());
    let (_, texts) = window.after(&session, Vec::new());
    let place = |texts: &[(String, Pos2)], wanted: &str| {
        let found = texts.iter().rev().find(|(text, _)| text == wanted);
        found.unwrap_or_else(|| panic!("no {wanted} in {texts:?}")).1
    };
    let asked = window.click(&session, place(&texts, "phong"));
    assert_eq!(asked, [], "only the list is unfolded");
    window.after(&session, Vec::new());
    let (_, texts) = window.after(&session, Vec::new());
    let asked = window.click(&session, place(&texts, "flat"));
    assert_eq!(
        asked,
        [Input::Adjust(
            crate::viewer::adjustment::Adjustment::parse("shading flat").unwrap()
        )]
    );
}

#[test]
fn what_is_folded_shows_nothing() {
    let session = session();
    let mut window = Window::new();
    window.after(&session, Vec::new());
    let (_, texts) = window.after(&session, Vec::new());
    let (_, title) = texts.iter().find(|(text, _)| text == "Picture").unwrap().clone();
    window.click(&session, title);
    let (_, texts) = window.after(&session, Vec::new());
    assert!(!texts.iter().any(|(text, _)| text == "samples"));
    assert!(!window.layout.unfolded.contains(&Section::Picture));
    window.click(&session, title);
    let (_, texts) = window.after(&session, Vec::new());
    assert!(texts.iter().any(|(text, _)| text == "samples"));
}

#[test]
fn what_was_opened_is_opened_with_a_click() {
    let session = session();
    let mut window = Window::new();
    for name in ["first.ply", "a name that is longer than the panel is wide.stl"] {
        window.recent.opened(&Source::from_path(name.into()));
    }
    window.after(&session, Vec::new());
    let (_, texts) = window.after(&session, Vec::new());
    let place = |start: &str| {
        let found = texts.iter().find(|(text, _)| text.starts_with(start));
        found.unwrap_or_else(|| panic!("no {start} in {texts:?}")).1
    };
    let (first, open, beside) = (place("first.ply"), place("open..."), place("open beside..."));
    assert_eq!(window.click(&session, first), [Input::Recent(1)]);
    assert_eq!(window.click(&session, open), [Input::Choose { beside: false }]);
    assert_eq!(window.click(&session, beside), [Input::Choose { beside: true }]);
}

#[test]
fn a_step_is_typed() {
    let key = |key| Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    let typed = |text: &str| Event::Text(text.into());
    let session = session();
    let mut window = Window::new();
    assert_eq!(
        window.after(&session, vec![typed("nobody asked"), key(Key::Enter)]).0,
        []
    );
    window.prompt.call();
    // Typed before the line was laid out.
    assert_eq!(window.after(&session, vec![typed("set fov 3")]).0, []);
    assert!(window.context.egui_wants_keyboard_input());
    let step = |text: &str| [Input::Typed(text.into())];
    assert_eq!(
        window.after(&session, vec![typed("0"), key(Key::Enter)]).0,
        step("set fov 30")
    );
    assert_eq!(
        window.after(&session, vec![key(Key::Enter)]).0,
        step("set fov 30"),
        "it was refused"
    );
    window.prompt.clear();
    assert_eq!(window.after(&session, vec![key(Key::Enter)]).0, []);
    window.after(&session, vec![typed("set"), key(Key::Escape)]);
    assert!(!window.context.egui_wants_keyboard_input());
    let (_, texts) = window.after(&session, Vec::new());
    assert!(!texts.iter().any(|(text, _)| text.starts_with("set")), "it is closed");
}

#[test]
fn no_two_figures_of_the_statistics_have_the_same_name() {
    let session = session();
    let mut window = Window::new();
    window.layout.unfolded = [Section::Statistics].into();
    window.inventory = Some(Inventory {
        memory: Memory::default(),
        structure: structure::Figures::default(),
    });
    window.after(&session, Vec::new());
    let (_, texts) = window.after(&session, Vec::new());
    for name in ["structure", "triangles in leaves", "memory", "references", "triangles"] {
        let count = texts.iter().filter(|(text, _)| text == name).count();
        assert_eq!(count, 1, "{name}: {texts:?}");
    }
}
