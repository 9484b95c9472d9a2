//! All parts on the rays of a mesh.

use super::counting::count;
use super::report::{CombinationReport, PartNames, SetReport, SpeedReport, SubjectReport, TruthReport};
use super::subject::{JudgedSet, Subject};
use super::tracer::{Device, Tracer};
use crate::backend::BackendError;
use crate::model::Model;
use crate::profile::Profile;
use crate::progress::{Progress, silent};
use crate::scene::{Memory, Scene, SceneError};
use crate::spread::Spread;
use crate::structure::StructureOptions;
use crate::tree::BuildPreset;
use oktant_shared::parts::{Parts, TraversalKind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Tests of rays and triangles, of a set, up to which brute force takes part.
pub const BRUTE_BUDGET: u64 = 200_000_000;

/// Builds are not repeated once they have taken so long together.
const BUILDING: Duration = Duration::from_secs(2);

/// What is to be measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Combinations that are offered.
    pub parts: Vec<Parts>,
    /// Ways to build trees of boxes.
    pub builds: Vec<BuildPreset>,
    /// Measurements of each time, at least one.
    pub repeats: u32,
    /// What structures are built by, instead of the costs that they count with by default.
    pub profile: Option<Profile>,
}

/// Why nothing could be measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// There is no structure for the mesh.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A back end cannot do its work.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

/// Measures all combinations of a plan on a mesh, each on all devices that can do it. `progress` hears of the stage
/// "measuring".
///
/// # Errors
/// Where the mesh has nothing to trace, or a device gives up or is too small.
pub fn measure(
    subject: &Subject,
    plan: &Plan,
    devices: &[Device],
    progress: Progress<'_>,
) -> Result<SubjectReport, MeasureError> {
    let structures = structures(plan);
    let mut combinations = Vec::new();
    for (done, &(traversal, preset)) in structures.iter().enumerate() {
        progress("measuring", done as f32 / structures.len() as f32);
        let sets: Vec<&JudgedSet> = subject
            .sets
            .iter()
            .filter(|set| fits(traversal, set, subject))
            .collect();
        if sets.is_empty() {
            continue;
        }
        let (scene, build_milliseconds) = build(subject, plan, traversal, preset)?;
        let bytes = Memory::of(&scene).traced();
        let able = devices
            .iter()
            .filter(|device| traversal != TraversalKind::Brute || subject.mesh.triangles.len() <= device.most_brute());
        let mut tracers = Vec::new();
        for device in able {
            tracers.push((device.name(), device.with(&scene)?));
        }
        for &parts in plan.parts.iter().filter(|parts| parts.traversal == traversal) {
            let mut reports = Vec::new();
            for set in &sets {
                reports.push(measure_set(subject, set, &scene, parts, &mut tracers, plan.repeats)?);
            }
            combinations.push(CombinationReport {
                parts: PartNames::of(parts),
                build: is_tree(traversal).then(|| preset.name()),
                build_milliseconds,
                bytes_per_triangle: bytes as f64 / subject.mesh.triangles.len() as f64,
                sets: reports,
            });
        }
    }
    Ok(SubjectReport {
        name: subject.name.clone(),
        triangles: subject.mesh.triangles.len(),
        sets: subject
            .sets
            .iter()
            .map(|set| TruthReport {
                set: set.kind.name(),
                rays: set.rays.len(),
                hits: set.truth.hits(),
            })
            .collect(),
        combinations,
    })
}

/// What has to be built.
fn structures(plan: &Plan) -> Vec<(TraversalKind, BuildPreset)> {
    let traversals = TraversalKind::ALL.iter().copied();
    let wanted = traversals.filter(|kind| plan.parts.iter().any(|parts| parts.traversal == *kind));
    wanted
        .flat_map(|kind| {
            let builds = if is_tree(kind) {
                plan.builds.as_slice()
            } else {
                &[BuildPreset::Balanced]
            };
            builds.iter().map(move |build| (kind, *build))
        })
        .collect()
}

/// Whether a build preset makes a difference.
fn is_tree(traversal: TraversalKind) -> bool {
    matches!(
        traversal,
        TraversalKind::Octants | TraversalKind::Compact | TraversalKind::Bvh2
    )
}

fn fits(traversal: TraversalKind, set: &JudgedSet, subject: &Subject) -> bool {
    let tests = set.rays.len() as u64 * subject.mesh.triangles.len() as u64;
    traversal != TraversalKind::Brute || tests <= BRUTE_BUDGET
}

fn build(
    subject: &Subject,
    plan: &Plan,
    traversal: TraversalKind,
    preset: BuildPreset,
) -> Result<(Arc<Scene>, Spread), MeasureError> {
    let mut options = StructureOptions {
        preset,
        ..StructureOptions::of(traversal)
    };
    if let Some(profile) = &plan.profile {
        options.apply(profile);
    }
    let begin = Instant::now();
    let mut times = Vec::new();
    loop {
        let model = Model::of_mesh(subject.mesh.clone());
        let start = Instant::now();
        let scene = Scene::of_model(model, &options, &silent)?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
        if times.len() >= plan.repeats as usize || begin.elapsed() > BUILDING {
            let spread = Spread::new(times).expect("there is a time");
            return Ok((Arc::new(scene), spread));
        }
    }
}

fn measure_set(
    subject: &Subject,
    set: &JudgedSet,
    scene: &Scene,
    parts: Parts,
    tracers: &mut [(String, Tracer)],
    repeats: u32,
) -> Result<SetReport, MeasureError> {
    let query = set.kind.query();
    let counts = count(scene, parts, query, &set.rays);
    let mut devices = Vec::new();
    for (device, tracer) in tracers {
        // The check comes first, and is what warms up.
        let hits = tracer.cast(parts, query, &set.rays)?;
        let judgement = set.truth.judge(&subject.oracle, &set.rays, &hits);
        let times = tracer.time_cast(parts, query, &set.rays, repeats)?;
        devices.push(SpeedReport {
            device: device.clone(),
            judgement,
            mrays_per_second: Spread::of_speeds(set.rays.len(), &times).expect("there is a time"),
            milliseconds: Spread::new(times).expect("there is a time"),
        });
    }
    let per_ray = |count: u64| count as f64 / set.rays.len() as f64;
    Ok(SetReport {
        set: set.kind.name(),
        counts,
        nodes_per_ray: per_ray(counts.nodes),
        triangle_tests_per_ray: per_ray(counts.triangle_tests),
        devices,
    })
}
