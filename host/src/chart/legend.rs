//! The legend: what series look like.

use super::canvas::{Anchor, Canvas};
use super::font;
use super::style::{BLACK, GRAY, Style, WHITE};

const SIZE: f64 = 11.5;
const LINE: f64 = 18.0;
/// From the left end to the text.
const INDENT: f64 = 20.0;

/// What a legend says.
pub(super) struct Legend<'a> {
    pub series: Vec<&'a str>,
    /// Whether some points are greyed.
    pub has_dominated: bool,
    /// Whether some points are limits.
    pub has_limits: bool,
}

impl Legend<'_> {
    fn notes(&self) -> Vec<&'static str> {
        let mut notes = Vec::new();
        if self.has_dominated {
            notes.push("grey: another is as good");
            notes.push("in both and better in one");
        }
        if self.has_limits {
            notes.push("hollow: it never happened");
            notes.push("in N; drawn at 3 / N");
        }
        notes
    }

    /// Its width and height.
    pub fn extent(&self) -> [f64; 2] {
        let notes = self.notes();
        let widths = self.series.iter().map(|name| INDENT + font::width(name, SIZE));
        let widths = widths.chain(notes.iter().map(|note| font::width(note, SIZE - 1.0)));
        let lines = self.series.len() + notes.len();
        [widths.fold(0.0, f64::max), LINE * (lines as f64 + 1.0)]
    }

    /// Draws it below and to the right of a point.
    pub fn draw(&self, canvas: &mut Canvas, [left, top]: [f64; 2]) {
        let mut y = top + LINE;
        for (index, name) in self.series.iter().enumerate() {
            let style = Style::of(index);
            let marker = style.marker([left + 7.0, y - 4.0], 5.0);
            canvas.outlined(marker, style.color, WHITE, 0.6);
            canvas.text([left + INDENT, y], Anchor::Start, SIZE, BLACK, *name);
            y += LINE;
        }
        y += 0.4 * LINE;
        for note in self.notes() {
            canvas.text([left, y], Anchor::Start, SIZE - 1.0, GRAY, note);
            y += 0.85 * LINE;
        }
    }
}
