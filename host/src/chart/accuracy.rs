//! Speed against error: all parts on pictures' rays and on rays that are aimed where triangle tests fail.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::leaks::{LEAKS, leak_rays};
use super::pareto::Better;
use super::plan::{MeasureError, Plan, mesh_name, quickest, short_name};
use super::record::{Record, Value};
use crate::backend::Query;
use crate::bench::{Device, Truth};
use crate::mesh::Mesh;
use crate::oracle::Oracle;
use crate::progress::{Progress, silent};
use crate::ray_sets::{RaySet, SetKind, outer};
use crate::scene::Scene;
use crate::stability::{
    Contracted, Epsilon, Exact, HavelHerout, Kernel, Method, MollerTrumbore, Plain, Slack, Subject, Wanted, Woop,
};
use crate::structure::StructureOptions;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::ray::Ray;
use std::sync::Arc;

/// Triangle tests beside those that are offered, in the default traversal.
const EXHIBITS: [Method; 6] = [
    Method::triangle::<HavelHerout>("havel-herout"),
    Method::triangle::<MollerTrumbore<Plain, Slack>>("moller-trumbore, slack 1e-6"),
    Method::triangle::<MollerTrumbore<Plain, Epsilon<6>>>("moller-trumbore, epsilon 1e-6"),
    Method::triangle::<MollerTrumbore<Contracted, Exact>>("moller-trumbore, contracted"),
    Method::triangle::<Woop<Contracted, true>>("woop, contracted"),
    Method::twin::<Woop<Kernel, false>>("watertight, contracted"),
];

/// A panel of wrong answers against speed.
pub(super) fn panel(name: &str) -> Panel {
    let y = if name == LEAKS {
        "rays that leak / rays"
    } else {
        "answers that differ / rays"
    };
    Panel {
        name: name.into(),
        x: Axis::log("speed, million rays a second (faster is to the right)"),
        y: Axis::log(y),
        better: Some([Better::Higher, Better::Lower]),
        is_joined: false,
    }
}

/// What charts call the rays of pictures of a mesh.
pub(super) fn picture_panel(mesh: &str) -> String {
    format!("pictures: R1 to R4 of {}", mesh_name(mesh))
}

/// Measures what is offered on each mesh of a plan, with [`outer`]'s three views, and on [`leak_rays`], where exhibits run
/// too. `progress` hears of the stage "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn accuracy(plan: &Plan, progress: Progress<'_>) -> Result<Figure, MeasureError> {
    let mut figure = plan.figure(
        "accuracy",
        "Who is fast, and who is wrong how often?",
        "Every triangle test, traversal and back end that is offered. Leaks: rays from within a closed ball that hit nothing. \
         Pictures: answers that differ from the f64 oracle's, a hit instead of none, none instead of a hit, or t off by more than \
         10⁻⁵ of itself. The black stairs are the Pareto front; the ring is the default.",
    );
    let steps = plan.meshes.len() + 1;
    figure.panels.push(panel(LEAKS));
    figure.records.extend(leaks(plan)?);
    for (done, source) in plan.meshes.iter().enumerate() {
        progress("measuring", (done + 1) as f32 / steps as f32);
        let name = picture_panel(&source.to_string());
        figure.records.extend(pictures(plan, &name, source.load(&silent)?)?);
        figure.panels.push(panel(&name));
    }
    Ok(figure)
}

/// What is offered, traversal by traversal, but for brute force.
fn offered(traversal: TraversalKind) -> impl Iterator<Item = Parts> {
    Parts::OFFERED
        .iter()
        .copied()
        .filter(move |parts| parts.traversal == traversal)
}

const TRAVERSALS: [TraversalKind; 5] = [
    TraversalKind::Octants,
    TraversalKind::Compact,
    TraversalKind::Octree,
    TraversalKind::Bvh2,
    TraversalKind::Grid,
];

fn record(panel: &str, device: &Device, parts: Parts, mrays: f64, y: Value) -> Record {
    // The box test is named where something else is offered with both.
    let twins = offered(parts.traversal)
        .filter(|other| other.triangle == parts.triangle)
        .count();
    Record {
        panel: panel.into(),
        series: format!("{}, {}", parts.traversal, short_name(device)),
        label: if twins > 1 {
            format!("{}, {}", parts.triangle, parts.box_test)
        } else {
            parts.triangle.to_string()
        },
        x: mrays,
        y,
        is_marked: parts == Parts::default(),
    }
}

