//! What rays buy: the error of pictures of as many samples everywhere, and of those of samples where they matter.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::plan::{MeasureError, Plan, short_name};
use super::record::{Record, Value};
use super::sitter::Sitter;
use crate::compare::Shot;
use crate::progress::Progress;
use crate::sampling::{Pattern, Samples};
use crate::view::View;
use oktant_shared::frame::Frame;

/// The picture that is right has so many samples a pixel, of a pattern without rows: what is in rows itself, like a checkerboard
/// at the horizon, is as wrong in 256 samples of a grid as in 16.
const REFERENCE: u32 = 1024;

/// [`View::tolerance`] of the adaptive pictures.
const TOLERANCES: [f32; 7] = [0.04, 0.013, 0.01, 0.004, 0.001, 0.0004, 0.0001];

/// What adaptive sampling is to be within: so many of the rays of [`FIXED`] samples everywhere, and so many times their error.
const BAR: [f64; 2] = [0.35, 1.05];
/// The samples that it is measured by, and the most that adaptive pictures have here.
const FIXED: Samples = Samples::Sixteen;

/// A picture that is charted.
struct Sampling {
    series: String,
    label: String,
    view: View,
    is_marked: bool,
}

/// The pictures of a scene that is seen like this.
fn samplings(view: &View) -> Vec<Sampling> {
    let default = View::default();
    let view = View {
        pattern: Pattern::Rotated,
        block: 1,
        ..*view
    };
    let fixed = Samples::ALL.map(|samples| Sampling {
        series: "as many everywhere".into(),
        label: samples.count().to_string(),
        view: View {
            samples,
            adaptive: false,
            ..view
        },
        is_marked: samples == default.samples,
    });
    let adaptive = TOLERANCES.map(|tolerance| Sampling {
        series: format!("adaptive:{}", FIXED.count()),
        label: tolerance.to_string(),
        view: View {
            samples: FIXED,
            adaptive: true,
            tolerance,
            ..view
        },
        is_marked: tolerance == default.tolerance,
    });
    fixed.into_iter().chain(adaptive).collect()
}

/// The error of pictures in 1, 4, 16 and 64 samples everywhere and in up to 16 where they matter, against the rays of a pixel,
/// scene by scene: one figure of the mean of FLIP, with the bar that adaptive sampling is held against, and one of the root mean
/// square error of the light. What is right is a picture of 1,024 samples of R2 by the same device, so that nothing but the samples
/// makes the difference. `progress` hears of the stage "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn samples(plan: &Plan, progress: Progress<'_>) -> Result<[Figure; 2], MeasureError> {
    let [width, height] = plan.pictures.to_array();
    let fixed = FIXED.count();
    let explanation = format!(
        "Pictures of {width} x {height} pixels in 1, 4, 16 and 64 samples of the rotated grid, and in up to {fixed} where pixels get \
         what they need: the numbers are those of the samples, and the error that is allowed. Against one of {} samples of the R2 \
         sequence by the same back end. Rays are all that were traced, for closest hits and for shadows. Ringed: the defaults.",
        REFERENCE,
    );
    let barred = format!(
        "{explanation} The bar's corner is at {} of the error of {fixed} samples everywhere and {} of their rays.",
        BAR[1], BAR[0],
    );
    let mut flip = plan.figure("samples-flip", "What rays buy: what an eye sees", &barred);
    let mut rmse = plan.figure("samples-rmse", "What rays buy: the light's error", &explanation);
    for source in &plan.sources {
        let sitter = Sitter::load(source, plan.pictures, progress)?;
        for (figure, label) in [(&mut flip, "mean of FLIP"), (&mut rmse, "RMSE of the light")] {
            figure.panels.push(Panel {
                name: sitter.name.clone(),
                x: Axis::log("rays a pixel"),
                // Axes of the same name have the same limits, and a bar would be no wider than a line.
                y: Axis::log(format!("{label}, {}", sitter.name)),
                better: None,
                is_joined: true,
            });
        }
        for device in &plan.devices {
            let series = |name: &str| match plan.devices.len() {
                1 => name.into(),
                _ => format!("{name}, {}", short_name(device)),
            };
            progress("measuring", 0.0);
            let mut tracer = device.with(&sitter.scene)?;
            let wanted = Shot::of_picture(&tracer.render(&reference(&sitter))?);
            let samplings = samplings(&sitter.view);
            let mut points = Vec::new();
            for (done, sampling) in samplings.iter().enumerate() {
                progress("measuring", (done + 1) as f32 / (samplings.len() + 1) as f32);
                let taken = sitter.taken(&mut tracer, &sampling.view, &wanted)?;
                let rays = taken.effort.rays() / f64::from(plan.pictures.element_product());
                let record = |error: f64| Record {
                    panel: sitter.name.clone(),
                    series: series(&sampling.series),
                    label: sampling.label.clone(),
                    x: rays,
                    y: Value::Number(error),
                    is_marked: sampling.is_marked,
                };
                flip.records.push(record(taken.comparison.flip.mean));
                rmse.records.push(record(taken.comparison.rmse));
                points.push((&sampling.view, [rays, taken.comparison.flip.mean]));
            }
            flip.records.extend(bar(&points).into_iter().map(|[x, y]| Record {
                panel: sitter.name.clone(),
                series: series("the bar"),
                label: String::new(),
                x,
                y: Value::Number(y),
                is_marked: false,
            }));
        }
    }
    Ok([flip, rmse])
}

/// The frame of the picture that is right.
fn reference(sitter: &Sitter) -> Frame {
    let view = View {
        pattern: Pattern::R2,
        adaptive: false,
        ..sitter.view
    };
    Frame {
        samples: REFERENCE,
        sample_count: REFERENCE,
        ..sitter.frame(&view)
    }
}

/// The corner that adaptive pictures are to be within, from the fewest rays of all and down to the least error of all.
fn bar(points: &[(&View, [f64; 2])]) -> Vec<[f64; 2]> {
    let least = |axis: usize| {
        points
            .iter()
            .map(|(_, point)| point[axis])
            .fold(f64::INFINITY, f64::min)
    };
    let is_fixed = |view: &View| !view.adaptive && view.samples == FIXED;
    let fixed = points.iter().filter(|(view, _)| is_fixed(view));
    let corners = fixed.map(|(_, point)| [0, 1].map(|axis| BAR[axis] * point[axis]));
    corners
        .flat_map(|[rays, error]| [[least(0), error], [rays, error], [rays, least(1)]])
        .collect()
}
