//! What `oktant tune` takes.

use super::EngineArguments;
use super::values::{Size, size};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct TuneArguments {
    /// Where the profile goes (TOML); - is standard output, which then has nothing else. An existing file is replaced once the
    /// new one is complete.
    #[arg(short, long, value_name = "PROFILE.toml")]
    pub output: PathBuf,
    /// Size of the pictures in pixels, a primary ray each [default: 640x484; 1280x968 on a GPU that is not software].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Measurements of each time, 1 to 10000, of which the quickest counts.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
    #[command(flatten)]
    pub engine: EngineArguments,
}
