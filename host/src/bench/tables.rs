//! What was measured, for people.

use super::judgement::Judgement;
use super::report::{CombinationReport, Report, SetReport, SubjectReport};
use super::thesis::{THESIS_BUNNY, ThesisReport};
use comfy_table::{CellAlignment, Table, presets};
use std::fmt::Write;

/// How tables are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// With lines.
    Terminal,
    /// As Markdown has them.
    Markdown,
}

/// All tables of a report, one after the other, each with a heading.
pub fn tables(report: &Report, style: Style) -> String {
    let mut text = String::new();
    let mut add = |heading: &str, remarks: &[String], table: Option<Table>| {
        let (level, end) = match style {
            Style::Terminal => ("", ""),
            Style::Markdown => ("## ", "\n"),
        };
        let _ = writeln!(text, "{level}{heading}\n{end}{}", remarks.join("\n"));
        if let Some(table) = table {
            let _ = writeln!(text, "{end}{table}");
        }
        text.push('\n');
    };
    let [width, height] = report.size;
    let measured = format!(
        "{width} x {height} pixels; medians of {}, of fewer where one takes long.",
        report.repeats
    );
    if let Some(thesis) = &report.thesis {
        let remark = format!(
            "{measured} Kernel time of a frame with one light, a shadow ray and no secondary rays. The thesis's bunny has \
             {THESIS_BUNNY} triangles."
        );
        add(
            "The pictures of the thesis",
            &[remark],
            Some(thesis_table(thesis, style)),
        );
    }
    for mesh in &report.meshes {
        let heading = format!("{}, {} triangles", mesh.name, mesh.triangles);
        let mut remarks = vec![sets_in_words(mesh)];
        if brute_is_missing(mesh) {
            remarks.push(format!(
                "Brute force is left out where a set takes more than {} tests.",
                report.brute_budget
            ));
        }
        add(&heading, &remarks, None);
        for device in &report.devices {
            let heading = format!("{}: Mrays/s on {device}", mesh.name);
            let remark = format!("{measured} Wrong: missed, false and t off by more than 10^-5, of all sets.");
            add(&heading, &[remark], Some(speeds(mesh, device, style)));
        }
        let remark = "Nodes + triangle tests of a ray, counted.".to_owned();
        add(&format!("{}: work", mesh.name), &[remark], Some(work(mesh, style)));
        let listed = disagreements(mesh);
        if !listed.is_empty() {
            add(
                &format!("{}: rays not as the oracle has them", mesh.name),
                &listed,
                None,
            );
        }
    }
    text
}

