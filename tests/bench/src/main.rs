//! Other people's ray tracers and oktant on the same rays, see docs/bench.md.

mod contestant;
mod contestants;
mod course;
mod race;
mod report;
mod threads;
mod triangle;

use clap::Parser;
use course::Course;
use oktant::mesh_source::MeshSource;
use oktant::output::TextFile;
use oktant::progress::silent;
use report::{ContestantReport, Report};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

/// Measures oktant and its peers on the same rays, each checked by the oracle first.
///
/// Ends with 1 where oktant misses a triangle or hits one that is not there, or where a peer is wrong so often that it
/// must have been called wrongly.
#[derive(Parser)]
#[command(version, about, max_term_width = 110)]
struct Arguments {
    /// Mesh files, or the built-in `bunny`, `balls` and `stadium`.
    #[arg(value_name = "MESH", default_value = "bunny")]
    meshes: Vec<PathBuf>,
    /// Size of the pictures of each of the three views, pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x968")]
    size: [u32; 2],
    /// Measurements of each time; with 0 everyone is only checked.
    #[arg(long, value_name = "N", default_value_t = 5)]
    repeat: usize,
    /// Only oktant and those whose name contains one of these.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    only: Vec<String>,
    /// Write everything into a JSON file.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// A peer that is wrong about more than this part of the rays has been called wrongly.
const MOST_WRONG: f64 = 1e-2;

fn size(text: &str) -> Result<[u32; 2], String> {
    let wanted = || "give width and height in pixels, up to 8192x8192, for example 1280x968".to_owned();
    let (width, height) = text.split_once('x').ok_or_else(wanted)?;
    let side = |text: &str| {
        text.parse()
            .ok()
            .filter(|side| (1..=8192).contains(side))
            .ok_or_else(wanted)
    };
    Ok([side(width)?, side(height)?])
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Whether everyone did what is to be expected.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let json = arguments.json.as_deref().map(TextFile::create).transpose()?;
    let mut entries = contestants::entries();
    let only = &arguments.only;
    entries
        .retain(|entry| entry.is_ours || only.is_empty() || only.iter().any(|name| entry.name.contains(name.as_str())));
    let mut report = Report {
        size: arguments.size,
        repeats: arguments.repeat,
        threads: race::THREADS,
        meshes: Vec::new(),
    };
    let mut sound = true;
    for mesh in &arguments.meshes {
        let source = MeshSource::from_argument(Some(mesh));
        let course = Course::new(source.to_string(), source.load(&silent)?, arguments.size);
        let told = race::race(&course, &entries, arguments.repeat)?;
        println!("{}", told.tables());
        for one in told.contestants.iter().filter(|one| !is_sound(one)) {
            let (surfaces, distances) = one.wrong();
            eprintln!(
                "{}: {surfaces} rays missed or false, {distances} with t off, of {}",
                one.name,
                one.rays()
            );
            sound = false;
        }
        report.meshes.push(told);
    }
    if let Some(json) = json {
        json.save(&format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    }
    Ok(sound)
}

/// Ours misses nothing and invents nothing; of the others only what cannot be their own fault counts.
fn is_sound(one: &ContestantReport) -> bool {
    let (surfaces, distances) = one.wrong();
    if one.is_ours {
        surfaces == 0
    } else {
        (surfaces + distances) as f64 <= MOST_WRONG * one.rays() as f64
    }
}
