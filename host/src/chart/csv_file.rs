//! Figures as files that programs and people read, and that they can be drawn from again.

use super::figure::{Figure, Panel};
use super::origin::Origin;
use super::record::{Record, Value};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// Why a file of data cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ChartFileError {
    /// The system does not let it be read.
    #[error("{} cannot be read ({source}); give the name of a file that `oktant chart` wrote.", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// It is something else.
    #[error("{} is not what `oktant chart` writes ({reason}); give one of its CSV files.", path.display())]
    Other {
        /// The file.
        path: PathBuf,
        /// What is not as it should be.
        reason: String,
    },
    /// It is not a report of other people's tracers.
    #[error("{} is not what `oktant-bench-peers --json` writes ({reason}); give such a file.", path.display())]
    Peers {
        /// The file.
        path: PathBuf,
        /// What is not as it should be.
        reason: String,
    },
}

const COLUMNS: [&str; 8] = ["panel", "series", "label", "x", "y", "count", "of", "marked"];

impl Figure {
    /// The figure as a file: lines that begin with `#` say what it is and where it comes from, then there is a line for each
    /// record. A rate has `count` and `of`, and `y` as it is drawn.
    pub fn to_csv(&self) -> String {
        let mut text = String::new();
        let heads = [
            ("chart", &self.stem),
            ("title", &self.title),
            ("explanation", &self.explanation),
            ("machine", &self.origin.machine),
            ("commit", &self.origin.commit),
            ("command", &self.origin.command),
        ];
        for (name, value) in heads {
            let _ = writeln!(text, "# {name}: {}", value.replace(['\n', '\r'], " "));
        }
        for panel in &self.panels {
            let panel = serde_json::to_string(panel).unwrap_or_default();
            let _ = writeln!(text, "# panel: {panel}");
        }
        // So that what begins as a comment is quoted.
        let mut writer = csv::WriterBuilder::new().comment(Some(b'#')).from_writer(Vec::new());
        let rows = self.records.iter().map(|record| {
            let (count, of) = match record.y {
                Value::Number(_) => (String::new(), String::new()),
                Value::Rate { count, of } => (count.to_string(), of.to_string()),
            };
            [
                record.panel.clone(),
                record.series.clone(),
                record.label.clone(),
                record.x.to_string(),
                record.y.drawn().to_string(),
                count,
                of,
                if record.is_marked { "yes".into() } else { String::new() },
            ]
        });
        let head = std::iter::once(COLUMNS.map(String::from));
        let written = head.chain(rows).try_for_each(|row| writer.write_record(row));
        let bytes = written.ok().and_then(|()| writer.into_inner().ok());
        text.push_str(&String::from_utf8_lossy(&bytes.unwrap_or_default()));
        text
    }

    /// Reads such a file.
    ///
    /// # Errors
    /// [`ChartFileError`].
    pub fn read(path: &Path) -> Result<Self, ChartFileError> {
        let text = fs::read_to_string(path).map_err(|source| ChartFileError::Io {
            path: path.into(),
            source,
        })?;
        parse(&text).map_err(|reason| ChartFileError::Other {
            path: path.into(),
            reason,
        })
    }
}

fn parse(text: &str) -> Result<Figure, String> {
    let all = |name: &str| {
        let begin = format!("# {name}: ");
        let lines = text.lines().filter_map(|line| line.strip_prefix(&begin));
        lines.map(String::from).collect::<Vec<String>>()
    };
    let head = |name: &str| all(name).pop().ok_or(format!("there is no line `# {name}: `"));
    let panels = all("panel");
    let panels = panels.iter().map(|panel| serde_json::from_str(panel));
    let panels: Vec<Panel> = panels.collect::<Result<_, _>>().map_err(|error| error.to_string())?;
    let stem = head("chart")?;
    let is_name = |character: char| character.is_ascii_alphanumeric() || "-_".contains(character);
    if !stem.chars().all(is_name) {
        return Err(format!("`{stem}` is no name of a chart"));
    }
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let columns = reader.headers().map_err(|error| error.to_string())?;
    if columns != COLUMNS.as_slice() {
        return Err(format!("its columns are not {}", COLUMNS.join(",")));
    }
    let mut records = Vec::new();
    for row in reader.records() {
        let row = row.map_err(|error| error.to_string())?;
        let line = row.position().map_or(0, |position| position.line());
        let record = record(&row).map_err(|fault| format!("line {line} has {fault}"))?;
        if !panels.iter().any(|panel| panel.name == record.panel) {
            return Err(format!("line {line} is of a panel that is not described"));
        }
        records.push(record);
    }
    Ok(Figure {
        stem,
        title: head("title")?,
        explanation: head("explanation")?,
        panels,
        records,
        origin: Origin {
            machine: head("machine")?,
            commit: head("commit")?,
            command: head("command")?,
        },
    })
}

/// What a number other than 0 can be without its sign; axes could not hold others.
const SIZES: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

const NO_NUMBER: &str = "a number that is none";

/// A row as a record, or what of it cannot be used.
fn record(row: &csv::StringRecord) -> Result<Record, &'static str> {
    let number = |column: usize| {
        let number: f64 = row[column].parse().map_err(|_| NO_NUMBER)?;
        match number {
            _ if !number.is_finite() => Err(NO_NUMBER),
            _ if number != 0.0 && !SIZES.contains(&number.abs()) => {
                Err("a number that is neither 0 nor of a size from 1e-100 to 1e100")
            }
            _ => Ok(number),
        }
    };
    let whole = |column: usize| row[column].parse::<u64>().map_err(|_| NO_NUMBER);
    let y = if row[6].is_empty() {
        Value::Number(number(4)?)
    } else {
        Value::Rate {
            count: whole(5)?,
            of: Some(whole(6)?).filter(|of| *of > 0).ok_or(NO_NUMBER)?,
        }
    };
    Ok(Record {
        panel: row[0].into(),
        series: row[1].into(),
        label: row[2].into(),
        x: number(3)?,
        y,
        is_marked: !row[7].is_empty(),
    })
}
