//! The octree that the cost model makes, against those that limits make.

#![cfg(test)]

use glam::{UVec2, Vec3, uvec2};
use oktant::backend::gpu::{Gpu, GpuOptions, ModulePath};
use oktant::bench::{Device, Subject, Workload, count};
use oktant::costs::Costs;
use oktant::mesh::Mesh;
use oktant::octree::{Octree, OctreeOptions};
use oktant::progress::silent;
use oktant::ray_sets::SetKind;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant::tune::{Plan, tune};
use oktant_shared::parts::TraversalKind;
use oktant_tests::data::reference;
use oktant_tests::meshes;
use rayon::ThreadPoolBuilder;
use std::sync::Arc;

/// What a person would try.
const DEPTHS: [u32; 4] = [6, 8, 10, 13];
const LEAVES: [u32; 6] = [1, 2, 4, 8, 16, 32];
/// By how much the model may be behind the best of them.
const BEHIND: f64 = 1.05;

/// Triangles round a corner, up and down.
fn fan(blades: u32) -> Mesh {
    let rim = |at: u32| {
        let (sin, cos) = (std::f32::consts::TAU * at as f32 / blades as f32).sin_cos();
        Vec3::new(cos, sin, 0.3 * (3.0 * cos).sin())
    };
    Mesh {
        positions: (0..blades).map(rim).chain([Vec3::ZERO]).collect(),
        triangles: (0..blades).map(|at| [blades, at, (at + 1) % blades]).collect(),
        ..Mesh::default()
    }
}

fn scene(subject: &Subject, octree: OctreeOptions) -> Arc<Scene> {
    let options = StructureOptions {
        octree,
        ..StructureOptions::of(TraversalKind::Octree)
    };
    Arc::new(Scene::new(&subject.mesh, &options, &silent).unwrap())
}

/// Leaves and triangle tests of a ray, in the mean of the sets.
fn work(subject: &Subject, scene: &Scene) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for set in &subject.sets {
        let counts = count(scene, scene.parts, set.kind.query(), &set.rays);
        let rays = (set.rays.len() * subject.sets.len()) as f64;
        sum[0] += counts.nodes as f64 / rays;
        sum[1] += counts.triangle_tests as f64 / rays;
    }
    sum
}

/// Nanoseconds of a ray of each set, of each the quickest of so many times, of one in `step` rays.
fn times(subject: &Subject, scene: &Arc<Scene>, device: &Device, step: usize, repeats: u32) -> Vec<f64> {
    let tracer = device.with(scene).unwrap();
    let of_set = |set: &oktant::bench::JudgedSet| {
        let rays: Vec<_> = set.rays.iter().step_by(step).copied().collect();
        let times = tracer.time_cast(scene.parts, set.kind.query(), &rays, repeats).unwrap();
        times.into_iter().fold(f64::INFINITY, f64::min) * 1e6 / rays.len() as f64
    };
    subject.sets.iter().map(of_set).collect()
}

/// All octrees of [`DEPTHS`] and [`LEAVES`].
fn limits() -> impl Iterator<Item = OctreeOptions> {
    DEPTHS.into_iter().flat_map(|depth| {
        LEAVES.map(|leaf| OctreeOptions {
            depth,
            leaf: Some(leaf),
            ..OctreeOptions::default()
        })
    })
}

fn said(options: &OctreeOptions) -> String {
    format!("depth={} leaf={}", options.depth, options.leaf.unwrap_or(0))
}

/// The model's tree must be near the cheapest that limits make.
fn check(subject: &Subject) {
    let cost = |work: [f64; 2]| Costs::OCTREE.of(work[0], work[1]);
    let all = limits().map(|options| (work(subject, &scene(subject, options)), options));
    let (best, options) = all.min_by(|a, b| cost(a.0).total_cmp(&cost(b.0))).unwrap();
    let scene = scene(subject, OctreeOptions::default());
    let own = work(subject, &scene);
    let (triangles, references) = (subject.mesh.triangles.len(), scene.references.len());
    println!(
        "| {} | {triangles} | {:.1} + {:.1} | {:.1} + {:.1}, {} | {:.3} | {:.1} |",
        subject.name,
        own[0],
        own[1],
        best[0],
        best[1],
        said(&options),
        cost(own) / cost(best),
        references as f64 / triangles as f64,
    );
    assert!(references <= 16 * triangles);
    assert!(
        cost(own) <= BEHIND * cost(best),
        "{}: {:.2} instead of {:.2}",
        subject.name,
        cost(own),
        cost(best)
    );
}

