//! What `oktant bench` takes.

use super::EngineArguments;
use super::values::{Size, box_test, preset, size, traversal, triangle};
use clap::Args;
use clap::ValueEnum;
use oktant::bench::Workload;
use oktant::ray_sets::SetKind;
use oktant::tree::BuildPreset;
use oktant_shared::parts::{BoxKind, TraversalKind, TriangleKind};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Meshes on which to measure: files, or the built-in ones [default: bunny, where --scenes names nothing].
    #[arg(value_name = "MESH")]
    pub meshes: Vec<PathBuf>,
    /// Generated meshes on which to measure, separated by commas: room (from inside), stadium (a teapot in it), soup or
    /// soup=N (triangles without order), ball or ball=N (a bumpy ball), knot or knot=N (a smooth knot); N triangles, 100,000
    /// unless given.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub scenes: Vec<Workload>,
    /// Measure on each mesh a second time, with each triangle cut into four.
    #[arg(long)]
    pub split: bool,
    /// What to measure.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "thesis,parts")]
    pub tables: Vec<BenchTable>,
    /// Sets of rays: primary ones, to a light, mirrored, and for ambient occlusion.
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        default_value = "primary,shadow,mirror,ambient"
    )]
    pub sets: Vec<SetArgument>,
    /// Only combinations of these ways through the scene.
    #[arg(long, value_parser = traversal(), value_delimiter = ',')]
    pub traversal: Vec<TraversalKind>,
    /// Only combinations of these triangle tests.
    #[arg(long, value_parser = triangle(), value_delimiter = ',')]
    pub triangle: Vec<TriangleKind>,
    /// Only combinations of these box tests.
    #[arg(long = "box", value_parser = box_test(), value_delimiter = ',')]
    pub box_test: Vec<BoxKind>,
    /// Ways to build trees of boxes.
    #[arg(long, value_parser = preset(), value_delimiter = ',', default_value = "balanced")]
    pub build: Vec<BuildPreset>,
    /// What the work of rays costs on this device, as `oktant tune` measured it [default: what is the best on others].
    #[arg(long, value_name = "PROFILE.toml")]
    pub profile: Option<PathBuf>,
    /// Size of the pictures in pixels, a primary ray each.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x968")]
    pub size: Size,
    /// Measurements of each time, 1 to 10000.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
    /// Write the tables into a Markdown file too; - is standard output, which then has nothing else.
    #[arg(long, value_name = "FILE")]
    pub markdown: Option<PathBuf>,
    /// Write everything that was measured into a JSON file, or to standard output (-) instead of the tables; docs/bench.md
    /// describes it.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    #[command(flatten)]
    pub engine: EngineArguments,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BenchTable {
    /// The thesis's pictures.
    Thesis,
    /// All parts on sets of rays.
    Parts,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SetArgument {
    Primary,
    Shadow,
    Mirror,
    Ambient,
}

impl SetArgument {
    pub fn kind(self) -> SetKind {
        match self {
            SetArgument::Primary => SetKind::Primary,
            SetArgument::Shadow => SetKind::Shadow,
            SetArgument::Mirror => SetKind::Mirror,
            SetArgument::Ambient => SetKind::Ambient,
        }
    }
}
