//! How the work of a ray grows with the mesh.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::plan::{MeasureError, Plan, quickest, short_name};
use super::record::{Record, Value};
use crate::bench::{Workload, count};
use crate::progress::{Progress, silent};
use crate::ray_sets::SetKind;
use crate::scene::Scene;
use crate::structure::StructureOptions;
use oktant_shared::parts::Parts;
use std::sync::Arc;

/// Triangles of the smallest mesh.
const SMALLEST: u32 = 1_000;

const WORK: &str = "work";
const GROWTH: &str = "growth of the work";
const LOGARITHM: &str = "the logarithm of the triangles";

/// Knots of 1,000 triangles and more, four times as many from one to the next, the last one as large as the plan says,
/// seen by the default parts. `progress` hears of the stage "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn growth(plan: &Plan, progress: Progress<'_>) -> Result<Figure, MeasureError> {
    let mut figure = plan.figure(
        "growth",
        "A thousand times the triangles: how much more work is a ray?",
        "Knots that have their shape at every size, by the default parts. Work: nodes and triangle tests that a ray reads in the mean; they are counted and \
         so the same on every machine. Growth: the same by that of the smallest knot, beside the logarithm of the number of \
         triangles.",
    );
    let triangles = "triangles";
    let mut panels = vec![
        (WORK.to_owned(), Axis::linear("nodes and triangle tests a ray")),
        (GROWTH.to_owned(), Axis::linear("times that of the smallest knot")),
    ];
    panels.extend(
        plan.devices
            .iter()
            .map(|device| (time_panel(&short_name(device)), Axis::log("nanoseconds a ray"))),
    );
    figure.panels = panels
        .into_iter()
        .map(|(name, y)| Panel {
            name,
            x: Axis::log(triangles),
            y,
            better: None,
            is_joined: true,
        })
        .collect();
    let sizes = sizes(plan.largest);
    // Triangles and work of the smallest knot.
    let mut smallest: Option<(f64, Vec<f64>)> = None;
    for (done, &size) in sizes.iter().enumerate() {
        progress("measuring", done as f32 / sizes.len() as f32);
        let subject = Workload::Knot(size).subject(&SetKind::ALL, plan.size, &silent)?;
        let triangles = subject.mesh.triangles.len() as f64;
        let scene = Arc::new(Scene::new(&subject.mesh, &StructureOptions::default(), &silent)?);
        let mut add = |panel: &str, series: &str, y: f64| {
            figure.records.push(Record {
                panel: panel.into(),
                series: series.into(),
                label: String::new(),
                x: triangles,
                y: Value::Number(y),
                is_marked: false,
            });
        };
        let mut works = Vec::new();
        for set in &subject.sets {
            let counts = count(&scene, Parts::default(), set.kind.query(), &set.rays);
            let work = (counts.nodes + counts.triangle_tests) as f64 / set.rays.len() as f64;
            add(WORK, series(set.kind), work);
            works.push(work);
        }
        let (fewest, least) = smallest.get_or_insert_with(|| (triangles, works.clone()));
        for ((set, work), least) in subject.sets.iter().zip(&works).zip(least) {
            add(GROWTH, series(set.kind), work / *least);
        }
        add(GROWTH, LOGARITHM, triangles.ln() / fewest.ln());
        for device in &plan.devices {
            let tracer = device.with(&scene)?;
            for set in &subject.sets {
                let times = tracer.time_cast(Parts::default(), set.kind.query(), &set.rays, plan.repeats)?;
                let nanoseconds = quickest(&times) * 1e6 / set.rays.len() as f64;
                add(&time_panel(&short_name(device)), series(set.kind), nanoseconds);
            }
        }
    }
    Ok(figure)
}

fn time_panel(device: &str) -> String {
    format!("time, {device}")
}

fn series(kind: SetKind) -> &'static str {
    match kind {
        SetKind::Primary => "R1, primary rays",
        SetKind::Shadow => "R2, to a light",
        SetKind::Mirror => "R3, mirrored",
        SetKind::Ambient => "R4, ambient occlusion",
    }
}

/// Four times as many from one to the next, and the largest.
fn sizes(largest: u32) -> Vec<u32> {
    let mut sizes = vec![SMALLEST];
    while let Some(&last) = sizes.last() {
        let next = last.saturating_mul(4).min(largest);
        // The largest is no neighbour of the one before.
        if next <= last || f64::from(next) < 1.5 * f64::from(last) {
            break;
        }
        sizes.push(next);
    }
    sizes
}
