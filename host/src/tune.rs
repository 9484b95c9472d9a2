//! Measuring what the work of rays costs on a device.

mod fit;

pub use fit::{Fit, Sample, fit};

use crate::backend::BackendError;
use crate::bench::{Device, count};
use crate::costs::Costs;
use crate::mesh_source::{MeshError, MeshSource};
use crate::octree::OctreeOptions;
use crate::oracle::Oracle;
use crate::profile::Profile;
use crate::progress::{Progress, silent};
use crate::ray_sets::{RaySet, fitted};
use crate::scene::{Scene, SceneError};
use crate::structure::StructureOptions;
use glam::{UVec2, uvec2};
use oktant_shared::parts::TraversalKind;
use std::sync::Arc;
use tracing::debug;

/// Sizes of leaves of the octree, references.
const LEAVES: [u32; 6] = [2, 4, 8, 12, 16, 24];
/// Costs of a triangle, in nodes, for which trees of boxes are made: from leaves that are full to leaves of one triangle.
const TRIANGLES: [f32; 6] = [0.05, 0.15, 0.3, 0.5, 0.8, 2.0];
/// What is traced.
const MESHES: [MeshSource; 2] = [MeshSource::Bunny, MeshSource::Balls];

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Size of the picture whose rays are traced, pixels.
    pub size: UVec2,
    /// Measurements of each time, of which the quickest counts.
    pub repeats: u32,
}

impl Plan {
    /// Size of the picture where nobody says it: a real GPU is through with a smaller one before steps and tests count.
    pub fn size_for(device: &Device) -> UVec2 {
        match device {
            Device::Gpu(gpu) if !gpu.is_software() => uvec2(1280, 968),
            _ => uvec2(640, 484),
        }
    }
}

/// A profile, and how well it explains what was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuning {
    /// What was found.
    pub profile: Profile,
    /// [`Fit::residual`] of octants and octree.
    pub residuals: [f64; 2],
}

/// Why nothing could be measured.
#[derive(Debug, thiserror::Error)]
pub enum TuneError {
    /// A mesh could not be had.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// There is no structure for it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The device gave up.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// Times that say nothing.
    #[error(
        "The times of {0} do not tell what a step and a triangle test cost; let nothing else run, or give a larger --size or --repeat."
    )]
    Unclear(TraversalKind),
}

/// Measures a device: traces the rays of meshes through trees with smaller and larger leaves, and asks what steps and tests
/// must cost for the times to come out. `progress` hears of the stage "measuring".
///
/// # Errors
/// [`TuneError`].
pub fn tune(device: &Device, plan: &Plan, progress: Progress<'_>) -> Result<Tuning, TuneError> {
    let octants = TRIANGLES.map(|triangle| StructureOptions {
        boxes: Costs { node: 1.0, triangle },
        ..StructureOptions::of(TraversalKind::Octants)
    });
    let octree = LEAVES.map(|leaf| StructureOptions {
        octree: OctreeOptions {
            leaf: Some(leaf),
            ..OctreeOptions::default()
        },
        ..StructureOptions::of(TraversalKind::Octree)
    });
    let mut groups = [Vec::new(), Vec::new()];
    let steps = (MESHES.len() * 2) as f32;
    let mut done = 0.0;
    for source in &MESHES {
        let mesh = source.load(&silent)?;
        let sets = fitted(&mesh, &Oracle::new(&mesh), plan.size);
        for (groups, options) in groups.iter_mut().zip([&octants, &octree]) {
            progress("measuring", done / steps);
            done += 1.0;
            let scenes = options
                .iter()
                .map(|options| Scene::new(&mesh, options, &silent).map(Arc::new));
            let scenes: Vec<Arc<Scene>> = scenes.collect::<Result<_, SceneError>>()?;
            groups.extend(measured(device, &scenes, &sets, plan.repeats)?);
        }
    }
    progress("measuring", 1.0);
    let of = |traversal, groups: &[Vec<Sample>]| fit(groups).ok_or(TuneError::Unclear(traversal));
    let octants = of(TraversalKind::Octants, &groups[0])?;
    let octree = of(TraversalKind::Octree, &groups[1])?;
    Ok(Tuning {
        profile: Profile::new(device.name(), octants.costs, octree.costs),
        residuals: [octants.residual, octree.residual],
    })
}

/// The times and counts of scenes of one mesh, a group for each set of rays.
fn measured(
    device: &Device,
    scenes: &[Arc<Scene>],
    sets: &[RaySet],
    repeats: u32,
) -> Result<Vec<Vec<Sample>>, BackendError> {
    let tracers = scenes.iter().map(|scene| device.with(scene));
    let tracers: Vec<_> = tracers.collect::<Result<_, BackendError>>()?;
    let mut groups = Vec::new();
    for set in sets.iter().filter(|set| !set.rays.is_empty()) {
        let query = set.kind.query();
        let mut quickest = vec![f64::INFINITY; scenes.len()];
        // In turns: what else runs on the machine, and how fast that is at the time, is the same for all.
        for _ in 0..repeats {
            for ((tracer, scene), quickest) in tracers.iter().zip(scenes).zip(&mut quickest) {
                for time in tracer.time_cast(scene.parts, query, &set.rays, 1)? {
                    *quickest = quickest.min(time);
                }
            }
        }
        let rays = set.rays.len() as f64;
        let samples = scenes.iter().zip(quickest).map(|(scene, milliseconds)| {
            let counts = count(scene, scene.parts, query, &set.rays);
            let sample = Sample {
                nodes: counts.nodes as f64 / rays,
                tests: counts.triangle_tests as f64 / rays,
                time: milliseconds * 1e6 / rays,
            };
            debug!(
                "{} {:?}: {:.3} steps, {:.3} tests, {:.4} ns",
                scene.parts.traversal, set.kind, sample.nodes, sample.tests, sample.time
            );
            sample
        });
        groups.push(samples.collect());
    }
    Ok(groups)
}
