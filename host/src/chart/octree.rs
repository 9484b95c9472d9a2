//! What depth and size of leaves cost the octree and the rays through it.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::plan::{MeasureError, Plan, chart_name, mesh_name, quickest};
use super::record::{Record, Value};
use crate::backend::cpu::Cpu;
use crate::bench::count;
use crate::mesh::Mesh;
use crate::octree::OctreeOptions;
use crate::oracle::Oracle;
use crate::progress::{Progress, silent};
use crate::ray_sets::{RaySet, fitted};
use crate::scene::{Memory, Scene};
use crate::structure::StructureOptions;
use oktant_shared::octree::MAX_DEPTH;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind, TriangleKind};
use std::sync::Arc;

const DEPTHS: std::ops::RangeInclusive<u32> = 4..=MAX_DEPTH;
const LEAVES: [u32; 6] = [1, 2, 4, 8, 16, 32];

/// The octree of Revelles with the watertight test.
const PARTS: Parts = Parts {
    traversal: TraversalKind::Octree,
    triangle: TriangleKind::Watertight,
    box_test: BoxKind::KayKajiya,
};

const TIME: &str = "time";
const WORK: &str = "work";
const MEMORY: &str = "memory";
const REFERENCES: &str = "references";

/// The series of what the cost model makes.
const DEFAULT: &str = "cost model";

/// A figure for each mesh of a plan, by the rays of [`fitted`] on the CPU. `progress` hears of the stage "measuring".
///
/// # Errors
/// [`MeasureError`].
pub fn octree(plan: &Plan, progress: Progress<'_>) -> Result<Vec<Figure>, MeasureError> {
    let mut figures = Vec::new();
    let trees = DEPTHS.count() * LEAVES.len() * plan.meshes.len();
    let mut done = 0;
    for source in &plan.meshes {
        let mesh = source.load(&silent)?;
        let source = source.to_string();
        let name = mesh_name(&source);
        let explanation = format!(
            "{name}, {} triangles; a line for each number of references down to which every cell is split. Time and work of a \
             ray in the mean of R1 to R4, on the CPU. The ring is what the octree has by default: split where that pays by its \
             cost model, at the depth that this comes to.",
            mesh.triangles.len()
        );
        let stem = format!("octree-{}", chart_name(&source));
        let mut figure = plan.figure(stem, "How deep should the octree be?", &explanation);
        for (panel, axis) in [
            (TIME, Axis::log("nanoseconds a ray")),
            (WORK, Axis::log("leaves and triangle tests a ray")),
            (MEMORY, Axis::log("bytes a triangle")),
            (REFERENCES, Axis::log("references a triangle")),
        ] {
            figure.panels.push(Panel {
                name: panel.into(),
                x: Axis::linear("greatest depth"),
                y: axis,
                better: None,
                is_joined: true,
            });
        }
        let sets = fitted(&mesh, &Oracle::new(&mesh), plan.size);
        for leaf in LEAVES {
            for depth in DEPTHS {
                progress("measuring", done as f32 / trees as f32);
                done += 1;
                let scene = built(&mesh, depth, Some(leaf))?;
                for (panel, y) in measured(plan, scene, &sets, mesh.triangles.len())? {
                    figure.records.push(Record {
                        panel: panel.into(),
                        series: match leaf {
                            1 => "1 reference a leaf".into(),
                            _ => format!("up to {leaf} references a leaf"),
                        },
                        label: String::new(),
                        x: f64::from(depth),
                        y: Value::Number(y),
                        is_marked: false,
                    });
                }
            }
        }
        let scene = built(&mesh, MAX_DEPTH, None)?;
        let depth = f64::from(scene.root.depth);
        for (panel, y) in measured(plan, scene, &sets, mesh.triangles.len())? {
            figure.records.push(Record {
                panel: panel.into(),
                series: DEFAULT.into(),
                label: "default".into(),
                x: depth,
                y: Value::Number(y),
                is_marked: true,
            });
        }
        figures.push(figure);
    }
    Ok(figures)
}

/// The octree down to a depth and a size of leaves, or to where the cost model ends it.
fn built(mesh: &Mesh, depth: u32, leaf: Option<u32>) -> Result<Scene, MeasureError> {
    let options = StructureOptions {
        parts: PARTS,
        octree: OctreeOptions {
            depth,
            leaf,
            ..OctreeOptions::default()
        },
        ..StructureOptions::default()
    };
    Ok(Scene::new(mesh, &options, &silent)?)
}

fn measured(
    plan: &Plan,
    scene: Scene,
    sets: &[RaySet],
    triangles: usize,
) -> Result<[(&'static str, f64); 4], MeasureError> {
    let bytes = Memory::of(&scene).traced();
    let references = scene.references.len();
    let cpu = Cpu::new(Arc::new(scene));
    let (mut milliseconds, mut work, mut rays) = (0.0, 0, 0);
    for set in sets {
        let query = set.kind.query();
        milliseconds += quickest(&cpu.time_cast(PARTS, query, &set.rays, plan.repeats)?);
        let counts = count(cpu.scene(), PARTS, query, &set.rays);
        work += counts.nodes + counts.triangle_tests;
        rays += set.rays.len();
    }
    let (rays, triangles) = (rays as f64, triangles as f64);
    Ok([
        (TIME, milliseconds * 1e6 / rays),
        (WORK, work as f64 / rays),
        (MEMORY, bytes as f64 / triangles),
        (REFERENCES, references as f64 / triangles),
    ])
}
