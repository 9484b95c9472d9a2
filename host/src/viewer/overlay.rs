//! Text over the picture.

use crate::insight::Palette;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::mono_font::iso_8859_1::{FONT_8X13, FONT_8X13_BOLD};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::RgbColor;
use embedded_graphics::primitives::{PointsIter, Rectangle};
use embedded_graphics::text::{Baseline, Text};
use std::convert::Infallible;

/// Between the window's edge and a panel, between panels, and between a panel's edge and its text; pixels at scale 1.
const MARGIN: u32 = 8;
/// Between the upper edges of two lines, pixels at scale 1.
const LINE: u32 = 17;
/// Width of a character, pixels at scale 1.
const COLUMN: u32 = FONT_8X13.character_size.width;
/// Colour of the panels, sRGB-encoded.
pub const PANEL_COLOR: [u8; 3] = [14, 18, 24];
/// The same with their opacity.
const PANEL: u32 = texel(PANEL_COLOR, 222);

/// How a line is to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// As most do.
    Plain,
    /// As what matters most.
    Strong,
    /// As something that went wrong.
    Warning,
    /// As what has that colour, sRGB-encoded.
    Colored([u8; 3]),
    /// As a bar of all colours of a map, as wide as the text.
    Gradient(Palette),
}

/// A line of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// What it says.
    pub text: String,
    /// How it looks.
    pub tone: Tone,
}

/// A picture of text, to be laid over the upper left corner of a window.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overlay {
    /// Pixels in a row; 0 where there is no text.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// A byte each of red, green, blue (sRGB-encoded) and opacity a pixel, red the lowest; row by row.
    pub texels: Vec<u32>,
}

impl Overlay {
    /// Draws panels of lines, one below the other, with pixels enlarged to squares of `scale`.
    pub fn new(panels: &[Vec<Line>], scale: u32) -> Self {
        let scale = scale.max(1);
        let panels: Vec<_> = panels.iter().filter(|panel| !panel.is_empty()).collect();
        if panels.is_empty() {
            return Overlay::default();
        }
        let sizes: Vec<Size> = panels
            .iter()
            .map(|panel| {
                let columns = panel.iter().map(|line| line.text.chars().count() as u32).max();
                Size::new(
                    columns.unwrap_or(0) * COLUMN + 2 * MARGIN,
                    panel.len() as u32 * LINE + 2 * MARGIN - (LINE - FONT_8X13.character_size.height),
                )
            })
            .collect();
        let width = MARGIN + sizes.iter().map(|size| size.width).max().unwrap_or(0);
        let height = sizes.iter().map(|size| size.height + MARGIN).sum::<u32>();
        let mut canvas = Canvas::new(Size::new(width, height), scale);
        let mut top = MARGIN;
        for (panel, size) in panels.into_iter().zip(sizes) {
            let corner = Point::new(MARGIN as i32, top as i32);
            canvas.fill(Rectangle::new(corner, size), PANEL);
            for (line, number) in panel.iter().zip(0..) {
                let at = corner + Point::new(MARGIN as i32, (MARGIN + number * LINE) as i32);
                canvas.write(line, at);
            }
            top += size.height + MARGIN;
        }
        Overlay {
            width: width * scale,
            height: height * scale,
            texels: canvas.texels,
        }
    }

    /// How many characters fit into a line where the window is free over this width in pixels; never fewer than 20, which can
    /// still be read.
    pub fn columns(free_width: u32, scale: u32) -> usize {
        let pixels = (free_width / scale.max(1)).saturating_sub(4 * MARGIN);
        (pixels / COLUMN).max(20) as usize
    }
}

