//! `oktant stability`.

use super::Failure;
use super::arguments::StabilityArguments;
use super::bench::devices;
use super::progress_bar::ProgressBar;
use super::text_output::{self, goes_to_standard_output};
use oktant::bench::Device;
use oktant::stability::{Plan, page, run as run_lab, table};

/// Runs the lab, and prints and writes what it found; fails where the default is wrong anywhere.
pub fn run(arguments: &StabilityArguments) -> Result<(), Failure> {
    // First of all, so that nobody waits for what cannot be stored.
    let (json, html) = (arguments.json.as_deref(), arguments.html.as_deref());
    let is_printed = !goes_to_standard_output([("--json", json), ("--html", html)])?;
    let json = json.map(text_output::create).transpose()?;
    let html = html.map(text_output::create).transpose()?;
    let mut devices = devices(&arguments.engine)?;
    if !devices.iter().any(|device| matches!(device, Device::Cpu)) {
        // What exhibits are compared with.
        devices.insert(0, Device::Cpu);
    }
    let plan = Plan {
        rays: arguments.rays as usize,
        rows: arguments.rows.clone(),
        devices,
    };
    let bar = ProgressBar::new();
    let report = run_lab(&plan, &|stage, fraction| bar.show(stage, fraction))?;
    drop(bar);
    if is_printed {
        super::print(&table(&report))?;
    }
    if let Some(file) = json {
        file.save(&format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    }
    if let Some(file) = html {
        file.save(&page(&report))?;
    }
    match report.wrong_of_the_default() {
        0 => Ok(()),
        wrong => Err(Failure {
            sentence: format!("The default is wrong {wrong} times; --html FILE writes down the first of its rays."),
            code: 1,
        }),
    }
}
