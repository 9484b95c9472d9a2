//! What the lab found, as one page that needs no other file.

use super::report::{Report, Role, RowReport};
use super::table::cells;
use std::fmt::Write;

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem;color:#222;\
background:#fff}table{border-collapse:collapse;font-variant-numeric:tabular-nums}th,td{padding:.15rem .6rem;\
border-bottom:1px solid #ddd;text-align:left}td:nth-child(n+4),th:nth-child(n+4){text-align:right}.default td{\
background:#e8f4e8}.exhibit td{color:#666}.wrong{color:#b00020;font-weight:600}.default.fails td{background:#ffd8d8}\
code{font-size:13px;overflow-wrap:anywhere}h2{margin-top:2.5rem}@media(prefers-color-scheme:dark){body{background:#181818;\
color:#ddd}th,td{border-color:#444}.default td{background:#1d3320}.exhibit td{color:#999}.wrong{color:#ff8a80}\
.default.fails td{background:#5a1f1f}}";

/// The page.
pub fn page(report: &Report) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width\">\n<title>oktant: stability</title>\n<style>{STYLE}</style>\n<h1>Where methods fail\
         </h1>\n"
    );
    let _ = writeln!(
        page,
        "<p>oktant {}, up to {} rays a row, on {}. The default is wrong <b>{}</b> times. Wrong answers are missed, false, \
         farther and not finite ones; those that the rounding of f32 excuses, and rays that cross more triangles than there \
         are to cross, are counted apart. Where a row says so, work and memory beyond a bound are wrong too. The \
         commands trace a ray again: origin and direction, then the limits of t where there are any; the numbers are exact.</p>",
        escaped(report.version),
        report.rays,
        escaped(&report.devices.join(" and on ")),
        report.wrong_of_the_default()
    );
    for row in &report.rows {
        add_row(&mut page, row);
    }
    page.push_str("</html>\n");
    page
}

fn add_row(page: &mut String, row: &RowReport) {
    let _ = writeln!(
        page,
        "<h2 id=\"{id}\">{id}: {}</h2>\n<p>{}.<br>Remedy: {}.</p>\n<table>\n<tr><th>method<th><th>device<th>rays<th>missed\
         <th>false<th>farther<th>not finite<th>doubled<th>excused<th>excess<th>time</tr>",
        escaped(row.title),
        escaped(row.input),
        escaped(row.remedy),
        id = row.id
    );
    for method in &row.methods {
        let class = match method.role {
            Role::Default | Role::Twin if method.counts.wrong() > 0 => "default fails",
            Role::Default | Role::Twin => "default",
            Role::Offered => "offered",
            Role::Exhibit => "exhibit",
        };
        let _ = write!(page, "<tr class=\"{class}\">");
        for (column, cell) in cells(method).iter().enumerate() {
            let is_wrong = ((4..8).contains(&column) || column == 10) && cell != "0";
            let mark = if is_wrong { " class=\"wrong\"" } else { "" };
            let _ = write!(page, "<td{mark}>{}", escaped(cell));
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</table>\n");
    for method in row.methods.iter().filter(|method| !method.failures.is_empty()) {
        let _ = writeln!(
            page,
            "<details><summary>{} on {}: the first wrong answers</summary>\n<ul>",
            escaped(&method.name),
            escaped(&method.device)
        );
        for failure in &method.failures {
            let t = |t: Option<String>| t.map_or_else(|| "none".into(), |t| format!("t = {t}"));
            let _ = writeln!(
                page,
                "<li>{}: <code>{}</code>; right: {}, answer: {}",
                failure.kind,
                escaped(
                    failure
                        .replay
                        .as_ref()
                        .or(failure.ray.as_ref())
                        .map_or("no ray", String::as_str)
                ),
                t(failure.right.map(|t| format!("{t:?}"))),
                t(failure.answer.map(|t| format!("{t:?}")))
            );
            for corners in &failure.corners {
                let _ = writeln!(page, "<br><code>{}</code>", escaped(&format!("{corners:?}")));
            }
            page.push_str("</li>\n");
        }
        page.push_str("</ul></details>\n");
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