/// Breaks a text into lines of at most so many characters, between words where that is possible. Between words of a line there
/// are as many spaces as in the text: more than one part what does not belong together.
pub fn wrap(text: &str, columns: usize) -> Vec<String> {
    let columns = columns.max(1);
    let mut lines = Vec::new();
    let mut line = String::new();
    let (mut length, mut gap) = (0, 0);
    for word in text.split(char::is_whitespace) {
        if word.is_empty() {
            gap += 1;
            continue;
        }
        let mut characters: Vec<char> = word.chars().collect();
        if length > 0 && length + gap + characters.len() > columns {
            lines.push(std::mem::take(&mut line));
            length = 0;
        }
        if length > 0 {
            line.extend(std::iter::repeat_n(' ', gap));
            length += gap;
        }
        gap = 1;
        while length + characters.len() > columns {
            let rest = characters.split_off(columns - length);
            line.extend(characters);
            lines.push(std::mem::take(&mut line));
            length = 0;
            characters = rest;
        }
        length += characters.len();
        line.extend(characters);
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// Lines of at most so many characters: those that are longer are broken.
pub fn fitted(lines: Vec<Line>, columns: usize) -> Vec<Line> {
    let broken = |line: Line| {
        if line.text.chars().count() <= columns {
            return vec![line];
        }
        let texts = wrap(&line.text, columns).into_iter();
        texts.map(|text| Line { text, ..line }).collect()
    };
    lines.into_iter().flat_map(broken).collect()
}

const fn texel([red, green, blue]: [u8; 3], opacity: u8) -> u32 {
    u32::from_le_bytes([red, green, blue, opacity])
}

/// What embedded-graphics draws on: each of its pixels is a square.
struct Canvas {
    size: Size,
    scale: u32,
    texels: Vec<u32>,
}

impl Canvas {
    fn new(size: Size, scale: u32) -> Self {
        Canvas {
            size,
            scale,
            texels: vec![0; (size.width * size.height * scale * scale) as usize],
        }
    }

    fn fill(&mut self, area: Rectangle, texel: u32) {
        for at in area.points() {
            self.set(at, texel);
        }
    }

    fn write(&mut self, line: &Line, at: Point) {
        let (font, color): (&MonoFont<'_>, _) = match line.tone {
            Tone::Plain => (&FONT_8X13, Rgb888::new(203, 211, 220)),
            Tone::Strong => (&FONT_8X13_BOLD, Rgb888::new(250, 250, 250)),
            Tone::Warning => (&FONT_8X13_BOLD, Rgb888::new(255, 190, 92)),
            Tone::Colored([red, green, blue]) => (&FONT_8X13_BOLD, Rgb888::new(red, green, blue)),
            Tone::Gradient(palette) => {
                self.gradient(palette, line.text.chars().count() as u32 * COLUMN, at);
                return;
            }
        };
        let style = MonoTextStyle::new(font, color);
        let text = embedded_graphics::Drawable::draw(&Text::with_baseline(&line.text, at, style, Baseline::Top), self);
        match text {
            Ok(_) => {}
            Err(never) => match never {},
        }
    }

    /// The colours of a map from left to right.
    fn gradient(&mut self, palette: Palette, width: u32, at: Point) {
        for x in 0..width {
            let color = palette.color(f64::from(x) / f64::from((width - 1).max(1)));
            for y in 0..FONT_8X13.character_size.height {
                self.set(at + Point::new(x as i32, y as i32), texel(color, u8::MAX));
            }
        }
    }

    fn set(&mut self, at: Point, texel: u32) {
        let (Ok(x), Ok(y)) = (u32::try_from(at.x), u32::try_from(at.y)) else {
            return;
        };
        if x >= self.size.width || y >= self.size.height {
            return;
        }
        let stride = self.size.width * self.scale;
        for row in y * self.scale..(y + 1) * self.scale {
            let start = (row * stride + x * self.scale) as usize;
            self.texels[start..start + self.scale as usize].fill(texel);
        }
    }
}

impl Dimensions for Canvas {
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(Point::zero(), self.size)
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, color) in pixels {
            self.set(at, texel([color.r(), color.g(), color.b()], 255));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str) -> Line {
        Line {
            text: text.into(),
            tone: Tone::Plain,
        }
    }

    #[test]
    fn no_text_is_no_overlay() {
        assert_eq!(Overlay::new(&[], 1), Overlay::default());
        assert_eq!(Overlay::new(&[vec![]], 1), Overlay::default());
    }

    #[test]
    fn panels_are_drawn_and_enlarged() {
        let panels = [vec![line("ab"), line("c")], vec![line("\u{d7}")]];
        let small = Overlay::new(&panels, 1);
        let large = Overlay::new(&panels, 2);
        assert_eq!((large.width, large.height), (2 * small.width, 2 * small.height));
        for y in 0..large.height {
            for x in 0..large.width {
                let texel = |overlay: &Overlay, x, y| overlay.texels[(y * overlay.width + x) as usize];
                assert_eq!(texel(&large, x, y), texel(&small, x / 2, y / 2));
            }
        }
        assert_eq!(small.texels[0], 0, "the margin is clear");
        let bright = small.texels.iter().filter(|texel| **texel >> 24 == 255).count();
        let panel = small.texels.iter().filter(|texel| **texel == PANEL).count();
        assert!(bright > 30, "{bright} pixels of text");
        assert!(panel > 10 * bright, "{panel} pixels of panels");
    }

    #[test]
    fn long_sentences_are_wrapped() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(
            wrap("a/very/long/path is there", 6),
            ["a/very", "/long/", "path", "is", "there"]
        );
        assert_eq!(wrap("", 5), Vec::<String>::new());
        assert_eq!(
            wrap(" one   two  three", 10),
            ["one   two", "three"],
            "parts stay apart"
        );
        for columns in 1..30 {
            let text = "There is no such file; check the path\u{e4}";
            let lines = wrap(text, columns);
            assert!(
                lines.iter().all(|line| line.chars().count() <= columns),
                "{columns}: {lines:?}"
            );
            assert_eq!(lines.concat().replace(' ', ""), text.replace(' ', ""));
        }
    }

    #[test]
    fn only_lines_that_are_too_long_are_broken() {
        let lines = vec![line("   12  pixels"), line("orthographic, 12.5 high"), line("")];
        let texts: Vec<String> = fitted(lines, 15).into_iter().map(|line| line.text).collect();
        assert_eq!(texts, ["   12  pixels", "orthographic,", "12.5 high", ""]);
    }
}
