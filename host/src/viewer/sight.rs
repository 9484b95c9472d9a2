//! The work behind the picture, in the window: what pixels tell, cells of the structure, a ray that is pinned.

mod crossings;
mod desk;
mod lines;
mod pinned;
mod question;

pub use desk::Told;
pub use question::Answer;

use super::application::Application;
use super::notice::Image;
use super::overlay::{Line, Overlay, Tone, wrap};
use super::seeing::CellKind;
use super::showing::{Part, Showing};
use crate::insight::Legend;
use crate::tone;
use crate::trace::Cell;
use crate::wires::{Layer, Selection, drawn};
use desk::Desk;
use glam::DVec3;
use lines::laid;
use oktant_shared::stereo::MONO;
use pinned::Pinned;
use question::{Ask, Question};

/// Who answers what pixels tell, which cells there are, and what became of the pinned ray.
const DESKS: usize = 3;
const PIXELS: usize = 0;
const CELLS: usize = 1;
const PIN: usize = 2;

/// What the window knows of the work behind the picture.
#[derive(Default)]
pub struct Sight {
    desks: [Desk; DESKS],
    /// What the loader moved the mesh by: see [`crate::mesh::Mesh::shift`].
    pub shift: DVec3,
}

impl Sight {
    /// Gives everything up.
    pub fn stop(&mut self) {
        for desk in &mut self.desks {
            desk.clear();
        }
    }

    fn legend(&self) -> Option<&Legend> {
        match self.desks[PIXELS].answer()? {
            Answer::Pixels { legend, .. } => Some(legend),
            _ => None,
        }
    }

    fn cells(&self) -> Option<(&Option<Layer>, &str, usize)> {
        match self.desks[CELLS].answer()? {
            Answer::Cells { layer, text, count } => Some((layer, text, *count)),
            _ => None,
        }
    }

    fn pinned(&self) -> Option<&Pinned> {
        match self.desks[PIN].answer()? {
            Answer::Pinned(pinned) => Some(pinned),
            _ => None,
        }
    }
}

impl Application {
    /// Sees to it that what the person wants to see is found out.
    pub(super) fn look_into(&mut self) {
        let questions = self.questions();
        for (desk, question) in questions.into_iter().enumerate() {
            if self.sight.desks[desk].want(question, desk, &self.mailbox) {
                self.redraw();
            }
        }
    }

    fn questions(&self) -> [Option<Question>; DESKS] {
        let (Some(scene), true) = (&self.scene, self.session.is_visible()) else {
            return [const { None }; DESKS];
        };
        let (view, size, seeing) = (&self.session.view, self.session.size, &self.session.seeing);
        let pointed = self.translation.pointer().and_then(|at| {
            let is_inside = (0..2).all(|axis| at[axis] >= 0.0 && at[axis] < f64::from(size[axis]));
            is_inside.then_some(Selection::Pixel(at.map(|side| side as u32)))
        });
        let selection = match seeing.cells {
            CellKind::None => None,
            CellKind::Leaves => Some(Selection::Leaves),
            CellKind::Level => Some(Selection::Level(seeing.level)),
            CellKind::Pointer => pointed,
        };
        let ask = |ask| Question::new(scene, view, size, ask);
        [
            seeing.aspect.map(|aspect| ask(Ask::Pixels(aspect))),
            selection.map(|selection| ask(Ask::Cells(selection))),
            seeing.pin.map(|pin| {
                let (source, shift) = (self.source.clone(), self.sight.shift);
                let ask = Ask::Pin {
                    pixel: pin.pixel,
                    source,
                    shift,
                    structure: self.built,
                };
                Question::new(scene, &pin.view, pin.size, ask)
            }),
        ]
    }

    /// Takes what was found out.
    pub(super) fn take_told(&mut self, desk: usize, number: u64, told: Told) {
        if let Told::Answer(answer) = &told
            && let Answer::Pinned(pinned) = &**answer
            && let Some(command) = &pinned.command
        {
            // There it can be copied.
            eprintln!("{command}");
        }
        if let Some(sentence) = self.sight.desks[desk].take(number, told) {
            self.tell(sentence, true);
        }
        self.redraw();
    }

