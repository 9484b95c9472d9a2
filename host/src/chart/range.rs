//! How far a method reaches: wrong answers against the scale of the scene, how far away rays begin, and how far the scene is
//! from the origin of coordinates.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::plan::{MeasureError, Plan};
use super::record::{Record, Value};
use crate::backend::cpu::Cpu;
use crate::backend::{Backend, Query};
use crate::generated::bumpy_ball;
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::stability::{
    Aim, Contracted, Epsilon, Exact, Form, GridForm, HavelHerout, Kernel, Method, MollerTrumbore, Plain, Slack,
    Subject, Wanted, Woop, at,
};
use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::ray::Ray;

/// Triangles of the ball.
const TRIANGLES: u32 = 1_800;
/// Where rays begin unless that is what changes, radii of the ball's box from its middle.
const AWAY: f32 = 3.0;

/// Triangle tests beside those that are offered.
const TESTS: [Method; 6] = [
    Method::twin::<Woop<Kernel, false>>("watertight, contracted"),
    Method::triangle::<MollerTrumbore<Contracted, Exact>>("moller-trumbore, contracted"),
    Method::triangle::<MollerTrumbore<Plain, Epsilon<6>>>("moller-trumbore, epsilon 1e-6"),
    Method::triangle::<MollerTrumbore<Plain, Slack>>("moller-trumbore, slack 1e-6"),
    Method::triangle::<HavelHerout>("havel-herout"),
    Method::triangle::<Woop<Contracted, true>>("woop, contracted"),
];

/// Traversals beside those that are offered.
const WALKS: [Method; 4] = [
    Method::revelles("revelles, as published", Form::PUBLISHED),
    Method::revelles(
        "revelles, averaged middles",
        Form {
            averaged: true,
            ..Form::MENDED
        },
    ),
    Method::grid(
        "grid, summed steps",
        GridForm {
            summed: true,
            first_cell: false,
        },
    ),
    Method::Quantised("boxes rounded inwards"),
];

/// What changes from point to point.
struct Sweep {
    panel: &'static str,
    axis: &'static str,
    values: &'static [f64],
    /// Scale, distance of the rays' origins and of the mesh from the origin of coordinates, both in radii.
    setting: fn(f32) -> [f32; 3],
}

const SWEEPS: [Sweep; 3] = [
    Sweep {
        panel: "the scene's scale",
        axis: "radius of the ball, scene units",
        values: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6],
        setting: |scale| [scale, AWAY, 0.0],
    },
    Sweep {
        panel: "how far away rays begin",
        axis: "distance of origins, radii of the ball",
        values: &[2.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6],
        setting: |away| [1.0, away, 0.0],
    },
    Sweep {
        panel: "offset of the coordinates",
        axis: "offset of the ball, radii of the ball",
        values: &[1.0, 10.0, 100.0, 1e3, 1e4, 1e5],
        setting: |offset| [1.0, AWAY, offset],
    },
];

/// Triangle tests and traversals, a figure each, on the CPU. `progress` hears of the stage "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn range(plan: &Plan, progress: Progress<'_>) -> Result<[Figure; 2], MeasureError> {
    let mut tests = plan.figure(
        "range-tests",
        "How far do triangle tests reach?",
        "Rays from outside at edges and corners of a closed ball of 1,800 triangles, nowhere near its outline. Wrong is what has no \
         hit within half a radius of the point that is aimed at. Through the default traversal, on the CPU.",
    );
    let mut walks = plan.figure(
        "range-traversals",
        "How far do traversals reach?",
        "Rays through the inner quarter of a closed ball of 1,800 triangles, half of them parallel to an axis, so that each must \
         hit. Missed, or hit where nothing is, and no rounding of f32 is to blame. With the watertight triangle test, on the CPU.",
    );
    let steps: usize = SWEEPS.iter().map(|sweep| sweep.values.len()).sum();
    let mut done = 0;
    for sweep in SWEEPS {
        for figure in [&mut tests, &mut walks] {
            figure.panels.push(Panel {
                name: sweep.panel.into(),
                x: Axis::log(sweep.axis),
                y: Axis::log("wrong answers / rays"),
                better: None,
                is_joined: true,
            });
        }
        for &value in sweep.values {
            progress("measuring", done as f32 / steps as f32);
            done += 1;
            let [scale, away, offset] = (sweep.setting)(value as f32);
            let mesh = placed(scale, offset);
            let rays = at_edges(&mesh, away, plan.rays / 10);
            let subject = Subject::new(mesh.clone(), rays, Wanted::Hit, &[TraversalKind::Octants])?;
            let mut records = offered(
                &subject,
                TraversalKind::Octants,
                |parts| parts.triangle.to_string(),
                off_target,
            )?;
            records.extend(exhibits(&subject, &TESTS, off_target));
            tests.records.extend(at_value(&sweep, value, records));

            let rays = through(&mesh, away, plan.rays / 10);
            let kinds = [
                TraversalKind::Octants,
                TraversalKind::Octree,
                TraversalKind::Bvh2,
                TraversalKind::Grid,
            ];
            let subject = Subject::new(mesh, rays, Wanted::Hit, &kinds)?;
            let mut records = Vec::new();
            for kind in kinds {
                let mut all = offered(&subject, kind, |parts| parts.traversal.to_string(), wrong)?;
                // The watertight triangle test with the usual box test comes first.
                all.truncate(1);
                records.extend(all);
            }
            records.extend(exhibits(&subject, &WALKS, wrong));
            walks.records.extend(at_value(&sweep, value, records));
        }
    }
    Ok([tests, walks])
}