fn generated(name: &str, size: UVec2) -> Subject {
    let workload: Workload = name.parse().unwrap();
    workload.subject(&SetKind::ALL, size, &silent).unwrap()
}

fn split(mesh: &std::path::Path, size: UVec2) -> Subject {
    let workload = Workload::Split(Box::new(Workload::of_argument(mesh)));
    workload.subject(&SetKind::ALL, size, &silent).unwrap()
}

/// Oracle: what rays read in every tree of [`DEPTHS`] and [`LEAVES`], on meshes that no constant was measured with.
#[test]
fn the_model_comes_near_the_best_of_all_limits() {
    let size = uvec2(96, 72);
    for blades in [64, 1_000] {
        check(&Subject::new(
            format!("fan of {blades}"),
            fan(blades),
            None,
            &SetKind::ALL,
            size,
        ));
    }
    check(&generated("soup=5000", size));
    // What is small in what is large needs the references that the first levels must not take.
    check(&generated("stadium", uvec2(24, 18)));
}

/// Whether the subject's name has in it what `OKTANT_MESH` says.
fn is_wanted(subject: &Subject) -> bool {
    subject.name.contains(&std::env::var("OKTANT_MESH").unwrap_or_default())
}

/// The same, on those that take longer, of them the ones in whose names `OKTANT_MESH` is.
#[test]
#[ignore = "takes minutes"]
fn the_model_comes_near_the_best_on_large_meshes() {
    let size = uvec2(160, 120);
    let dragon = reference("meshes/dragon-202k.ply");
    let subjects = [
        generated("stadium", size),
        generated("room", size),
        generated("soup=100000", size),
        split("bunny".as_ref(), size),
        split(&dragon, size),
    ];
    subjects.iter().filter(|subject| is_wanted(subject)).for_each(check);
}

/// Limits with which a few rays, one in so many, take so many times as long as by the model are not measured.
const FEW: usize = 64;
const HOPELESS: f64 = 10.0;
/// How many of the quickest limits are measured again.
const AGAIN: usize = 6;
/// How often.
const ROUNDS: usize = 5;

