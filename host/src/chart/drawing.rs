//! Drawing figures: title, panels in a grid, legend to the right, where it comes from below.
//!
//! What a panel shows: axes with ticks at powers of ten; a marker for each record, in the looks of its series; where
//! [`super::Panel::better`] says what is good, the Pareto front as stairs, with what is dominated greyed; what never happened
//! as a hollow marker at 3 / N, on a dashed line that says so; labels beside their points, with lines to them where they had
//! to move.

use super::canvas::{Anchor, Canvas};
use super::figure::Figure;
use super::font;
use super::labels::Area;
use super::legend::Legend;
use super::panel::draw_panel;
use super::style::{BLACK, GRAY, SMALL, TEXT};

const WIDTH: f64 = 1200.0;
const MARGIN: f64 = 24.0;
const TITLE: f64 = 19.0;

/// A drawing of a figure.
pub(super) fn drawn(figure: &Figure) -> Canvas {
    let mut canvas = Canvas::default();
    let mut y = MARGIN + TITLE;
    canvas.text([MARGIN, y], Anchor::Start, TITLE, BLACK, &figure.title);
    y += 8.0;
    for line in font::wrapped(&figure.explanation, TEXT, WIDTH - 2.0 * MARGIN) {
        y += 17.0;
        canvas.text([MARGIN, y], Anchor::Start, TEXT, GRAY, line);
    }
    y += 14.0;

    let series = figure.series();
    let legend = Legend {
        has_dominated: figure.panels.iter().any(|panel| panel.better.is_some()),
        has_limits: figure.records.iter().any(|record| record.y.is_limit()),
        series: series.clone(),
    };
    let [legend_width, legend_height] = legend.extent();
    let right = WIDTH - MARGIN - legend_width - 16.0;
    let columns = match figure.panels.len() {
        0 | 1 => 1,
        2 | 4 => 2,
        _ => 3,
    };
    let rows = figure.panels.len().div_ceil(columns);
    let height = match rows {
        0 | 1 => 460.0_f64.max(legend_height),
        2 => 360.0,
        _ => 320.0,
    };
    let width = (right - MARGIN) / columns as f64;
    for (index, panel) in figure.panels.iter().enumerate() {
        let (row, column) = (index / columns, index % columns);
        let low = [MARGIN + column as f64 * width, y + row as f64 * height];
        let area = Area {
            low,
            high: [low[0] + width - 18.0, low[1] + height - 10.0],
        };
        draw_panel(&mut canvas, figure, panel, &series, area);
    }
    legend.draw(&mut canvas, [right + 16.0, y + 14.0]);
    y += (rows as f64 * height).max(legend_height) + 6.0;

    let origin = &figure.origin;
    let footer = format!("{} · commit {} · {}", origin.machine, origin.commit, origin.command);
    for line in font::wrapped(&footer, SMALL, WIDTH - 2.0 * MARGIN) {
        y += 15.0;
        canvas.text([MARGIN, y], Anchor::Start, SMALL, GRAY, line);
    }
    canvas.size = [WIDTH, (y + 16.0).ceil()];
    canvas
}