fn new_table(style: Style, header: Vec<String>, left: usize) -> Table {
    let mut table = Table::new();
    table.load_style(match style {
        Style::Terminal => presets::UTF8_FULL_CONDENSED,
        Style::Markdown => presets::ASCII_MARKDOWN,
    });
    table.set_header(header);
    for column in table.column_iter_mut().skip(left) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn thesis_table(thesis: &ThesisReport, style: Style) -> Table {
    let header = ["mesh", "triangles", "picture", "on", "ms", "frames/s", "thesis", "gain"];
    let mut table = new_table(style, header.map(String::from).to_vec(), 4);
    for row in &thesis.rows {
        table.add_row([
            row.mesh.clone(),
            row.triangles.to_string(),
            row.style.to_owned(),
            row.device.clone(),
            figures(row.milliseconds.median),
            figures(row.frames_per_second),
            row.thesis.to_string(),
            figures(row.gain),
        ]);
    }
    table
}

/// The names of a combination, in four columns.
fn names(combination: &CombinationReport) -> Vec<String> {
    let parts = combination.parts;
    [
        parts.traversal,
        parts.triangle,
        parts.box_test,
        combination.build.unwrap_or("-"),
    ]
    .map(String::from)
    .to_vec()
}

fn header(mesh: &SubjectReport, between: &[&str], after: &[&str]) -> Vec<String> {
    let sets = mesh.sets.iter().map(|set| set.set);
    let names = ["traversal", "triangle", "box", "build"].into_iter();
    let columns = names.chain(between.iter().copied()).chain(sets);
    columns.chain(after.iter().copied()).map(String::from).collect()
}

/// What a combination has for each set of the mesh, a dash where it did not take part.
fn by_set(
    mesh: &SubjectReport,
    combination: &CombinationReport,
    cell: impl Fn(&SetReport) -> Option<String>,
) -> Vec<String> {
    let of = |name| combination.sets.iter().find(|set| set.set == name).and_then(&cell);
    mesh.sets
        .iter()
        .map(|set| of(set.set).unwrap_or("-".to_owned()))
        .collect()
}

fn speeds(mesh: &SubjectReport, device: &str, style: Style) -> Table {
    let header = header(mesh, &["build ms", "bytes/tri"], &["wrong", "excused"]);
    let mut table = new_table(style, header, 4);
    for combination in &mesh.combinations {
        let on = |set: &SetReport| set.devices.iter().find(|one| one.device == device).cloned();
        let judgements: Vec<Judgement> = combination
            .sets
            .iter()
            .filter_map(on)
            .map(|one| one.judgement)
            .collect();
        if judgements.is_empty() {
            continue;
        }
        let sum = |count: fn(&Judgement) -> usize| judgements.iter().map(count).sum::<usize>();
        let mut row = names(combination);
        row.push(figures(combination.build_milliseconds.median));
        row.push(format!("{:.1}", combination.bytes_per_triangle));
        row.extend(by_set(mesh, combination, |set| {
            on(set).map(|one| figures(one.mrays_per_second.median))
        }));
        let wrong = [sum(|one| one.missed), sum(|one| one.phantom), sum(|one| one.wrong_t)];
        row.push(wrong.map(|count| count.to_string()).join(" / "));
        row.push(sum(|one| one.excused).to_string());
        table.add_row(row);
    }
    table
}

fn work(mesh: &SubjectReport, style: Style) -> Table {
    let mut table = new_table(style, header(mesh, &[], &[]), 4);
    for combination in &mesh.combinations {
        let mut row = names(combination);
        row.extend(by_set(mesh, combination, |set| {
            Some(format!("{:.2} + {:.2}", set.nodes_per_ray, set.triangle_tests_per_ray))
        }));
        table.add_row(row);
    }
    table
}

fn sets_in_words(mesh: &SubjectReport) -> String {
    let set = |set: &super::report::TruthReport| format!("{} {} rays, {} hits", set.set, set.rays, set.hits);
    mesh.sets.iter().map(set).collect::<Vec<_>>().join("; ")
}

fn brute_is_missing(mesh: &SubjectReport) -> bool {
    let brute = mesh.combinations.iter().find(|one| one.parts.traversal == "brute");
    brute.is_none_or(|brute| brute.sets.len() < mesh.sets.len())
}

/// A line for each set of each combination with rays that were answered otherwise than by the oracle.
fn disagreements(mesh: &SubjectReport) -> Vec<String> {
    let mut lines = Vec::new();
    for combination in &mesh.combinations {
        for set in &combination.sets {
            for one in set.devices.iter().filter(|one| one.judgement.disagreeing() > 0) {
                let judged = &one.judgement;
                let listed: Vec<String> = judged.disagreements.iter().map(|one| one.to_string()).collect();
                let rest = judged.disagreeing() - listed.len();
                let more = if rest > 0 {
                    format!(" and {rest} more")
                } else {
                    String::new()
                };
                lines.push(format!(
                    "- {} {} {} {} on {}: {}{more}",
                    names(combination).join(" "),
                    set.set,
                    judged.disagreeing(),
                    if judged.disagreeing() == 1 { "ray" } else { "rays" },
                    one.device,
                    listed.join(", "),
                ));
            }
        }
    }
    lines
}

/// A number with three significant digits, or all before its point.
fn figures(number: f64) -> String {
    let before = number.abs().max(1e-9).log10().floor() as i32;
    format!("{number:.*}", (2 - before).clamp(0, 6) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits() {
        for (number, text) in [
            (0.0, "0.000000"),
            (0.012_34, "0.0123"),
            (1.0, "1.00"),
            (12.34, "12.3"),
            (12_345.6, "12346"),
        ] {
            assert_eq!(figures(number), text);
        }
    }
}
