//! What is missing where rays are cut.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::plan::{MeasureError, Plan};
use super::record::{Record, Value};
use super::sitter::Sitter;
use crate::bench::Device;
use crate::oracle::whitted::Takes;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::view::View;
use oktant_shared::display::{STEPS, encoded};
use oktant_shared::frame::Frame;
use oktant_shared::present::mean_color;
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
/// Those of the output, of which there are bounds: by how much it is off where it is most, and in the mean.
const GREATEST: &str = "greatest steps of 8 bits";
const MEAN: &str = "mean steps of 8 bits";

/// The error of pictures, and their time on the first device, against the recursion's depth (with the least cut-off) and
/// against the cut-off (at the greatest depth). What is right is the picture in f64, of the same samples, at the greatest
/// depth with the least cut-off. Then by how much the output is off for what was cut, which is counted from the device's own
/// picture at that depth and cut-off, and the bounds on it that `oktant render` prints. `progress` hears of the stages
/// "rendering" and "measuring".
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
             a depth of {MAX_DEPTH} with all rays of a weight of 2^-16 and more. First row: by depth, at a cut-off of 2^-10 steps. \
             Second row: by cut-off, at that depth. Ringed: the defaults. Where a line is level, what is left is the error of single precision. Third \
             row: by how much the output is off from the same at that depth and cut-off, both in single precision, and the bounds on \
             that, which `oktant render` prints: in the pixel where it is most, and in the mean. What is 0 is not drawn, as where \
             nothing is cut."
        ),
    );
    let by = [(Axis::linear(DEPTH), "depth"), (Axis::log(CUTOFF), "cut-off")];
    let described = |quantity: &str, (x, what): &(Axis, &str)| Panel {
        name: panel(quantity, what),
        x: x.clone(),
        y: Axis::log(quantity),
        better: None,
        is_joined: true,
    };
    for by in &by {
        figure.panels.extend(QUANTITIES.map(|quantity| described(quantity, by)));
    }
    figure.panels.extend(by.iter().map(|by| described(GREATEST, by)));
    figure.panels.push(described(MEAN, &by[1]));
    let device = plan.devices.first().unwrap_or(&Device::Cpu);
    let default = View::default();
    // After all others, whose looks are the scenes' everywhere.
    let mut bounds = Vec::new();
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
        let uncut = tracer.render(&sitter.frame(&whole))?;
        for (done, (view, what, x, is_marked)) in views.iter().enumerate() {
            progress("measuring", done as f32 / views.len() as f32);
            let taken = sitter.taken(&mut tracer, view, &wanted)?;
            let milliseconds = sitter.milliseconds(&mut tracer, view, plan.repeats)?;
            let record = |quantity: &str, series: &str, value: f64| Record {
                panel: panel(quantity, what),
                series: series.into(),
                label: String::new(),
                x: *x,
                y: Value::Number(value),
                is_marked: *is_marked,
            };
            let values = [taken.comparison.rmse, taken.comparison.flip.mean, milliseconds];
            let pairs = QUANTITIES.into_iter().zip(values);
            let errors = pairs.map(|(quantity, value)| record(quantity, &sitter.name, value));
            figure.records.extend(errors);
            let off = steps_apart(&sitter.frame(view), &uncut, &taken.picture);
            let bound = [taken.effort.greatest_steps, taken.effort.mean_steps];
            let bounded = [GREATEST, MEAN].into_iter().zip(off.into_iter().zip(bound));
            for (quantity, (off, bound)) in bounded {
                if figure.panels.iter().any(|own| own.name == panel(quantity, what)) {
                    figure.records.push(record(quantity, &sitter.name, off));
                    bounds.push(record(quantity, &format!("{}, bound", sitter.name), bound));
                }
            }
        }
    }
    figure.records.append(&mut bounds);
    Ok(figure)
}

fn panel(quantity: &str, what: &str) -> String {
    format!("{quantity} by {what}")
}

/// By how many steps of 8 bits, and parts of them, two pictures are shown differently, each pixel in the channel where it is
/// most: the greatest, and the mean.
fn steps_apart(frame: &Frame, one: &Picture, other: &Picture) -> [f64; 2] {
    let pairs = one.sums.iter().zip(&other.sums);
    let apart = pairs.map(|(one, other)| {
        let [one, other] = [one, other].map(|sum| encoded(frame, mean_color(*sum)));
        f64::from((one - other).abs().max_element() * STEPS)
    });
    let (greatest, sum) = apart.fold((0.0_f64, 0.0), |(greatest, sum), steps| {
        (greatest.max(steps), sum + steps)
    });
    [greatest, sum / one.sums.len() as f64]
}
