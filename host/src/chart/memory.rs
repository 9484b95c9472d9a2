//! What memory buys: bytes of a triangle against the speed of rays.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::pareto::Better;
use super::plan::{MeasureError, Plan, mesh_name, quickest, short_name};
use super::record::{Record, Value};
use crate::grid::GridOptions;
use crate::oracle::Oracle;
use crate::progress::{Progress, silent};
use crate::ray_sets::{RaySet, fitted};
use crate::scene::{Memory, Scene};
use crate::structure::StructureOptions;
use crate::tree::BuildPreset;
use oktant_shared::parts::{Parts, TraversalKind};
use std::sync::Arc;

/// A setting, and what charts call it.
type Setting = (String, StructureOptions);

/// Every structure that is offered but brute force's, in its settings: bytes a triangle, as [`Memory::traced`] counts them,
/// against rays a second in the mean of R1 to R4 of [`fitted`], by the watertight test; a panel for each mesh of a plan.
/// `progress` hears of the stage "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn memory(plan: &Plan, progress: Progress<'_>) -> Result<Figure, MeasureError> {
    let mut figure = plan.figure(
        "memory",
        "What do bytes buy?",
        "Nodes, references, triangles and ids, without what surfaces look like, against the rays of a second: camera, shadow, \
         mirrored and ambient ones, as many as each needs. Every structure in its settings, with the watertight test. The \
         black stairs are the Pareto front; the ring is the default.",
    );
    let settings = settings();
    let steps = settings.len() * plan.meshes.len();
    let mut done = 0;
    for source in &plan.meshes {
        let mesh = source.load(&silent)?;
        let source = source.to_string();
        let panel = format!("{}, {} triangles", mesh_name(&source), mesh.triangles.len());
        figure.panels.push(Panel {
            name: panel.clone(),
            x: Axis::log("bytes a triangle (fewer are to the left)"),
            y: Axis::log("million rays a second"),
            better: Some([Better::Lower, Better::Higher]),
            is_joined: false,
        });
        let sets = fitted(&mesh, &Oracle::new(&mesh), plan.size);
        for (label, options) in &settings {
            progress("measuring", done as f32 / steps as f32);
            done += 1;
            let scene = Arc::new(Scene::new(&mesh, options, &silent)?);
            let bytes = Memory::of(&scene).traced() as f64 / mesh.triangles.len() as f64;
            for (series, mrays) in speeds(plan, &scene, &sets)? {
                figure.records.push(Record {
                    panel: panel.clone(),
                    series,
                    label: label.clone(),
                    x: bytes,
                    y: Value::Number(mrays),
                    is_marked: *options == StructureOptions::default(),
                });
            }
        }
    }
    Ok(figure)
}

/// What is compared.
fn settings() -> Vec<Setting> {
    let mut settings = Vec::new();
    for traversal in TraversalKind::ALL.iter().copied() {
        let of = StructureOptions::of(traversal);
        match traversal {
            TraversalKind::Octants | TraversalKind::Compact | TraversalKind::Bvh2 => {
                settings.extend(BuildPreset::ALL.iter().map(|&preset| {
                    let options = StructureOptions { preset, ..of };
                    (preset.name().to_string(), options)
                }));
            }
            TraversalKind::Octree => {
                settings.push(("by cost".into(), of));
                for leaf in [4, 8, 16] {
                    let mut options = of;
                    options.octree.leaf = Some(leaf);
                    settings.push((format!("leaf={leaf}"), options));
                }
            }
            TraversalKind::Grid => {
                for density in [1.0, GridOptions::default().density] {
                    let mut options = of;
                    options.grid.density = density;
                    settings.push((format!("density={density}"), options));
                }
            }
            // It has no structure, and would take hours.
            TraversalKind::Brute => {}
        }
    }
    settings
}

/// Million rays a second on each device, with what charts call the structure there.
fn speeds(plan: &Plan, scene: &Arc<Scene>, sets: &[RaySet]) -> Result<Vec<(String, f64)>, MeasureError> {
    let parts: Parts = scene.parts;
    let mut speeds = Vec::new();
    for device in &plan.devices {
        let tracer = device.with(scene)?;
        let (mut milliseconds, mut rays) = (0.0, 0);
        for set in sets {
            let times = tracer.time_cast(parts, set.kind.query(), &set.rays, plan.repeats)?;
            milliseconds += quickest(&times);
            rays += set.rays.len();
        }
        let series = format!("{}, {}", parts.traversal, short_name(device));
        speeds.push((series, rays as f64 / milliseconds / 1e3));
    }
    Ok(speeds)
}
