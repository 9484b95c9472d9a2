//! Rays that are none: what they cost.

use super::cases::{About, Row};
use super::clock::quickest;
use super::exhibits::structures::unrefused_boxes;
use super::meshes::sphere;
use super::report::{MethodReport, Role, RowReport};
use super::subject::KEPT;
use super::tally::{Counts, Failure};
use super::{LabError, Plan, name, offered};
use crate::backend::Query;
use crate::bench::{Device, count};
use crate::mesh::Mesh;
use crate::progress::silent;
use crate::scene::Scene;
use crate::stability::aim::{Aim, at};
use crate::structure::StructureOptions;
use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::ray::Ray;
use std::collections::HashMap;
use std::sync::Arc;

/// The only one.
pub const INVALID_ROWS: &[Row] = &[Row {
    id: "none",
    mesh: Some(mesh),
    run,
}];

const ABOUT: About = About {
    id: "none",
    family: "rays that are none",
    title: "rays with NaN or infinity in origin or direction",
    input: "closed sphere of radius 1; numbers of rays at points within it made NaN or infinite. Excess: rays that read more \
            than twice what a ray does that is one; time: in parts of that of as many such rays",
    remedy: "rays that are not finite are refused when they are prepared",
    fails: &["bvh2, NaN not refused"],
};

/// Tests of boxes and triangles by hand are slow.
const MOST_OF_EXHIBIT: usize = 2_000;

/// The sphere.
pub fn mesh() -> Mesh {
    sphere(1.0, Vec3::ZERO)
}

fn run(plan: &Plan) -> Result<RowReport, LabError> {
    let mesh = mesh();
    let mut aim = Aim::new(&mesh, 51);
    let fair: Vec<Ray> = (0..plan.rays).map(|_| at(aim.away(3.0), aim.within(0.5))).collect();
    let bad: Vec<Ray> = fair.iter().enumerate().map(|(at, ray)| spoiled(*ray, at)).collect();
    let mut scenes = HashMap::new();
    for traversal in TraversalKind::ALL.iter().copied() {
        let parts = Parts {
            traversal,
            ..Parts::default()
        };
        let options = StructureOptions {
            parts,
            ..StructureOptions::default()
        };
        scenes.insert(traversal, Arc::new(Scene::new(&mesh, &options, &silent)?));
    }
    let mut methods = Vec::new();
    for device in &plan.devices {
        for parts in offered() {
            let scene = &scenes[&parts.traversal];
            if mesh.triangles.len() > device.most_brute() && parts.traversal == TraversalKind::Brute {
                continue;
            }
            let mut tracer = device.with(scene)?;
            let (hits, time) = quickest(|| tracer.cast(parts, Query::Closest, &bad));
            let (_, base) = quickest(|| tracer.cast(parts, Query::Closest, &fair));
            let hits = hits?;
            let work = |rays: &[Ray]| {
                let counts = count(scene, parts, Query::Closest, rays);
                (counts.nodes + counts.triangle_tests) as usize
            };
            // What a GPU reads is not counted; it is the same code.
            let excess = if matches!(device, Device::Cpu) {
                let most = 2 * work(&fair) / fair.len();
                bad.iter().filter(|ray| work(std::slice::from_ref(ray)) > most).count()
            } else {
                0
            };
            let is_hit = |(_, hit): &(&Ray, &Hit)| hit.is_hit();
            let options = format!(" {parts}");
            methods.push(MethodReport {
                name: name(parts),
                role: if parts == Parts::default() {
                    Role::Default
                } else {
                    Role::Offered
                },
                device: device.name(),
                counts: Counts {
                    rays: bad.len(),
                    phantom: hits.iter().filter(|hit| hit.is_hit()).count(),
                    excess,
                    ..Counts::default()
                },
                time_ratio: (bad.len() >= 1000).then_some(time.as_secs_f64() / base.as_secs_f64()),
                failures: failures(
                    bad.iter().zip(&hits).filter(is_hit).map(|(ray, _)| ray),
                    "false",
                    &options,
                ),
            });
        }
    }
    methods.push(exhibit(&scenes[&TraversalKind::Bvh2], &fair, &bad));
    Ok(ABOUT.report(methods))
}

fn exhibit(scene: &Scene, fair: &[Ray], bad: &[Ray]) -> MethodReport {
    let few = fair.len().min(MOST_OF_EXHIBIT);
    let read = |rays: &[Ray]| -> Vec<usize> { rays[..few].iter().map(|ray| unrefused_boxes(scene, ray)).collect() };
    let (boxes, time) = quickest(|| read(bad));
    let (of_fair, base) = quickest(|| read(fair));
    let most = 2 * of_fair.iter().sum::<usize>() / few;
    let is_dear = |(_, boxes): &(&Ray, &usize)| **boxes > most;
    MethodReport {
        name: "bvh2, NaN not refused".into(),
        role: Role::Exhibit,
        device: Device::Cpu.name(),
        counts: Counts {
            rays: few,
            excess: boxes.iter().filter(|boxes| **boxes > most).count(),
            ..Counts::default()
        },
        time_ratio: (few >= 1000).then_some(time.as_secs_f64() / base.as_secs_f64()),
        failures: failures(bad.iter().zip(&boxes).filter(is_dear).map(|(ray, _)| ray), "excess", ""),
    }
}

fn failures<'a>(rays: impl Iterator<Item = &'a Ray>, kind: &'static str, options: &str) -> Vec<Failure> {
    let failure = |ray: &Ray| {
        let failure = Failure {
            kind,
            ..Failure::of_ray(ray)
        };
        failure.replayed(&format!("lab:{}", ABOUT.id), options)
    };
    rays.take(KEPT).map(failure).collect()
}

/// The ray with a number that is none: each of the six places in turn, NaN and both infinities.
fn spoiled(mut ray: Ray, at: usize) -> Ray {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY][at / 6 % 3];
    let place: &mut Vec3 = if at % 6 < 3 {
        &mut ray.origin
    } else {
        &mut ray.direction
    };
    place[at % 3] = bad;
    ray
}
