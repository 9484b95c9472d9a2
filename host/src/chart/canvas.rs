//! A drawing before it is a file: lines, areas and words, in units of about a point, y downwards.

use super::style::Color;

/// Which part of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Line {
        points: Vec<[f64; 2]>,
        width: f64,
        color: Color,
    },
    Area {
        points: Vec<[f64; 2]>,
        color: Color,
    },
    Text {
        /// On the line that letters stand on.
        at: [f64; 2],
        text: String,
        /// Of the letter m, about.
        size: f64,
        color: Color,
        anchor: Anchor,
        /// Read from below to above.
        is_upright: bool,
    },
}

/// What is drawn, the first first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Canvas {
    pub size: [f64; 2],
    pub shapes: Vec<Shape>,
}

impl Canvas {
    pub fn line(&mut self, points: &[[f64; 2]], width: f64, color: Color) {
        self.shapes.push(Shape::Line {
            points: points.to_vec(),
            width,
            color,
        });
    }

    /// A straight line of dashes.
    pub fn dashes(&mut self, [from, to]: [[f64; 2]; 2], width: f64, color: Color) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        let at = |away: f64| [0, 1].map(|axis| from[axis] + along[axis] * (away / length).min(1.0));
        let dashes = (length / 7.0).ceil() as u32;
        for dash in 0..dashes {
            let start = f64::from(dash) * 7.0;
            self.line(&[at(start), at(start + 4.0)], width, color);
        }
    }

    pub fn area(&mut self, points: Vec<[f64; 2]>, color: Color) {
        self.shapes.push(Shape::Area { points, color });
    }

    /// An area with a line around it.
    pub fn outlined(&mut self, points: Vec<[f64; 2]>, fill: Color, line: Color, width: f64) {
        let mut around = points.clone();
        around.extend(points.first());
        self.area(points, fill);
        self.line(&around, width, line);
    }

    pub fn text(&mut self, at: [f64; 2], anchor: Anchor, size: f64, color: Color, text: impl Into<String>) {
        self.shapes.push(Shape::Text {
            at,
            text: text.into(),
            size,
            color,
            anchor,
            is_upright: false,
        });
    }

    /// Text that is read from below to above.
    pub fn upright_text(&mut self, at: [f64; 2], size: f64, color: Color, text: impl Into<String>) {
        self.shapes.push(Shape::Text {
            at,
            text: text.into(),
            size,
            color,
            anchor: Anchor::Middle,
            is_upright: true,
        });
    }
}