    /// Whether all that is to be seen is found out.
    pub(super) fn has_looked(&self) -> bool {
        let questions = self.questions();
        let mut desks = self.sight.desks.iter().zip(&questions);
        desks.all(|(desk, question)| desk.is_done(question.as_ref()))
    }

    /// What the window shows below the overlay, and how: what pixels tell, or the picture.
    pub(super) fn shown(&self) -> Option<(Image, Showing)> {
        match self.sight.desks[PIXELS].answer() {
            Some(Answer::Pixels {
                picture, is_stacked, ..
            }) => {
                let showing = Showing {
                    tone: tone::Tone::default(),
                    part: if *is_stacked { self.part } else { Part::Whole },
                };
                Some((Image::Cpu(picture.clone()), showing))
            }
            _ => Some((self.image.clone()?, self.showing())),
        }
    }

    /// An overlay with the lines of cells below its panels; the overlay as it is where there are none.
    pub(super) fn lined(&self, overlay: Option<Overlay>) -> Option<Overlay> {
        let pinned = self.pinned_layer();
        let cells = self.sight.cells().and_then(|(layer, ..)| layer.as_ref());
        let layers: Vec<&Layer> = pinned.iter().chain(cells).collect();
        if layers.is_empty() {
            return overlay;
        }
        let over = overlay.as_ref().unwrap_or(&self.overlay);
        Some(laid(over, &layers, self.session.size))
    }

    /// What the pinned ray visited, as it is seen now.
    fn pinned_layer(&self) -> Option<Layer> {
        let cells: &[Cell] = &self.sight.pinned()?.cells;
        let [width, height] = self.session.size;
        let frame = self.session.view.frame(self.scene.as_ref()?, width, height);
        (frame.stereo == MONO).then(|| drawn(cells, &frame))
    }

    /// The panels that say what is seen, of so many characters a line.
    pub(super) fn sight_panels(&self, columns: usize) -> Vec<Vec<Line>> {
        let seeing = &self.session.seeing;
        let lines = |text: &str, tone| -> Vec<Line> {
            let lines = wrap(text, columns).into_iter();
            lines.map(|text| Line { text, tone }).collect()
        };
        let pixels = seeing.aspect.map(|aspect| match self.sight.legend() {
            Some(legend) => legend.lines(columns),
            None => lines(&format!("{aspect}: being counted"), Tone::Strong),
        });
        let cells = (seeing.cells != CellKind::None).then(|| match self.sight.cells() {
            Some((_, text, _)) => lines(text, Tone::Strong),
            None => lines("cells: point at something", Tone::Strong),
        });
        let pin = seeing.pin.map(|pin| match self.sight.pinned() {
            Some(pinned) => pinned.lines(columns),
            None => lines(
                &format!("pixel {}, {}: being traced", pin.pixel[0], pin.pixel[1]),
                Tone::Strong,
            ),
        });
        [pixels, cells, pin].into_iter().flatten().collect()
    }

    /// What the step `print` says of it, a name and its values each.
    pub(super) fn sight_report(&self) -> [(&'static str, String); 4] {
        let none = || "-".to_owned();
        let seeing = &self.session.seeing;
        let figures = self.sight.legend().and_then(|legend| legend.figures);
        [
            (
                "show",
                seeing
                    .aspect
                    .map_or_else(|| "picture".into(), |aspect| aspect.name().into()),
            ),
            (
                "show-figures",
                figures.map_or_else(none, |figures| {
                    format!(
                        "{} {} {} {} {}",
                        figures.least, figures.median, figures.mean, figures.percentile_99, figures.greatest
                    )
                }),
            ),
            (
                "cells",
                self.sight.cells().map_or_else(none, |(.., count)| count.to_string()),
            ),
            ("pin", self.sight.pinned().map_or_else(none, Pinned::report)),
        ]
    }
}
