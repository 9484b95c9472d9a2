//! The command line: arguments, and one file for each command.

mod arguments;
mod bench;
mod cast;
mod cells;
mod chart;
mod check;
mod compare;
mod config;
mod configuration;
mod engine;
mod frames;
mod info;
mod insight;
mod interruption;
mod kernels;
mod man;
mod prepared;
mod progress_bar;
mod reference;
mod render;
mod rendering_report;
mod scene_source;
mod sequence;
mod stability;
mod text_output;
mod trace;
mod tune;
mod view;

use arguments::{Arguments, Command};
use clap::{CommandFactory, Parser};
use std::io::IsTerminal;
use std::process::ExitCode;

/// Runs the command that the process was started with. The exit code is 0 where it succeeded, 2 where the command line
/// is wrong, 1 for every other failure; a failure is told in one sentence on standard error.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    tracing_subscriber::fmt()
        .with_env_filter(arguments.verbosity.filter())
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .without_time()
        .with_target(false)
        .init();
    interruption::listen();
    match configuration::complete(arguments.command).and_then(run_command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.tell();
            ExitCode::from(failure.code)
        }
    }
}

fn run_command(command: Command) -> Result<(), Failure> {
    match command {
        Command::View(arguments) => view::run(&arguments),
        Command::Render(arguments) => match (arguments.reference, arguments.insight.show) {
            (Some(takes), _) => reference::run(&arguments, takes),
            (None, Some(aspect)) => insight::run(&arguments, aspect),
            (None, None) => render::run(&arguments),
        },
        Command::Cast(arguments) => cast::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Chart(arguments) => chart::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Stability(arguments) => stability::run(&arguments),
        Command::Trace(arguments) => trace::run(&arguments),
        Command::Tune(arguments) => tune::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Config(arguments) => config::run(&arguments),
        Command::Kernels(arguments) => kernels::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
        Command::Completions { shell } => {
            let mut completions = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "oktant", &mut completions);
            print(&String::from_utf8_lossy(&completions))
        }
    }
}

/// Why a command did not do its work.
struct Failure {
    /// One sentence that says what to do; empty where everything has been told.
    sentence: String,
    /// 2 where the command line is wrong, else 1.
    code: u8,
}

impl Failure {
    fn usage(sentence: impl Into<String>) -> Self {
        Failure {
            sentence: sentence.into(),
            code: 2,
        }
    }

    /// Of a command that went on, and told each failure when it came.
    fn told() -> Self {
        Failure {
            sentence: String::new(),
            code: 1,
        }
    }

    fn tell(&self) {
        if !self.sentence.is_empty() {
            eprintln!("oktant: {}", self.sentence);
        }
    }
}

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Failure {
            sentence: error.to_string(),
            code: 1,
        }
    }
}

/// Writes to standard output; whoever closed it early wants no more.
fn print(text: &str) -> Result<(), Failure> {
    use std::io::Write;
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure {
            sentence: format!("Standard output cannot be written ({error}); send it somewhere else."),
            code: 1,
        }),
        _ => Ok(()),
    }
}
