//! What is missing where rays are cut.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::plan::{MeasureError, Plan};
use super::record::{Record, Value};
use super::sitter::Sitter;
use crate::bench::Device;
use crate::oracle::whitted::Takes;
use crate::progress::Progress;
use crate::view::View;
use oktant_shared::whitted::MAX_DEPTH;

/// The cut-offs that are charted are the default times these powers of two.
const POWERS: std::ops::RangeInclusive<i32> = -10..=5;
/// That of the picture that is right: without any, a sample in glass would spend its 4,096 rays on what nobody sees, before
/// it comes to what matters.
const NO_CUTOFF: f32 = 1.0 / (1 << 10) as f32;

const DEPTH: &str = "reflections and refractions, one after the other";
const CUTOFF: &str = "cut-off, steps of 8 bits";

/// The quantities of a panel's y axis.
const QUANTITIES: [&str; 3] = ["RMSE of the light", "mean of FLIP", "milliseconds"];

/// The error of pictures, and their time on the first device, against the recursion's depth (with the least cut-off) and
/// against the cut-off (at the greatest depth). What is right is the picture in f64, of the same samples, at the greatest
/// depth with the least cut-off. `progress` hears of the stages "rendering" and "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn depth_error(plan: &Plan, progress: Progress<'_>) -> Result<Figure, MeasureError> {
    let [width, height] = plan.pictures.to_array();
    let mut figure = plan.figure(
        "depth-error",
        "What is missing where rays are cut",
        &format!(
            "Pictures of {width} x {height} pixels in the samples that each scene asks for, against the same in double precision at \
             a depth of {MAX_DEPTH} with all rays of a weight of 2^-16 and more. Above: by depth, at that cut-off. Below: by cut-off, at that depth. \
             Ringed: the defaults. Where a line is level, what is left is the error of single precision."
        ),
    );
    for (x, what) in [(Axis::linear(DEPTH), "depth"), (Axis::log(CUTOFF), "cut-off")] {
        figure.panels.extend(QUANTITIES.map(|quantity| Panel {
            name: panel(quantity, what),
            x: x.clone(),
            y: Axis::log(quantity),
            better: None,
            is_joined: true,
        }));
    }
    let device = plan.devices.first().unwrap_or(&Device::Cpu);
    let default = View::default();
    for source in &plan.sources {
        let sitter = Sitter::load(source, plan.pictures, progress)?;
        let whole = View {
            depth: MAX_DEPTH,
            cutoff: NO_CUTOFF,
            ..sitter.view
        };
        let wanted = sitter.wanted(&whole, Takes::View, progress)?;
        let depths = (0..=MAX_DEPTH).map(|depth| {
            (
                View { depth, ..whole },
                "depth",
                f64::from(depth),
                depth == default.depth,
            )
        });
        let cutoffs = POWERS.map(|power| {
            let cutoff = default.cutoff * 2.0_f32.powi(power);
            (
                View { cutoff, ..whole },
                "cut-off",
                f64::from(cutoff),
                cutoff == default.cutoff,
            )
        });
        let views: Vec<_> = depths.chain(cutoffs).collect();
        let mut tracer = device.with(&sitter.scene)?;
        for (done, (view, what, x, is_marked)) in views.iter().enumerate() {
            progress("measuring", done as f32 / views.len() as f32);
            let (comparison, milliseconds) = sitter.taken(&mut tracer, view, &wanted, plan.repeats)?;
            let values = [comparison.rmse, comparison.flip.mean, milliseconds];
            figure
                .records
                .extend(QUANTITIES.into_iter().zip(values).map(|(quantity, value)| Record {
                    panel: panel(quantity, what),
                    series: sitter.name.clone(),
                    label: String::new(),
                    x: *x,
                    y: Value::Number(value),
                    is_marked: *is_marked,
                }));
        }
    }
    Ok(figure)
}

fn panel(quantity: &str, what: &str) -> String {
    format!("{quantity} by {what}")
}