fn leaks(plan: &Plan) -> Result<Vec<Record>, MeasureError> {
    let (mesh, rays) = leak_rays(plan.rays);
    let subject = Subject::new(mesh, rays, Wanted::Hit, &TRAVERSALS)?;
    let rays = &subject.rays;
    let leaking = |hits: &[Hit]| Value::Rate {
        count: hits.iter().filter(|hit| !hit.is_hit()).count() as u64,
        of: hits.len() as u64,
    };
    let mrays = |milliseconds: f64| rays.len() as f64 / milliseconds / 1e3;
    let mut records = Vec::new();
    for device in &plan.devices {
        for scene in TRAVERSALS.iter().filter_map(|traversal| subject.scene(*traversal)) {
            let mut tracer = device.with(scene)?;
            for parts in offered(scene.parts.traversal) {
                let hits = tracer.cast(parts, Query::Closest, rays)?;
                let times = tracer.time_cast(parts, Query::Closest, rays, plan.repeats)?;
                records.push(record(LEAKS, device, parts, mrays(quickest(&times)), leaking(&hits)));
            }
        }
    }
    if !plan.devices.iter().any(|device| matches!(device, Device::Cpu)) {
        return Ok(records);
    }
    for method in EXHIBITS {
        let mut least = f64::INFINITY;
        let mut found = None;
        for _ in 0..plan.repeats {
            if let Some((hits, time)) = method.closest_hits(&subject) {
                least = least.min(time.as_secs_f64() * 1e3);
                found = Some(leaking(&hits));
            }
        }
        records.extend(found.map(|y| Record {
            panel: LEAKS.into(),
            series: "octants with an exhibit, CPU".into(),
            label: method.name().into(),
            x: mrays(least),
            y,
            is_marked: false,
        }));
    }
    Ok(records)
}

/// Rays of a kind from all views, with the right answers.
struct Judged {
    kind: SetKind,
    rays: Vec<Ray>,
    truth: Truth,
}

fn pictures(plan: &Plan, panel: &str, mesh: Mesh) -> Result<Vec<Record>, MeasureError> {
    let oracle = Oracle::new(&mesh);
    let views: Vec<[RaySet; 4]> = outer(&mesh, &oracle, plan.size).into();
    let sets = SetKind::ALL.map(|kind| {
        let own = views.iter().flatten().filter(|set| set.kind == kind);
        let rays: Vec<Ray> = own.flat_map(|set| set.rays.iter().copied()).collect();
        Judged {
            kind,
            truth: Truth::new(&oracle, kind.query(), &rays),
            rays,
        }
    });
    let sets: Vec<Judged> = sets.into_iter().filter(|set| !set.rays.is_empty()).collect();
    let rays: usize = sets.iter().map(|set| set.rays.len()).sum();
    let mut records = Vec::new();
    for traversal in TRAVERSALS {
        let options = StructureOptions {
            parts: Parts {
                traversal,
                ..Parts::default()
            },
            ..StructureOptions::default()
        };
        let scene = Arc::new(Scene::new(&mesh, &options, &silent)?);
        for device in &plan.devices {
            let mut tracer = device.with(&scene)?;
            for parts in offered(traversal) {
                let (mut wrong, mut milliseconds) = (0, 0.0);
                for set in &sets {
                    let hits = tracer.cast(parts, set.kind.query(), &set.rays)?;
                    let judgement = set.truth.judge(&oracle, &set.rays, &hits);
                    wrong += judgement.disagreeing();
                    let times = tracer.time_cast(parts, set.kind.query(), &set.rays, plan.repeats)?;
                    milliseconds += quickest(&times);
                }
                let y = Value::Rate {
                    count: wrong as u64,
                    of: rays as u64,
                };
                records.push(record(panel, device, parts, rays as f64 / milliseconds / 1e3, y));
            }
        }
    }
    // By device, not by traversal, so that legends have the default first.
    records.sort_by_key(|record| {
        let of = |device: &Device| record.series.ends_with(&short_name(device));
        plan.devices.iter().position(of)
    });
    Ok(records)
}
