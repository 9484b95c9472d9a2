//! What the lab found, for a terminal.

use super::report::{MethodReport, Report, Role, RowReport};
use comfy_table::{CellAlignment, Table, presets};
use std::fmt::Write;

/// A table for each row, and what it comes to.
pub fn table(report: &Report) -> String {
    let mut text = String::new();
    for row in &report.rows {
        let _ = writeln!(text, "{}: {}\n{}\n{}", row.id, row.title, row.input, methods(row));
        for method in &row.methods {
            // One of each; JSON and page have more.
            if let Some((kind, replay)) = method
                .failures
                .iter()
                .find_map(|it| Some((it.kind, it.replay.as_ref()?)))
            {
                let _ = writeln!(text, "{kind} by {}: {replay}", method.name);
            }
        }
        text.push('\n');
    }
    let wrong = report.wrong_of_the_default();
    let _ = writeln!(
        text,
        "{} rows on {}: the default is wrong {wrong} times.",
        report.rows.len(),
        report.devices.join(" and on ")
    );
    for line in &report.arithmetic {
        let _ = writeln!(text, "{line}.");
    }
    for row in &report.rows {
        let idle = row.idle();
        if !idle.is_empty() {
            let _ = writeln!(
                text,
                "{}: {} did not fail; more --rays may show it.",
                row.id,
                idle.join(", ")
            );
        }
    }
    text
}

fn methods(row: &RowReport) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED);
    table.set_header([
        "method",
        "",
        "device",
        "rays",
        "missed",
        "false",
        "farther",
        "not finite",
        "doubled",
        "excused",
        "excess",
        "time",
    ]);
    for method in &row.methods {
        table.add_row(cells(method));
    }
    for column in table.column_iter_mut().skip(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// One for each column.
pub fn cells(method: &MethodReport) -> [String; 12] {
    let counts = &method.counts;
    [
        method.name.clone(),
        match method.role {
            Role::Default => "default",
            Role::Twin => "its twin",
            Role::Offered => "",
            Role::Exhibit => "exhibit",
        }
        .into(),
        method.device.clone(),
        counts.rays.to_string(),
        counts.missed.to_string(),
        counts.phantom.to_string(),
        counts.farther.to_string(),
        counts.not_finite.to_string(),
        counts.doubled.map_or_else(String::new, |doubled| doubled.to_string()),
        counts.excused.to_string(),
        counts.excess.to_string(),
        method
            .time_ratio
            .map_or_else(String::new, |ratio| format!("{ratio:.2}")),
    ]
}
