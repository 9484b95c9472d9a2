//! Other people's ray tracers and oktant on the same rays, see docs/bench.md.

mod contestant;
mod contestants;
mod course;
mod gpu;
mod pins;
mod race;
mod report;
mod threads;
mod triangle;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use course::Course;
use gpu::GpuEntry;
use oktant::backend::gpu::{Gpu, GpuOptions, ModulePath};
use oktant::chart::{Origin, command_line};
use oktant::mesh_source::MeshSource;
use oktant::output::TextFile;
use oktant::progress::silent;
use pins::Pins;
use report::{ContestantReport, Report};
use std::error::Error;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Measures oktant and its peers on the same rays, each checked by the oracle first.
///
/// Ends with 1 where oktant misses a triangle or hits one that is not there and rounding is not to blame, where a peer is wrong so often that it must
/// have been called wrongly, or where someone is wrong about other rays than is written down.
#[derive(Parser)]
#[command(version, about, max_term_width = 110)]
struct Arguments {
    /// Mesh files, or the built-in `bunny`, `balls` and `stadium`.
    #[arg(value_name = "MESH", default_value = "bunny")]
    meshes: Vec<PathBuf>,
    /// Where to race.
    #[arg(long, value_name = "WHERE", default_value = "cpu")]
    backend: Backend,

    /// How kernels reach the GPU's driver: unchanged where it takes them so, or translated by naga.
    #[arg(long, value_name = "PATH", default_value = "auto")]
    spirv: Spirv,

    /// Size of the pictures whose rays are traced, of three views on the CPU, of one on a GPU, pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x968")]
    size: [u32; 2],
    /// Measurements of each time; with 0 everyone is only checked.
    #[arg(long, value_name = "N", default_value_t = 5)]
    repeat: usize,
    /// Only oktant and those whose name contains one of these.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    only: Vec<String>,
    /// Trace the rays of `oktant chart accuracy --rays N`: N at edges and corners of a closed ball first, where a peer may leak
    /// as it likes, then of three views, also on a GPU.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(10..=1_000_000_000))]
    chart: Option<u32>,
    /// Write everything into a JSON file.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// On the CPU, write down in this file who is wrong how often, rather than compare: tests/bench/wrong.toml is what is compared.
    #[arg(long, value_name = "FILE")]
    bless: Option<PathBuf>,
}

/// Where contestants run.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum Backend {
    /// Libraries on one thread and on two.
    Cpu,
    /// Kernels on the best GPU there is, or on a software one.
    Gpu,
}

/// How kernels reach a driver.
#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum Spirv {
    /// Unchanged where that is possible, else through naga.
    Auto,
    /// Unchanged.
    Passthrough,
    /// Through naga.
    Naga,
}

/// What is traced, one after the other.
enum Lap<'a> {
    /// So many rays at a closed ball.
    Leaks(usize),
    /// The rays of pictures of a mesh.
    Mesh(&'a PathBuf),
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
    let arguments = Arguments::parse();
    if arguments.backend == Backend::Gpu && arguments.bless.is_some() {
        let message = "--bless is for --backend cpu: what GPUs compute is not written down.";
        Arguments::command().error(ErrorKind::ArgumentConflict, message).exit();
    }
    match run(&arguments) {
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
    let only = &arguments.only;
    let wanted = |name: &str, is_ours: bool| {
        is_ours || only.is_empty() || only.iter().any(|wanted| name.contains(wanted.as_str()))
    };
    let mut entries = contestants::entries();
    entries.retain(|entry| wanted(entry.name, entry.is_ours));
    let gpu = match arguments.backend {
        Backend::Cpu => None,
        Backend::Gpu => Some(Gpu::open(&GpuOptions {
            software: true,
            module: match arguments.spirv {
                Spirv::Auto => ModulePath::Auto,
                Spirv::Passthrough => ModulePath::Passthrough,
                Spirv::Naga => ModulePath::Naga,
            },
            kernel: None,
        })?),
    };
    let adapters: Vec<String> = gpu.iter().map(|gpu| gpu.name.clone()).collect();
    let origin = Origin::here(&adapters, command_line("oktant-bench-peers"));
    let mut report = Report {
        machine: origin.machine,
        commit: origin.commit,
        command: origin.command,
        size: arguments.size,
        repeats: arguments.repeat,
        meshes: Vec::new(),
    };
    let pins = Pins::written()?;
    let mut sound = true;
    let is_for_chart = arguments.chart.is_some();
    let leaks = arguments.chart.map(|count| Lap::Leaks(count as usize));
    for lap in leaks.into_iter().chain(arguments.meshes.iter().map(Lap::Mesh)) {
        let course = match lap {
            Lap::Leaks(count) => Course::leaks(count),
            Lap::Mesh(path) => {
                let source = MeshSource::from_argument(Some(path));
                let (name, mesh) = (source.to_string(), source.load(&silent)?);
                match gpu {
                    Some(_) if !is_for_chart => Course::fitted(name, mesh, arguments.size),
                    _ => Course::outer(name, mesh, arguments.size),
                }
            }
        };
        let told = match &gpu {
            None => race::race(&course, &entries, arguments.repeat)?,
            Some(gpu) => {
                let wanted = |entry: &GpuEntry| wanted(entry.name, entry.is_ours);
                gpu::race(&course, gpu, wanted, arguments.repeat)?
            }
        };
        writeln!(io::stdout(), "{}", told.tables())?;
        let is_ours_or_sought = |one: &&ContestantReport| one.is_ours || matches!(lap, Lap::Mesh(_));
        for one in told
            .contestants
            .iter()
            .filter(is_ours_or_sought)
            .filter(|one| !is_sound(one))
        {
            let (surfaces, distances) = one.wrong();
            eprintln!(
                "{}: {surfaces} rays missed or false, {distances} with t off, of {}",
                one.name,
                one.rays()
            );
            sound = false;
        }
        if gpu.is_none() && arguments.bless.is_none() {
            for difference in pins.differences(arguments.size, &told) {
                eprintln!("{difference}");
                sound = false;
            }
        }
        report.meshes.push(told);
    }
    if let Some(path) = &arguments.bless {
        Pins::bless(path, arguments.size, &report.meshes)?;
    }
    if let Some(json) = json {
        json.save(&format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    }
    Ok(sound)
}

/// Ours misses nothing and invents nothing, but where rounding is to blame; of the others only what cannot be their own
/// fault counts.
fn is_sound(one: &ContestantReport) -> bool {
    let (surfaces, distances) = one.wrong();
    if one.is_ours {
        let mut judged = one.sets.iter().map(|set| &set.judgement);
        judged.all(|set| set.missed + set.phantom == 0 || set.excused == set.disagreeing())
    } else {
        (surfaces + distances) as f64 <= MOST_WRONG * one.rays() as f64
    }
}
