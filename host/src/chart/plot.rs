//! What is drawn between the axes of a panel.

use super::canvas::{Anchor, Canvas};
use super::figure::Panel;
use super::labels::{Area, Wish, places};
use super::pareto::{Better, front};
use super::record::Record;
use super::style::{BLACK, GRAY, PALE, SMALL, Style, WHITE, greyed, ring};

const RADIUS: f64 = 5.0;
/// Of markers on lines.
const JOINED: f64 = 4.2;
/// Of the ring around what is to stand out.
const RING: f64 = 10.0;
/// How far apart points on lines are that labels keep off.
const STEP: f64 = 8.0;

/// A panel's records and where they are.
pub(super) struct Plot<'a> {
    records: Vec<&'a Record>,
    at: Vec<[f64; 2]>,
    styles: Vec<Style>,
    /// Whether nothing dominates it.
    is_good: Vec<bool>,
    inner: Area,
    /// Of markers.
    radius: f64,
}

impl<'a> Plot<'a> {
    /// An empty one.
    pub fn new(inner: Area) -> Self {
        Plot {
            records: Vec::new(),
            at: Vec::new(),
            styles: Vec::new(),
            is_good: Vec::new(),
            inner,
            radius: RADIUS,
        }
    }

    pub fn add(&mut self, record: &'a Record, at: [f64; 2], style: Style) {
        self.records.push(record);
        self.at.push(at);
        self.styles.push(style);
        self.is_good.push(true);
    }

    /// Draws all of it: lines, then markers, then labels, which keep off lines that are there at some heights too.
    pub fn draw(&mut self, canvas: &mut Canvas, panel: &Panel, heights: &[f64]) {
        let mut obstacles = self.at.clone();
        for &height in heights {
            let ([left, _], [right, _]) = (self.inner.low, self.inner.high);
            obstacles.extend(points_on(&[[left, height], [right, height]]));
        }
        if let Some(better) = panel.better {
            obstacles.extend(self.draw_front(canvas, better));
        }
        if panel.is_joined {
            self.radius = JOINED;
            obstacles.extend(self.draw_lines(canvas));
        }
        self.draw_markers(canvas);
        self.draw_labels(canvas, &obstacles);
    }

    /// Finds out what is good, and draws the front as stairs: what can be had at each x. Points on them come back.
    fn draw_front(&mut self, canvas: &mut Canvas, better: [Better; 2]) -> Vec<[f64; 2]> {
        let values: Vec<[f64; 2]> = self
            .records
            .iter()
            .map(|record| [record.x, record.y.measured()])
            .collect();
        self.is_good.fill(false);
        let mut stairs: Vec<[f64; 2]> = Vec::new();
        for index in front(&values, better) {
            self.is_good[index] = true;
            let here = self.at[index];
            match (stairs.last(), better[0]) {
                (Some(&before), Better::Higher) => stairs.push([before[0], here[1]]),
                (Some(&before), Better::Lower) => stairs.push([here[0], before[1]]),
                (None, Better::Higher) => stairs.push([self.inner.low[0], here[1]]),
                (None, Better::Lower) => {}
            }
            stairs.push(here);
        }
        if let (Better::Lower, Some(&[_, y])) = (better[0], stairs.last()) {
            stairs.push([self.inner.high[0], y]);
        }
        if stairs.len() > 1 {
            canvas.line(&stairs, 1.6, BLACK);
        }
        points_on(&stairs)
    }

    /// Joins the points of each series. Points on the lines come back.
    fn draw_lines(&self, canvas: &mut Canvas) -> Vec<[f64; 2]> {
        let mut on_lines = Vec::new();
        let mut drawn: Vec<&str> = Vec::new();
        for (record, style) in self.records.iter().zip(&self.styles) {
            if drawn.contains(&record.series.as_str()) {
                continue;
            }
            drawn.push(&record.series);
            let all = self.records.iter().zip(&self.at);
            let own = all.filter(|(other, _)| other.series == record.series);
            let mut line: Vec<[f64; 2]> = own.map(|(_, at)| *at).collect();
            line.sort_by(|a, b| a[0].total_cmp(&b[0]));
            if line.len() > 1 {
                canvas.line(&line, 1.5, style.color);
            }
            on_lines.extend(points_on(&line));
        }
        on_lines
    }

    /// Those that are dominated first.
    fn draw_markers(&self, canvas: &mut Canvas) {
        for good in [false, true] {
            for (index, record) in self.records.iter().enumerate() {
                if self.is_good[index] != good {
                    continue;
                }
                let style = &self.styles[index];
                let color = if good { style.color } else { greyed(style.color) };
                let marker = style.marker(self.at[index], self.radius);
                if record.is_marked {
                    canvas.line(&ring(self.at[index], RING), 1.6, BLACK);
                }
                if record.y.is_limit() {
                    canvas.outlined(marker, WHITE, color, 1.5);
                } else {
                    canvas.outlined(marker, color, WHITE, 0.6);
                }
            }
        }
    }

    /// Those that stand out first, then the good ones; what is dominated has a label where there is room.
    fn draw_labels(&self, canvas: &mut Canvas, obstacles: &[[f64; 2]]) {
        let is_optional = |index: usize| !self.is_good[index] && !self.records[index].is_marked;
        let mut order: Vec<usize> = (0..self.records.len()).collect();
        order.retain(|&index| !self.records[index].label.is_empty());
        order.sort_by_key(|&index| (is_optional(index), !self.records[index].is_marked));
        let wish = |&index: &usize| Wish {
            at: self.at[index],
            text: &self.records[index].label,
            reach: if self.records[index].is_marked { RING } else { RADIUS },
            is_optional: is_optional(index),
        };
        let wishes: Vec<Wish<'_>> = order.iter().map(wish).collect();
        let places = places(&wishes, obstacles, &self.inner, SMALL);
        for (wish, place) in wishes.iter().zip(places) {
            let Some(place) = place else { continue };
            if let Some([from, to]) = place.leader {
                canvas.line(&[from, to], 0.7, PALE);
            }
            let color = if wish.is_optional { GRAY } else { BLACK };
            canvas.text(place.at, Anchor::Start, SMALL, color, wish.text);
        }
    }
}

/// Points between the corners of a line.
fn points_on(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let between = |pair: &[[f64; 2]]| {
        let (from, to) = (pair[0], pair[1]);
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP) as u32;
        let at = move |step: u32| {
            let way = f64::from(step) / f64::from(steps);
            [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * way)
        };
        (1..steps).map(at).collect::<Vec<[f64; 2]>>()
    };
    line.windows(2).flat_map(between).collect()
}
