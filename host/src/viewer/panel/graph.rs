//! Times of the last frames as bars.

use crate::viewer::figures::{FrameTime, HISTORY};
use egui::{Align2, Color32, FontId, Rect, Sense, Ui, pos2, vec2};
use std::collections::VecDeque;

/// Points.
const HEIGHT: f32 = 60.0;
const BACKGROUND: Color32 = Color32::from_rgb(14, 18, 24);
const FRAME: Color32 = Color32::from_rgb(70, 92, 116);
const KERNEL: Color32 = Color32::from_rgb(255, 190, 92);
const TEXT: Color32 = Color32::from_rgb(203, 211, 220);

/// Draws the last frames, the newest at the right: the time from one to the next, and before it what its last pass took.
pub fn graph(ui: &mut Ui, history: &VecDeque<FrameTime>) {
    let size = vec2(ui.available_width(), HEIGHT);
    let (area, response) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter_at(area);
    painter.rect_filled(area, 2.0, BACKGROUND);
    let most = ceiling(history);
    let width = area.width() / HISTORY as f32;
    let first = HISTORY - history.len();
    for (place, time) in (first..).zip(history) {
        for (milliseconds, color) in [(time.frame, FRAME), (time.kernel, KERNEL)] {
            let Some(milliseconds) = milliseconds else { continue };
            let height = (milliseconds / most).min(1.0) as f32 * area.height();
            let left = area.left() + place as f32 * width;
            let bar = Rect::from_min_max(pos2(left, area.bottom() - height), pos2(left + width, area.bottom()));
            painter.rect_filled(bar, 0.0, color);
        }
    }
    painter.text(
        area.left_top() + vec2(4.0, 2.0),
        Align2::LEFT_TOP,
        format!("{most} ms"),
        FontId::monospace(10.0),
        TEXT,
    );
    response.on_hover_text("The last 200 frames: in blue from one to the next, in yellow the last pass of the kernel");
}

/// The number of milliseconds at the upper edge: 1, 2 or 5 times a power of ten, all times but a few below it.
fn ceiling(history: &VecDeque<FrameTime>) -> f64 {
    let times = history.iter().flat_map(|time| [time.frame, time.kernel]).flatten();
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    // One that took long would make all others small.
    let most = times.get(times.len().saturating_sub(1 + times.len() / 50));
    let most = most.copied().unwrap_or(1.0).max(0.01);
    let power = 10_f64.powf(most.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().find(|step| step * power >= most);
    step.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(times: impl IntoIterator<Item = f64>) -> f64 {
        let frame = |kernel| FrameTime {
            frame: None,
            kernel: Some(kernel),
        };
        ceiling(&times.into_iter().map(frame).collect())
    }

    #[test]
    fn the_upper_edge_is_a_round_number_over_most_times() {
        for (time, wanted) in [
            (0.7, 1.0),
            (1.0, 1.0),
            (1.5, 2.0),
            (3.0, 5.0),
            (16.7, 20.0),
            (61.0, 100.0),
            (0.0, 0.01),
        ] {
            let edge = of([time]);
            assert!((edge - wanted).abs() < 1e-9 * wanted, "{time}: {edge}");
        }
        assert_eq!(of([]), 1.0);
        let with_a_hitch = (0..150).map(|i| if i == 40 { 900.0 } else { 3.0 });
        assert!((of(with_a_hitch) - 5.0).abs() < 1e-9);
    }
}
