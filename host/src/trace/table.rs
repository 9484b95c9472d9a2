//! What was written down of a ray, for a terminal.

use super::{Trace, TracedHit, Vec3Array};
use comfy_table::{CellAlignment, Table, presets};
use std::fmt::Write;

/// Hits beyond the first that are told.
const BEYOND: usize = 6;

/// All of it.
pub fn table(trace: &Trace) -> String {
    let mut text = String::new();
    let ray = &trace.ray;
    let _ = writeln!(
        text,
        "ray       from {} along {}, t from {:?} to {:?}{}",
        point(ray.origin),
        point(ray.direction),
        ray.t_min,
        ray.t_max,
        if ray.valid { "" } else { "; it can hit nothing" }
    );
    let parts = &trace.parts;
    let _ = writeln!(
        text,
        "parts     {}, {}, {}",
        parts.traversal, parts.triangle, parts.box_test
    );
    let _ = writeln!(text, "hit       {}", hit(trace.hit));
    let _ = writeln!(text, "f64       {}", hit(trace.right));
    let _ = writeln!(text, "          {}", trace.verdict);
    let _ = writeln!(text, "beyond    {}", beyond(&trace.beyond));
    if trace.advanced != 0.0 {
        let _ = writeln!(
            text,
            "advanced  by {:?} to shortly before the structure",
            trace.advanced
        );
    }
    let of = |kind: &str| trace.visits.iter().filter(|visit| visit.kind == kind).count();
    let depth = trace.visits.iter().map(|visit| visit.depth).max().unwrap_or(0);
    let _ = writeln!(
        text,
        "path      {} nodes, {} leaves, {} cells, to depth {depth}; {} triangle tests",
        of("node"),
        of("leaf"),
        of("cell"),
        trace.tests.len()
    );
    let boxes = trace.boxes.iter().map(|test| {
        let cells = [test.enter, test.exit].map(|t| format!("{t:?}"));
        [&[test.test.into(), yes(test.meets)], &cells[..]].concat()
    });
    add(&mut text, &["box round the mesh", "meets", "enter", "exit"], 2, boxes);
    let visits = trace.visits.iter().enumerate().map(|(at, visit)| {
        vec![
            at.to_string(),
            format!("{} {}", visit.kind, visit.index),
            visit.depth.to_string(),
            visit.triangles.to_string(),
            format!("{:?}", visit.limit),
            point(visit.low),
            point(visit.high),
        ]
    });
    add(
        &mut text,
        &["", "visited", "depth", "triangles", "nearest", "low", "high"],
        2,
        visits,
    );
    let tests = trace.tests.iter().flat_map(|tested| {
        let answers = tested.answers.iter().map(|answer| {
            let numbers = [answer.t, answer.u, answer.v];
            let cells = numbers.map(|number| {
                if answer.crosses {
                    format!("{number:?}")
                } else {
                    String::new()
                }
            });
            [
                &[tested.triangle.to_string(), answer.test.into(), yes(answer.crosses)],
                &cells[..],
            ]
            .concat()
        });
        let cells = tested.exact.map_or([const { String::new() }; 3], |met| {
            [met.t, met.u, met.v].map(|number| format!("{number:?}"))
        });
        let met = [&["".into(), "f64".into(), yes(tested.exact.is_some())], &cells[..]].concat();
        let exact = vec![
            "".into(),
            "exact".into(),
            tested.contact.into(),
            format!("edge at {:.3e}", tested.edge_distance),
        ];
        answers.chain([met, exact]).collect::<Vec<_>>()
    });
    add(&mut text, &["triangle", "test", "crosses", "t", "u", "v"], 3, tests);
    text
}

/// A table, whose columns from the given one on are numbers.
fn add(text: &mut String, header: &[&str], numbers: usize, rows: impl Iterator<Item = Vec<String>>) {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED);
    table.set_header(header);
    let mut is_empty = true;
    for row in rows {
        table.add_row(row);
        is_empty = false;
    }
    for column in table.column_iter_mut().skip(numbers) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    if !is_empty {
        let _ = writeln!(text, "\n{table}");
    }
}

fn point(coordinates: Vec3Array) -> String {
    let [x, y, z] = coordinates;
    format!("({x:?}, {y:?}, {z:?})")
}

fn hit(hit: Option<TracedHit>) -> String {
    hit.map_or_else(
        || "none".into(),
        |hit| {
            format!(
                "triangle {}, t = {:?}, u = {:?}, v = {:?}",
                hit.triangle, hit.t, hit.u, hit.v
            )
        },
    )
}

fn beyond(hits: &[TracedHit]) -> String {
    if hits.is_empty() {
        return "none".into();
    }
    let told = hits.iter().take(BEYOND);
    let mut words: Vec<String> = told
        .map(|hit| format!("triangle {}, t = {:?}", hit.triangle, hit.t))
        .collect();
    let left = hits.len() - words.len();
    if left > 0 {
        words.push(format!("and {left} more"));
    }
    words.join("; ")
}

fn yes(is: bool) -> String {
    if is { "yes" } else { "no" }.into()
}