/// Wrong answers of somebody.
type Wrong = (String, Value);

fn at_value(sweep: &Sweep, value: f64, all: Vec<Wrong>) -> impl Iterator<Item = Record> {
    all.into_iter().map(move |(series, y)| Record {
        panel: sweep.panel.into(),
        series,
        label: String::new(),
        x: value,
        y,
        is_marked: false,
    })
}

/// What the oracle finds wrong, but where rounding is to blame.
fn wrong(subject: &Subject, hits: &[Hit]) -> Value {
    let (counts, _) = subject.judge(hits);
    Value::Rate {
        count: counts.wrong() as u64,
        of: counts.rays as u64,
    }
}

/// How many of the rays that are aimed by their direction, at `t = 1`, have no hit there.
fn off_target(subject: &Subject, hits: &[Hit]) -> Value {
    let (low, high) = subject.mesh.bounds().unwrap_or_default();
    // Half of the ball's radius; the other side is three times as far away or more.
    let near = 0.25 * (high - low).max_element();
    let is_there = |(ray, hit): &(&Ray, &Hit)| hit.is_hit() && ((hit.t - 1.0) * ray.direction.length()).abs() <= near;
    let there = subject.rays.iter().zip(hits).filter(is_there).count();
    Value::Rate {
        count: (hits.len() - there) as u64,
        of: hits.len() as u64,
    }
}

/// Counts wrong answers.
type Count = fn(&Subject, &[Hit]) -> Value;

fn offered(
    subject: &Subject,
    traversal: TraversalKind,
    name: fn(Parts) -> String,
    count: Count,
) -> Result<Vec<Wrong>, MeasureError> {
    let Some(scene) = subject.scene(traversal) else {
        return Ok(Vec::new());
    };
    let mut cpu = Cpu::new(scene.clone());
    let own = Parts::OFFERED
        .iter()
        .copied()
        .filter(|parts| parts.traversal == traversal);
    own.map(|parts| {
        let hits = cpu.cast(parts, Query::Closest, &subject.rays)?;
        Ok((name(parts), count(subject, &hits)))
    })
    .collect()
}

fn exhibits(subject: &Subject, methods: &[Method], count: Count) -> Vec<Wrong> {
    let found = methods
        .iter()
        .filter_map(|method| Some((method, method.closest_hits(subject)?.0)));
    found
        .map(|(method, hits)| (method.name().to_owned(), count(subject, &hits)))
        .collect()
}

/// The ball, so large, and so many radii from the origin of coordinates.
fn placed(scale: f32, offset: f32) -> Mesh {
    let ball = bumpy_ball(TRIANGLES);
    let shift = Vec3::new(0.48, 0.6, -0.64) * offset;
    Mesh {
        positions: ball
            .positions
            .iter()
            .map(|position| (*position + shift) * scale)
            .collect(),
        ..ball
    }
}

/// From outside at points on edges and at corners of the side that is seen.
fn at_edges(mesh: &Mesh, away: f32, count: usize) -> Vec<Ray> {
    let mut aim = Aim::new(mesh, 41);
    let middle = aim.within(0.0);
    let ray = |index: usize| {
        let target = if index.is_multiple_of(2) {
            aim.on_edge()
        } else {
            aim.vertex()
        };
        // Within 27 degrees of what is straight above.
        let above = (target - middle).normalize() + 0.45 * aim.unit();
        let from = aim.outward(above, away);
        at(from, target)
    };
    (0..count).map(ray).collect()
}

/// From outside through the inner quarter, every other one parallel to an axis.
fn through(mesh: &Mesh, away: f32, count: usize) -> Vec<Ray> {
    let mut aim = Aim::new(mesh, 42);
    let ray = |index: usize| {
        let target = aim.within(0.2);
        if index.is_multiple_of(2) {
            return at(aim.away(away), target);
        }
        let axis = aim.one_of(3);
        let mut side = Vec3::ZERO;
        side[axis] = if aim.one_of(2) == 0 { 1.0 } else { -1.0 };
        let mut origin = aim.outward(side, away);
        for other in (0..3).filter(|other| *other != axis) {
            origin[other] = target[other];
        }
        Ray::new(origin, -side)
    };
    (0..count).map(ray).collect()
}
