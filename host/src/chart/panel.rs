//! The axes of a panel, and where its records are on them.

use super::axis::{Range, scientific};
use super::canvas::{Anchor, Canvas};
use super::figure::{Figure, Panel};
use super::font;
use super::labels::Area;
use super::plot::Plot;
use super::record::{Record, Value};
use super::style::{BLACK, FAINT, GRAY, PALE, SMALL, Style, TEXT};

const AXIS_WIDTH: f64 = 1.1;
/// Limits that are closer are one line.
const APART: f64 = 12.0;
/// Room below the limits, for labels.
const BELOW: f64 = 22.0;
/// By how much the limits of joined series are moved down one below the other, so that all of them can be seen.
const STEP: f64 = 8.0;

/// Draws a panel into a part of a drawing; `series` are those of the whole figure.
pub(super) fn draw_panel(canvas: &mut Canvas, figure: &Figure, panel: &Panel, series: &[&str], outer: Area) {
    let records: Vec<&Record> = figure.records_of(panel).collect();
    let x = Range::around(panel.x.scale, records.iter().map(|record| record.x));
    let y = Vertical::of(figure, panel);
    let y_ticks = y.range.ticks(((outer.high[1] - outer.low[1]) / 40.0) as usize);
    let limited: Vec<&str> = series
        .iter()
        .copied()
        .filter(|name| {
            records
                .iter()
                .any(|record| record.series == *name && record.y.is_limit())
        })
        .collect();
    let below = match (limited.len(), panel.is_joined) {
        (0, _) => 0.0,
        (_, false) => BELOW,
        (count, true) => BELOW.max(STEP * count as f64),
    };
    let mut limits: Vec<Value> = records.iter().map(|record| record.y).filter(|y| y.is_limit()).collect();
    limits.sort_by(|a, b| a.drawn().total_cmp(&b.drawn()));
    limits.dedup();
    let of_limit = |limit: &Value| format!("0 (< {})", scientific(limit.drawn()));
    let names = y_ticks
        .iter()
        .map(|tick| tick.label.clone())
        .chain(limits.iter().map(of_limit));
    let tick_width = names.map(|name| font::width(&name, SMALL)).fold(0.0, f64::max);
    let inner = Area {
        low: [outer.low[0] + tick_width + 32.0, outer.low[1] + 26.0],
        high: [outer.high[0], outer.high[1] - 46.0],
    };
    let [left, right] = [inner.low[0], inner.high[0]];
    let [top, bottom] = [inner.low[1], inner.high[1]];
    let across = |place: f64| left + place * (right - left);
    let up = |place: f64| bottom - below - place * (bottom - below - top);

    canvas.text([left, top - 9.0], Anchor::Start, TEXT + 1.0, BLACK, &panel.name);
    let mut heights: Vec<f64> = Vec::new();
    for limit in &limits {
        let Some(height) = y.place(*limit).map(up) else {
            continue;
        };
        if heights.iter().all(|other| (other - height).abs() > APART) {
            heights.push(height);
            canvas.dashes([[left, height], [right, height]], 0.9, PALE);
            canvas.text([left - 8.0, height + 3.7], Anchor::End, SMALL, BLACK, of_limit(limit));
        }
    }
    for tick in &y_ticks {
        let Some(height) = y.range.place(tick.value).map(up) else {
            continue;
        };
        let is_free = heights.iter().all(|other| (other - height).abs() > APART);
        let is_named = is_free && !tick.label.is_empty();
        if is_named {
            canvas.line(&[[left, height], [right, height]], 0.8, FAINT);
            canvas.text([left - 8.0, height + 3.7], Anchor::End, SMALL, GRAY, &tick.label);
        }
        let length = if is_named { 5.0 } else { 3.0 };
        canvas.line(&[[left - length, height], [left, height]], 0.8, PALE);
    }
    let mut end_of_last = f64::NEG_INFINITY;
    for tick in x.ticks(((right - left) / 48.0) as usize) {
        let Some(place) = x.place(tick.value).map(across) else {
            continue;
        };
        let half = 0.5 * font::width(&tick.label, SMALL);
        let is_named = !tick.label.is_empty() && place - half > end_of_last + 6.0;
        if is_named {
            canvas.line(&[[place, top], [place, bottom]], 0.8, FAINT);
            canvas.text([place, bottom + 18.0], Anchor::Middle, SMALL, GRAY, &tick.label);
            end_of_last = place + half;
        }
        let length = if is_named { 5.0 } else { 3.0 };
        canvas.line(&[[place, bottom], [place, bottom + length]], 0.8, PALE);
    }
    canvas.line(&[[left, top], [left, bottom], [right, bottom]], AXIS_WIDTH, GRAY);
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    canvas.text([middle[0], bottom + 37.0], Anchor::Middle, TEXT, BLACK, &panel.x.label);
    canvas.upright_text([outer.low[0] + 12.0, middle[1]], TEXT, BLACK, &panel.y.label);

    let mut plot = Plot::new(inner);
    for record in records {
        if let (Some(x), Some(y)) = (x.place(record.x), y.place(record.y)) {
            let index = series.iter().position(|name| *name == record.series).unwrap_or(0);
            let down = match limited.iter().position(|name| *name == record.series) {
                Some(rank) if panel.is_joined && record.y.is_limit() => STEP * rank as f64,
                _ => 0.0,
            };
            plot.add(record, [across(x), up(y) + down], Style::of(index));
        }
    }
    plot.draw(canvas, panel, &heights);
}

/// Where values are on the vertical axis, which panels with the same one share.
struct Vertical {
    range: Range,
    /// Half the least rate of all that is not 0: what never happened is drawn no higher.
    floor: f64,
}

impl Vertical {
    fn of(figure: &Figure, panel: &Panel) -> Self {
        let same = || figure.panels.iter().filter(|other| other.y == panel.y);
        let all = || same().flat_map(|panel| figure.records_of(panel)).map(|record| record.y);
        let rates = all().filter(|y| matches!(y, Value::Rate { .. }) && !y.is_limit());
        let floor = rates.map(|y| 0.5 * y.drawn()).fold(f64::INFINITY, f64::min);
        let values = all().flat_map(|y| {
            let height = if y.is_limit() { y.drawn().min(floor) } else { y.drawn() };
            // Room above for a decade.
            [height, if y.is_limit() { 10.0 * y.drawn() } else { height }]
        });
        Vertical {
            range: Range::around(panel.y.scale, values),
            floor,
        }
    }

    /// From 0 to 1.
    fn place(&self, y: Value) -> Option<f64> {
        let drawn = y.drawn();
        self.range
            .place(if y.is_limit() { drawn.min(self.floor) } else { drawn })
    }
}
