//! What `oktant chart` takes.

use super::EngineArguments;
use super::values::{Size, size};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct ChartArguments {
    /// Which charts, and what of: any of accuracy, range, octree, memory, growth, image-error, depth-error and samples [default:
    /// all of them, unless only --from or --peers are given; of scenes alone the last three], and mesh files or built-in meshes,
    /// and for the last three also scene files [default: bunny].
    #[arg(value_name = "CHART|MESH|SCENE")]
    pub what: Vec<String>,
    /// The folder for the charts, each as SVG, PNG and CSV; it is made where it is missing, files in it are replaced.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Rays that are aimed at edges and corners, 10 to 1000000000; of `range` a tenth for each point.
    #[arg(long, value_name = "N", default_value_t = 300_000, value_parser = clap::value_parser!(u32).range(10..=1_000_000_000))]
    pub rays: u32,
    /// Size of the pictures whose rays are traced, pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "640x484")]
    pub size: Size,
    /// Size of the pictures of `image-error`, `depth-error` and `samples`, pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "64x48")]
    pub pictures: Size,
    /// Measurements of each time, 1 to 10000; the quickest counts.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
    /// Triangles of the largest mesh of `growth`, 1000 to 40000000.
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(1_000..=40_000_000))]
    pub largest: u32,
    /// Add other people's tracers to `accuracy`: what `oktant-bench-peers --json FILE` wrote, with the same meshes and --size.
    #[arg(long, value_name = "FILE.json")]
    pub peers: Vec<PathBuf>,
    /// Draw what is in a CSV file of a chart, perhaps measured on another machine; several of the same chart become one,
    /// together with what is measured now.
    #[arg(long, value_name = "FILE.csv")]
    pub from: Vec<PathBuf>,
    #[command(flatten)]
    pub engine: EngineArguments,
}

/// What can be charted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ChartKind {
    /// Wrong answers against speed.
    Accuracy,
    /// Wrong answers against scale and distances.
    Range,
    /// Time and memory against depth and leaves of the octree.
    Octree,
    /// Speed against bytes a triangle.
    Memory,
    /// Work and time against the number of triangles.
    Growth,
    /// A picture's error against time, by samples and pattern.
    ImageError,
    /// A picture's error, and the bound on it, against depth and cut-off.
    DepthError,
    /// A picture's error against rays, by samples.
    Samples,
}
