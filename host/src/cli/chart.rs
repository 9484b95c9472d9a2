//! `oktant chart`.

use super::Failure;
use super::arguments::{ChartArguments, ChartKind};
use super::bench::devices;
use super::progress_bar::ProgressBar;
use clap::ValueEnum;
use glam::uvec2;
use oktant::chart::{
    Figure, Plan, accuracy, chart_name, command_line, depth_error, growth, image_error, memory, octree, peers, range,
    samples,
};
use oktant::mesh_source::MeshSource;
use oktant::output::TextFile;
use oktant::progress::{Progress, silent};
use oktant::source::Source;
use std::path::Path;

/// Measures, reads and draws.
pub fn run(arguments: &ChartArguments) -> Result<(), Failure> {
    let (named, sources) = kinds_and_sources(&arguments.what)?;
    let reads = !arguments.from.is_empty() || !arguments.peers.is_empty();
    let kinds = kinds(named, &sources, reads)?;
    // Files first, so that nobody waits and then learns that one is none.
    let mut read = Vec::new();
    for path in &arguments.from {
        read.push(Figure::read(path)?);
    }
    for path in &arguments.peers {
        read.push(peers(path)?);
    }
    for source in &sources {
        source.load(&silent)?;
    }
    std::fs::create_dir_all(&arguments.output).map_err(|error| Failure {
        sentence: format!(
            "The folder {} cannot be made ({error}); give another name for it.",
            arguments.output.display()
        ),
        code: 1,
    })?;
    // Vanishes again: whether files can be written there.
    TextFile::create(&arguments.output.join("chart.csv"))?;
    if !kinds.is_empty() {
        let plan = plan(arguments, sources)?;
        for kind in kinds {
            // One for each, so that none is drawn across the names of files.
            let bar = ProgressBar::new();
            let figures = measured(kind, &plan, &|stage, fraction| bar.show(stage, fraction))?;
            drop(bar);
            // At once: should a later one fail, nothing measured is lost.
            for mut figure in figures {
                let stem = figure.stem.clone();
                for other in read.extract_if(.., |other| other.stem == stem) {
                    figure.merge(other);
                }
                save(&figure, &arguments.output)?;
            }
        }
    }
    let mut rest: Vec<Figure> = Vec::new();
    for figure in read {
        match rest.iter_mut().find(|own| own.stem == figure.stem) {
            Some(own) => own.merge(figure),
            None => rest.push(figure),
        }
    }
    rest.iter().try_for_each(|figure| save(figure, &arguments.output))
}

/// Writes the files of a figure and says their names.
fn save(figure: &Figure, folder: &Path) -> Result<(), Failure> {
    for path in figure.save(folder)? {
        super::print(&format!("{}\n", path.display()))?;
    }
    Ok(())
}

/// What is measured, of what.
fn plan(arguments: &ChartArguments, mut sources: Vec<Source>) -> Result<Plan, Failure> {
    if sources.is_empty() {
        sources.push(Source::default());
    }
    let mut meshes: Vec<MeshSource> = sources.iter().filter_map(mesh).cloned().collect();
    if meshes.is_empty() {
        // Nothing is measured of it: no chart of meshes is wanted.
        meshes.push(MeshSource::default());
    }
    Ok(Plan {
        meshes,
        sources,
        pictures: uvec2(arguments.pictures.width, arguments.pictures.height),
        devices: devices(&arguments.engine)?,
        size: uvec2(arguments.size.width, arguments.size.height),
        rays: arguments.rays as usize,
        repeats: arguments.repeat,
        largest: arguments.largest,
        command: command_line("oktant"),
    })
}

/// The mesh of a source that is a mesh alone.
fn mesh(source: &Source) -> Option<&MeshSource> {
    match source {
        Source::Mesh(mesh) => Some(mesh),
        Source::Several(_) | Source::Scene(_) => None,
    }
}

/// Which charts are measured, where these are named and `reads` says that others are read.
fn kinds(named: Vec<ChartKind>, sources: &[Source], reads: bool) -> Result<Vec<ChartKind>, Failure> {
    let has_only_scenes = !sources.is_empty() && !sources.iter().any(|source| mesh(source).is_some());
    let is_of_meshes = |kind: &ChartKind| matches!(kind, ChartKind::Accuracy | ChartKind::Octree | ChartKind::Memory);
    if has_only_scenes && named.iter().any(is_of_meshes) {
        return Err(Failure::usage(
            "accuracy, octree and memory are of meshes; name one, e.g. bunny, beside the scene.",
        ));
    }
    Ok(match (named.is_empty(), has_only_scenes) {
        (false, _) => named,
        (true, true) => vec![ChartKind::ImageError, ChartKind::DepthError, ChartKind::Samples],
        (true, false) if reads && sources.is_empty() => Vec::new(),
        (true, false) => ChartKind::value_variants().to_vec(),
    })
}

fn measured(kind: ChartKind, plan: &Plan, progress: Progress<'_>) -> Result<Vec<Figure>, Failure> {
    Ok(match kind {
        ChartKind::Accuracy => vec![accuracy(plan, progress)?],
        ChartKind::Range => range(plan, progress)?.into(),
        ChartKind::Octree => octree(plan, progress)?,
        ChartKind::Memory => vec![memory(plan, progress)?],
        ChartKind::Growth => vec![growth(plan, progress)?],
        ChartKind::ImageError => image_error(plan, progress)?.into(),
        ChartKind::DepthError => vec![depth_error(plan, progress)?],
        ChartKind::Samples => samples(plan, progress)?.into(),
    })
}

/// What names a chart, and what else there is, which is meshes and scenes, each once.
fn kinds_and_sources(what: &[String]) -> Result<(Vec<ChartKind>, Vec<Source>), Failure> {
    let mut kinds = Vec::new();
    let mut sources: Vec<Source> = Vec::new();
    for name in what {
        match ChartKind::from_str(name, false) {
            Ok(kind) if kinds.contains(&kind) => {}
            Ok(kind) => kinds.push(kind),
            Err(_) => {
                let source = Source::from_argument(Some(Path::new(name)));
                let called = chart_name(&source.to_string());
                match sources.iter().find(|own| chart_name(&own.to_string()) == called) {
                    None => sources.push(source),
                    Some(own) if is_same(own, &source) => {}
                    Some(own) => {
                        return Err(Failure::usage(format!(
                            "{own} and {source} are both called `{called}` in charts; rename one, or chart them apart."
                        )));
                    }
                }
            }
        }
    }
    Ok((kinds, sources))
}

/// Whether both are one mesh or file, by whatever path.
fn is_same(one: &Source, other: &Source) -> bool {
    let file = |source: &Source| match source {
        Source::Mesh(MeshSource::File(path)) | Source::Scene(path) => path.canonicalize().ok(),
        Source::Mesh(_) | Source::Several(_) => None,
    };
    one == other || file(one).is_some_and(|path| file(other) == Some(path))
}