/// Prints how much longer than by the quickest of all limits rays take by the model, in the mean of the sets and in each, with
/// the constants that are shipped and with those that `oktant tune` finds; of the meshes in whose names `OKTANT_MESH` is. What is
/// quickest of many is so by chance too, so the quickest are measured again, in turn with the model.
fn measure(device: &Device, size: UVec2) {
    let plan = Plan {
        size: Plan::size_for(device),
        repeats: 5,
    };
    let tuned = tune(device, &plan, &silent).unwrap().profile.octree;
    println!(
        "{}: a leaf counts {:.2} triangle tests",
        device.name(),
        tuned.node / tuned.triangle
    );
    let dragon = reference("meshes/dragon-202k.ply");
    let subjects = [
        Subject::new("fan of 64".into(), fan(64), None, &SetKind::ALL, size),
        generated("soup=5000", size),
        generated("room", size),
        generated("stadium", size),
        split("bunny".as_ref(), size),
        split(&dragon, size),
    ];
    for subject in subjects.iter().filter(|subject| is_wanted(subject)) {
        let mean = |times: &[f64]| times.iter().sum::<f64>() / times.len() as f64;
        let models = [Costs::OCTREE, tuned].map(|costs| OctreeOptions {
            costs,
            ..OctreeOptions::default()
        });
        let few = |scene: &Arc<Scene>| mean(&times(subject, scene, device, FEW, 1));
        let most = HOPELESS * few(&scene(subject, models[0]));
        let mut all: Vec<(f64, OctreeOptions)> = limits()
            .map(|options| (scene(subject, options), options))
            .filter(|(scene, _)| few(scene) < most)
            .map(|(scene, options)| (mean(&times(subject, &scene, device, 1, 1)), options))
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let again: Vec<OctreeOptions> = models
            .into_iter()
            .chain(all.iter().take(AGAIN).map(|one| one.1))
            .collect();
        let scenes: Vec<Arc<Scene>> = again.iter().map(|options| scene(subject, *options)).collect();
        let mut least = vec![vec![f64::INFINITY; subject.sets.len()]; scenes.len()];
        for _ in 0..ROUNDS {
            for (least, scene) in least.iter_mut().zip(&scenes) {
                for (least, time) in least.iter_mut().zip(times(subject, scene, device, 1, 10)) {
                    *least = least.min(time);
                }
            }
        }
        let (models, limits) = least.split_at(models.len());
        let best = (0..limits.len())
            .min_by(|a, b| mean(&limits[*a]).total_cmp(&mean(&limits[*b])))
            .unwrap();
        let of = |own: &[f64]| {
            let by_set = own
                .iter()
                .zip(&limits[best])
                .map(|(own, least)| format!("{:.3}", own / least));
            let by_set: Vec<_> = by_set.collect();
            format!("{:.3}, {}", mean(own) / mean(&limits[best]), by_set.join(" "))
        };
        println!(
            "| {} | {:.2} ns, {} | {} | {} |",
            subject.name,
            mean(&limits[best]),
            said(&all[best].1),
            of(&models[0]),
            of(&models[1])
        );
    }
}

/// Prints the table of `docs/measurements.md`.
#[test]
#[ignore = "measures times, for which nothing else must run"]
fn the_model_is_measured() {
    measure(&Device::Cpu, uvec2(320, 242));
}

/// The same on a GPU, which tells small pictures apart no more.
#[test]
#[ignore = "measures times on a GPU that is none of software"]
fn the_model_is_measured_on_a_gpu() {
    let options = GpuOptions {
        software: false,
        module: ModulePath::Auto,
        kernel: None,
    };
    measure(&Device::Gpu(Arc::new(Gpu::open(&options).unwrap())), uvec2(1280, 968));
}

/// A hard limit that the model alone would exceed.
#[test]
fn references_stay_within_the_budget() {
    for mesh in [meshes::soup(2_000, 1), fan(64), meshes::icosphere(4)] {
        let mut before = usize::MAX;
        for budget in [16, 4, 2, 1] {
            let options = OctreeOptions {
                budget,
                ..OctreeOptions::default()
            };
            let octree = Octree::build(&mesh, &options, &silent).unwrap();
            let references = octree.references.len();
            assert!(references <= budget as usize * mesh.triangles.len(), "{references}");
            assert!(references <= before);
            before = references;
        }
    }
}

#[test]
fn the_octree_is_the_same_on_any_number_of_threads() {
    let mesh = meshes::soup(3_000, 5);
    let on = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Octree::build(&mesh, &OctreeOptions::default(), &silent).unwrap())
    };
    let (one, three) = (on(1), on(3));
    assert!(one.nodes.len() > 1_000);
    assert_eq!((one.nodes, one.references), (three.nodes, three.references));
}

/// Where a step costs more, there are fewer of them and more triangles to test.
#[test]
fn costs_decide() {
    let subject = generated("soup=2000", uvec2(64, 48));
    let of = |node| {
        let costs = Costs { node, triangle: 1.0 };
        work(
            &subject,
            &scene(
                &subject,
                OctreeOptions {
                    costs,
                    ..OctreeOptions::default()
                },
            ),
        )
    };
    let works: Vec<[f64; 2]> = [0.5, 2.0, 8.0, 32.0].map(of).into();
    for pair in works.windows(2) {
        assert!(pair[0][0] > pair[1][0] && pair[0][1] < pair[1][1], "{works:?}");
    }
}
