//! The font that comes with the program, so that every chart looks alike on every system.

use plotters::style::{FontStyle, FontTransform, IntoFont, register_font};
use std::sync::Once;

/// What plotters calls it; in an SVG file also the font that is there.
pub(super) const NAME: &str = "DejaVu Sans, Verdana, sans-serif";

/// Height of its line by the size of its letters; plotters measures fonts by it.
pub(super) const LINE: f64 = 1.164;

/// Makes it known to plotters.
pub(super) fn register() {
    static REGISTERED: Once = Once::new();
    REGISTERED.call_once(|| {
        let font = include_bytes!("../../../assets/fonts/DejaVuSans.ttf");
        let is_known = register_font(NAME, FontStyle::Normal, font).is_ok();
        debug_assert!(is_known, "the font is a font");
    });
}

/// How wide a text is.
pub(super) fn width(text: &str, size: f64) -> f64 {
    register();
    // Whole numbers come back, so a large size is asked for.
    const FINE: f64 = 16.0;
    let font = (NAME, size * LINE * FINE).into_font().transform(FontTransform::None);
    match font.layout_box(text) {
        Ok(((left, _), (right, _))) => f64::from(right - left) / FINE,
        Err(_) => 0.6 * size * text.chars().count() as f64,
    }
}

/// A text in lines that are no wider than this; words stay whole.
pub(super) fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}
