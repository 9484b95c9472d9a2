//! `oktant bench`.

use super::Failure;
use super::arguments::{BenchArguments, BenchTable, EngineArguments};
use super::progress_bar::ProgressBar;
use super::text_output::{self, goes_to_standard_output};
use glam::uvec2;
use oktant::backend::BackendChoice;
use oktant::backend::gpu::Gpu;
use oktant::bench::{BRUTE_BUDGET, Device, Plan, Report, Style, Workload, measure, tables, thesis};
use oktant::profile::Profile;
use oktant::ray_sets::SetKind;
use oktant_shared::parts::Parts;
use std::sync::Arc;

/// Measures, and prints and writes what was measured.
pub fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    // First of all, so that nobody waits for figures that cannot be stored.
    let (markdown, json) = (arguments.markdown.as_deref(), arguments.json.as_deref());
    let is_printed = !goes_to_standard_output([("--markdown", markdown), ("--json", json)])?;
    let markdown = markdown.map(text_output::create).transpose()?;
    let json = json.map(text_output::create).transpose()?;
    let plan = Plan {
        parts: chosen_parts(arguments)?,
        builds: without_repetition(&arguments.build),
        repeats: arguments.repeat,
        profile: arguments.profile.as_deref().map(Profile::read).transpose()?,
    };
    let sets: Vec<SetKind> = arguments.sets.iter().map(|set| set.kind()).collect();
    let devices = devices(&arguments.engine)?;
    let size = uvec2(arguments.size.width, arguments.size.height);
    let mut report = Report {
        version: env!("CARGO_PKG_VERSION"),
        size: size.to_array(),
        repeats: arguments.repeat,
        devices: devices.iter().map(Device::name).collect(),
        brute_budget: BRUTE_BUDGET,
        thesis: None,
        meshes: Vec::new(),
    };
    let bar = ProgressBar::new();
    let progress = |stage, fraction| bar.show(stage, fraction);
    if arguments.tables.contains(&BenchTable::Thesis) {
        report.thesis = Some(thesis(&devices, size, arguments.repeat)?);
    }
    if arguments.tables.contains(&BenchTable::Parts) {
        for workload in workloads(arguments) {
            let subject = workload.subject(&sets, size, &progress)?;
            report.meshes.push(measure(&subject, &plan, &devices, &progress)?);
        }
    }
    drop(bar);
    if is_printed {
        super::print(&tables(&report, Style::Terminal))?;
    }
    if let Some(file) = markdown {
        file.save(&tables(&report, Style::Markdown))?;
    }
    if let Some(file) = json {
        file.save(&format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    }
    Ok(())
}

/// The combinations that are offered and asked for.
fn chosen_parts(arguments: &BenchArguments) -> Result<Vec<Parts>, Failure> {
    let chosen: Vec<Parts> = Parts::OFFERED
        .iter()
        .copied()
        .filter(|parts| {
            is_chosen(&arguments.traversal, &parts.traversal)
                && is_chosen(&arguments.triangle, &parts.triangle)
                && is_chosen(&arguments.box_test, &parts.box_test)
        })
        .collect();
    if chosen.is_empty() {
        return Err(Failure::usage(
            "No combination of these parts is offered; leave one of --traversal, --triangle and --box out, or run \
             `oktant kernels` for what is offered.",
        ));
    }
    Ok(chosen)
}

fn is_chosen<T: PartialEq>(choice: &[T], one: &T) -> bool {
    choice.is_empty() || choice.contains(one)
}

/// The CPU, the GPU, or both: of `auto` a GPU is a real one. With `--kernel` there must be one.
pub fn devices(arguments: &EngineArguments) -> Result<Vec<Device>, Failure> {
    let options = arguments.options()?;
    let gpu = || Gpu::open(&options.gpu).map(|gpu| Device::Gpu(Arc::new(gpu)));
    Ok(match options.choice {
        BackendChoice::Cpu => vec![Device::Cpu],
        BackendChoice::Gpu => vec![gpu()?],
        BackendChoice::Auto if options.gpu.kernel.is_some() => vec![Device::Cpu, gpu()?],
        BackendChoice::Auto => match gpu() {
            Ok(gpu) => vec![Device::Cpu, gpu],
            Err(error) => {
                eprintln!("{}", error.and_the_cpu_renders());
                vec![Device::Cpu]
            }
        },
    })
}

fn workloads(arguments: &BenchArguments) -> Vec<Workload> {
    let named = arguments.meshes.iter().map(|mesh| Workload::of_argument(mesh));
    let mut workloads: Vec<Workload> = named.chain(arguments.scenes.iter().cloned()).collect();
    if workloads.is_empty() {
        workloads.push(Workload::of_argument("bunny".as_ref()));
    }
    if arguments.split {
        let whole = std::mem::take(&mut workloads);
        workloads.extend(
            whole
                .into_iter()
                .flat_map(|one| [one.clone(), Workload::Split(Box::new(one))]),
        );
    }
    workloads
}

fn without_repetition<T: PartialEq + Copy>(list: &[T]) -> Vec<T> {
    let mut different = Vec::new();
    for one in list {
        if !different.contains(one) {
            different.push(*one);
        }
    }
    different
}
