//! What samples cost, and how near they come to the picture of very many.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::pareto::Better;
use super::plan::{MeasureError, Plan, short_name};
use super::record::{Record, Value};
use super::sitter::Sitter;
use crate::oracle::whitted::Takes;
use crate::progress::Progress;
use crate::sampling::{Pattern, Samples};
use crate::view::View;

/// The reference has so many samples along each side of a pixel.
const REFERENCE_SIDE: u32 = 32;

const PATTERNS: [(Pattern, &str); 3] = [
    (Pattern::Regular, "regular grid"),
    (Pattern::Rotated, "rotated grid"),
    (Pattern::R2, "R2 sequence"),
];

/// Edges of the blocks of which only the corners are traced where these agree, pixels.
const BLOCKS: [u32; 3] = [2, 4, 8];

/// A way to sample pictures.
struct Way {
    name: String,
    /// The pictures, each with what it is called on the chart.
    views: Vec<(String, View)>,
}

/// The ways to sample a scene that is seen like this.
fn ways(view: &View) -> Vec<Way> {
    let mut ways = Vec::new();
    for (pattern, name) in PATTERNS {
        for adaptive in [false, true] {
            // One sample leaves nothing to be adapted.
            let counts = Samples::ALL.into_iter().skip(usize::from(adaptive));
            let of = |samples: Samples| {
                let view = View {
                    pattern,
                    samples,
                    adaptive,
                    block: 1,
                    ..*view
                };
                (samples.count().to_string(), view)
            };
            ways.push(Way {
                name: format!("{name}{}", if adaptive { ", adaptive" } else { "" }),
                views: counts.map(of).collect(),
            });
        }
    }
    let of = |block: u32| {
        let view = View {
            samples: Samples::One,
            adaptive: true,
            block,
            ..*view
        };
        (format!("{block} x {block}"), view)
    };
    ways.push(Way {
        name: "corners of blocks".into(),
        views: BLOCKS.map(of).into(),
    });
    ways
}

/// The error of pictures in 1, 4, 16 and 64 samples of each pattern, the same for all pixels and as many as each needs, and in
/// less than one, against milliseconds, scene by scene: one figure of the root mean square error of the light, one of the mean
/// of FLIP. What is right is a picture of 1,024 samples in f64, with the scene's own filter, depth and cut-off. `progress` hears
/// of the stages "rendering" and "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn image_error(plan: &Plan, progress: Progress<'_>) -> Result<[Figure; 2], MeasureError> {
    let [width, height] = plan.pictures.to_array();
    let explanation = format!(
        "Pictures of {width} x {height} pixels in 1, 4, 16 and 64 samples of a pixel, or up to as many where pixels get what they \
         need (adaptive), or in the corners of blocks that are interpolated where these agree, against one of {} in double \
         precision. Lower left is better; the numbers are those of the samples, or the blocks' edges in pixels.",
        REFERENCE_SIDE * REFERENCE_SIDE,
    );
    let mut rmse = plan.figure(
        "image-error-rmse",
        "What samples cost and bring: the light's error",
        &explanation,
    );
    let mut flip = plan.figure(
        "image-error-flip",
        "What samples cost and bring: what an eye sees",
        &explanation,
    );
    for source in &plan.sources {
        let sitter = Sitter::load(source, plan.pictures, progress)?;
        for (figure, label) in [(&mut rmse, "RMSE of the light"), (&mut flip, "mean of FLIP")] {
            figure.panels.push(Panel {
                name: sitter.name.clone(),
                x: Axis::log("milliseconds"),
                y: Axis::log(label),
                better: Some([Better::Lower; 2]),
                is_joined: true,
            });
        }
        let wanted = sitter.wanted(&sitter.view, Takes::Grid(REFERENCE_SIDE), progress)?;
        for device in &plan.devices {
            let mut tracer = device.with(&sitter.scene)?;
            let ways = ways(&sitter.view);
            for (done, way) in ways.iter().enumerate() {
                progress("measuring", done as f32 / ways.len() as f32);
                for (label, view) in &way.views {
                    let comparison = sitter.taken(&mut tracer, view, &wanted)?.comparison;
                    let milliseconds = sitter.milliseconds(&mut tracer, view, plan.repeats)?;
                    let default = View::default();
                    let record = |error: f64| Record {
                        panel: sitter.name.clone(),
                        series: match plan.devices.len() {
                            1 => way.name.clone(),
                            _ => format!("{}, {}", way.name, short_name(device)),
                        },
                        label: label.clone(),
                        x: milliseconds,
                        y: Value::Number(error),
                        is_marked: !view.adaptive && (view.pattern, view.samples) == (default.pattern, default.samples),
                    };
                    rmse.records.push(record(comparison.rmse));
                    flip.records.push(record(comparison.flip.mean));
                }
            }
        }
    }
    Ok([rmse, flip])
}
