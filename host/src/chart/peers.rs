//! Other people's tracers on the same rays, as `oktant-bench-peers --json` wrote it down.

use super::accuracy::{panel, picture_panel};
use super::csv_file::ChartFileError;
use super::figure::Figure;
use super::leaks::LEAKS;
use super::origin::Origin;
use super::record::{Record, Value};
use serde::Deserialize;
use std::fs;
use std::path::Path;

#[derive(Deserialize)]
struct Report {
    #[serde(default)]
    machine: String,
    #[serde(default)]
    commit: String,
    /// Empty in what earlier versions wrote.
    #[serde(default)]
    command: String,
    meshes: Vec<Course>,
}

#[derive(Deserialize)]
struct Course {
    name: String,
    conditions: Vec<String>,
    contestants: Vec<Contestant>,
}

#[derive(Deserialize)]
struct Contestant {
    name: String,
    is_ours: bool,
    sets: Vec<Set>,
}

#[derive(Deserialize)]
struct Set {
    rays: u64,
    mrays_per_second: Vec<Option<Speeds>>,
    judgement: Judgement,
}

#[derive(Deserialize)]
struct Speeds {
    greatest: f64,
}

#[derive(Deserialize)]
struct Judgement {
    missed: u64,
    #[serde(rename = "false")]
    phantom: u64,
    wrong_t: u64,
}

/// Reads such a file as panels of [`super::accuracy`].
///
/// # Errors
/// [`ChartFileError`].
pub fn peers(path: &Path) -> Result<Figure, ChartFileError> {
    let text = fs::read_to_string(path).map_err(|source| ChartFileError::Io {
        path: path.into(),
        source,
    })?;
    let report: Report = serde_json::from_str(&text).map_err(|error| ChartFileError::Peers {
        path: path.into(),
        reason: error.to_string(),
    })?;
    let command = if report.command.is_empty() {
        let file = path.file_name().unwrap_or_default();
        format!("oktant-bench-peers --json {}", file.to_string_lossy())
    } else {
        report.command
    };
    let mut figure = Figure {
        stem: "accuracy".into(),
        title: "Other people's tracers".into(),
        explanation: String::new(),
        panels: Vec::new(),
        records: Vec::new(),
        origin: Origin {
            machine: report.machine,
            commit: report.commit,
            command,
        },
    };
    for course in report.meshes {
        let name = if course.name == LEAKS {
            course.name.clone()
        } else {
            picture_panel(&course.name)
        };
        figure.panels.push(panel(&name));
        let condition = condition(&course.conditions);
        let device = course.conditions.get(condition).map_or("", String::as_str);
        let device = if device.contains("thread") {
            "CPU"
        } else {
            device.split([',', '(']).next().unwrap_or(device).trim()
        };
        for one in &course.contestants {
            let Some(record) = record(&name, device, one, condition) else {
                continue;
            };
            figure.records.push(record);
        }
    }
    Ok(figure)
}

/// Which of the conditions is most like this program's: on the CPU as many threads.
fn condition(conditions: &[String]) -> usize {
    let own = format!("{} thread", rayon::current_num_threads());
    let like = conditions.iter().position(|condition| condition.starts_with(&own));
    like.unwrap_or(conditions.len().saturating_sub(1))
}

/// None of one without times.
fn record(panel: &str, device: &str, one: &Contestant, condition: usize) -> Option<Record> {
    let mut seconds = 0.0;
    let (mut rays, mut wrong) = (0, 0);
    for set in &one.sets {
        let speed = set.mrays_per_second.get(condition)?.as_ref()?.greatest;
        seconds += set.rays as f64 / speed / 1e6;
        rays += set.rays;
        let Judgement {
            missed,
            phantom,
            wrong_t,
        } = set.judgement;
        wrong += if panel == LEAKS {
            missed
        } else {
            missed + phantom + wrong_t
        };
    }
    (rays > 0).then(|| Record {
        panel: panel.into(),
        series: if one.is_ours {
            format!("oktant among the peers, {device}")
        } else {
            format!("peers, {device}")
        },
        label: one.name.clone(),
        x: rays as f64 / seconds / 1e6,
        y: Value::Rate { count: wrong, of: rays },
        is_marked: false,
    })
}
