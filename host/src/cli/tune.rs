//! `oktant tune`.

use super::Failure;
use super::arguments::{TuneArguments, is_standard_output};
use super::bench::devices;
use super::progress_bar::ProgressBar;
use super::text_output;
use glam::uvec2;
use oktant::costs::Costs;
use oktant::tune::{Plan, tune};

/// Measures a device, prints what was found and writes it into a profile.
pub fn run(arguments: &TuneArguments) -> Result<(), Failure> {
    // First of all, so that nobody waits for figures that cannot be stored.
    let file = text_output::create(&arguments.output)?;
    // Of both, the real GPU.
    let Some(device) = devices(&arguments.engine)?.pop() else {
        return Err(Failure::usage("There is nothing to measure; give --backend cpu."));
    };
    let size = arguments.size.map(|size| uvec2(size.width, size.height));
    let plan = Plan {
        size: size.unwrap_or_else(|| Plan::size_for(&device)),
        repeats: arguments.repeat,
    };
    let bar = ProgressBar::new();
    let tuning = tune(&device, &plan, &|stage, fraction| bar.show(stage, fraction))?;
    drop(bar);
    let profile = &tuning.profile;
    let line = |name: &str, costs: &Costs, shipped: &Costs, residual: f64| {
        format!(
            "{name}: a step {:.3} ns, a triangle test {:.3} ns, a test is {:.2} steps ({:.2} without a profile); times are \
             explained but for {:.1} %\n",
            costs.node,
            costs.triangle,
            costs.triangle / costs.node,
            shipped.triangle / shipped.node,
            100.0 * residual
        )
    };
    if !is_standard_output(&arguments.output) {
        super::print(&format!(
            "{}\n{}{}",
            profile.device,
            line("octants", &profile.octants, &Costs::OCTANTS, tuning.residuals[0]),
            line("octree", &profile.octree, &Costs::OCTREE, tuning.residuals[1]),
        ))?;
    }
    file.save(&profile.text())?;
    Ok(())
}
