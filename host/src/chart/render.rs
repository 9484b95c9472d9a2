//! From drawings to files.

use super::canvas::{Anchor, Canvas, Shape};
use super::drawing::drawn;
use super::figure::Figure;
use super::font;
use crate::output::{OutputError, PictureFile, TextFile};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{PathElement, Polygon};
use plotters::prelude::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, IntoFont, RGBColor, TextStyle, WHITE};
use std::path::{Path, PathBuf};

/// Why a chart could not be saved.
#[derive(Debug, thiserror::Error)]
pub enum ChartError {
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The drawing library gave up.
    #[error("The chart {stem} could not be drawn ({reason}); its data are in {stem}.csv.")]
    Drawing {
        /// The figure's [`Figure::stem`].
        stem: String,
        /// What the library says.
        reason: String,
    },
}

/// Pixels of a PNG by unit of a drawing.
const PIXELS: f64 = 1.25;
/// Samples of a pixel along each axis.
const SAMPLES: u32 = 2;
/// Whole numbers by unit in an SVG, whose coordinates have no fractions.
const FINE: f64 = 10.0;

impl Figure {
    /// Writes `STEM.svg`, `STEM.png` and `STEM.csv` into a folder that exists, whose paths come back.
    ///
    /// # Errors
    /// [`ChartError`]; each file is whole or is not touched.
    pub fn save(&self, folder: &Path) -> Result<Vec<PathBuf>, ChartError> {
        let path = |ending: &str| folder.join(format!("{}.{ending}", self.stem));
        let paths = ["csv", "svg", "png"].map(path);
        // Data first: should drawing fail, nothing measured is lost.
        TextFile::create(&paths[0])?.save(&self.to_csv())?;
        let canvas = drawn(self);
        let failed = |reason: String| ChartError::Drawing {
            stem: self.stem.clone(),
            reason,
        };
        TextFile::create(&paths[1])?.save(&svg(&canvas).map_err(failed)?)?;
        let (pixels, size) = pixels(&canvas).map_err(failed)?;
        PictureFile::create(&paths[2])?.save_rgb8(&pixels, size)?;
        Ok(paths.into())
    }
}

fn svg(canvas: &Canvas) -> Result<String, String> {
    let size = canvas.size.map(|length| (length * FINE) as u32);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size.into()).into_drawing_area();
        let medium = Medium {
            scale: FINE,
            // Of a size of 1.24, plotters makes a font size of 1; its upper anchor is 0.76 above the line.
            em: 1.24,
            rise: 0.76,
        };
        paint(canvas, &root, &medium)?;
    }
    // As large as the drawing says, its coordinates finer.
    let fine = format!("width=\"{}\" height=\"{}\"", size[0], size[1]);
    let coarse = format!("width=\"{}\" height=\"{}\"", canvas.size[0], canvas.size[1]);
    Ok(text.replacen(&fine, &coarse, 1))
}

/// Red, green and blue of all pixels, and width and height.
fn pixels(canvas: &Canvas) -> Result<(Vec<u8>, [u32; 2]), String> {
    let size = canvas.size.map(|length| (length * PIXELS).ceil() as u32);
    let [width, height] = size.map(|length| length * SAMPLES);
    let mut samples = vec![0; (width * height * 3) as usize];
    {
        let root = BitMapBackend::with_buffer(&mut samples, (width, height)).into_drawing_area();
        let medium = Medium {
            scale: PIXELS * f64::from(SAMPLES),
            // Its letters stand half a size below the upper anchor.
            em: font::LINE,
            rise: 0.5 * font::LINE,
        };
        paint(canvas, &root, &medium)?;
    }
    let mean = |column: u32, row: u32, channel: u32| {
        let places = (0..SAMPLES).flat_map(|y| (0..SAMPLES).map(move |x| (x, y)));
        let sum: u32 = places
            .map(|(x, y)| {
                let sample = (row * SAMPLES + y) * width + column * SAMPLES + x;
                u32::from(samples[(sample * 3 + channel) as usize])
            })
            .sum();
        (sum / (SAMPLES * SAMPLES)) as u8
    };
    let pixels = (0..size[1])
        .flat_map(|row| (0..size[0]).map(move |column| (column, row)))
        .flat_map(|(column, row)| [0, 1, 2].map(|channel| mean(column, row, channel)))
        .collect();
    Ok((pixels, size))
}

/// What differs between the back ends of plotters.
struct Medium {
    /// Its units by unit of the drawing.
    scale: f64,
    /// The size that plotters is to be told for letters of size 1.
    em: f64,
    /// How far above the line of a text of size 1 its upper anchor is.
    rise: f64,
}

fn paint<B: DrawingBackend>(canvas: &Canvas, root: &DrawingArea<B, Shift>, medium: &Medium) -> Result<(), String> {
    font::register();
    let whole = |length: f64| (length * medium.scale).round() as i32;
    let all = |points: &[[f64; 2]]| -> Vec<(i32, i32)> {
        points.iter().map(|point| (whole(point[0]), whole(point[1]))).collect()
    };
    let rgb = |[red, green, blue]: [u8; 3]| RGBColor(red, green, blue);
    root.fill(&WHITE).map_err(|error| error.to_string())?;
    for shape in &canvas.shapes {
        let drawn = match shape {
            Shape::Line { points, width, color } => {
                let width = whole(*width).max(1) as u32;
                root.draw(&PathElement::new(all(points), rgb(*color).stroke_width(width)))
            }
            Shape::Area { points, color } => root.draw(&Polygon::new(all(points), rgb(*color).filled())),
            Shape::Text {
                at: [x, y],
                text,
                size,
                color,
                anchor,
                is_upright,
            } => {
                let rise = medium.rise * size;
                let (at, transform) = if *is_upright {
                    ((whole(x - rise), whole(*y)), FontTransform::Rotate270)
                } else {
                    ((whole(*x), whole(y - rise)), FontTransform::None)
                };
                let horizontal = match anchor {
                    Anchor::Start => HPos::Left,
                    Anchor::Middle => HPos::Center,
                    Anchor::End => HPos::Right,
                };
                let font = (font::NAME, size * medium.scale * medium.em)
                    .into_font()
                    .transform(transform);
                let color = rgb(*color);
                let style = TextStyle::from(font).color(&color).pos(Pos::new(horizontal, VPos::Top));
                root.draw_text(text, &style, at)
            }
        };
        drawn.map_err(|error| error.to_string())?;
    }
    root.present().map_err(|error| error.to_string())
}
