//! How much is told while a command works.

use clap::{ArgAction, Args};
use tracing_subscriber::EnvFilter;

/// Where the list of options has what all commands take: behind their own, before `--help`.
const LAST: usize = 900;

/// How much is told on standard error.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct Verbosity {
    /// Tell more: how long reading and building take, and what renders; -vv also what the libraries say, -vvv everything.
    #[arg(short, long, global = true, action = ArgAction::Count, display_order = LAST)]
    pub verbose: u8,
    /// Leave warnings out, and tell of errors only; what a command says of its own work stays.
    #[arg(short, long, global = true, conflicts_with = "verbose", display_order = LAST)]
    pub quiet: bool,
}

/// Window systems warn of what nobody can change.
const USUAL: &str = "warn,winit=error,softbuffer=error";

impl Verbosity {
    /// What is told; where no option says it, the variable RUST_LOG does.
    pub fn filter(self) -> EnvFilter {
        match (self.quiet, self.verbose) {
            (true, _) => EnvFilter::new("error"),
            (_, 0) => EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(USUAL)),
            (_, 1) => EnvFilter::new(format!("{USUAL},oktant=info")),
            (_, 2) => EnvFilter::new("info,oktant=debug"),
            _ => EnvFilter::new("trace"),
        }
    }
}
