//! What `oktant stability` takes.

use super::EngineArguments;
use clap::Args;
use clap::builder::PossibleValuesParser;
use oktant::stability::row_ids;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct StabilityArguments {
    /// Rays of each row, where there are not fewer, 1 to 100000000.
    #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    pub rays: u32,
    /// Only these rows, separated by commas; docs/stability.md describes them.
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_possible_values = true, value_parser = PossibleValuesParser::new(row_ids()))]
    pub rows: Vec<String>,
    /// Write everything into a JSON file; - is standard output, which then has nothing else.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write everything, with wrong answers written out, as one page; - likewise.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    #[command(flatten)]
    pub engine: EngineArguments,
}
