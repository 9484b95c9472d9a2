//! One property suite for all parts: every combination that is offered against the oracle, 13 classes of rays on six
//! meshes, on both back ends.

#![cfg(test)]

use glam::vec3;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions};
use oktant::backend::{Backend, Query};
use oktant::media::media_at;
use oktant::mesh_source::MeshSource;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::structure::StructureOptions;
use oktant_shared::medium::Media;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind, TriangleKind};
use oktant_shared::ray::Ray;
use oktant_tests::ray_classes::RayClass;
use oktant_tests::subject::Subject;
use oktant_tests::tally::Tally;
use std::path::Path;
use std::sync::Arc;

/// Triangles that brute force tests for each class, mesh and query, on meshes that are too large for all rays.
const BRUTE_TESTS: usize = 5_000_000;

/// Lavapipe ends the loops of an invocation after 65,535 turns in all, without a word: so many triangles are tested before, with
/// the turns that reading them in tiles takes.
const LAVAPIPE_TRIANGLES: usize = 50_000;

/// What a combination did on all meshes.
#[derive(Default)]
struct Sums {
    total: usize,
    /// Wrong, and no f32 error can be blamed.
    wrong: usize,
    /// Missed or farther, because the ray passes an edge within the f32 error.
    overlooked: usize,
    /// Wrong from 10^5 sizes away, where f32 itself cannot aim.
    very_far: usize,
}

impl Sums {
    fn add(&mut self, class: RayClass, tally: &Tally) {
        if class == RayClass::AimedVeryFar {
            self.very_far += tally.wrong();
        } else {
            self.total += tally.total();
            self.wrong += tally.wrong();
            self.overlooked += tally.overlooked();
        }
    }
}

/// Traces `count` rays of each class, and a quarter of them again with limits of `t`, through every combination; by brute
/// force only on meshes of up to `brute` triangles.
fn held_against_the_oracle(
    count: usize,
    brute: usize,
    backend_of: impl Fn(Arc<Scene>) -> Box<dyn Backend>,
) -> Vec<(Parts, Sums)> {
    let mut all: Vec<(Parts, Sums)> = Parts::OFFERED.iter().map(|parts| (*parts, Sums::default())).collect();
    for subject in Subject::all() {
        for traversal in TraversalKind::ALL {
            if *traversal == TraversalKind::Brute && subject.mesh.triangles.len() > brute {
                println!("{}: too many triangles for brute force here", subject.name);
                continue;
            }
            let mut backend = backend_of(Arc::new(subject.scene(*traversal)));
            let count = match traversal {
                TraversalKind::Brute => count.min(BRUTE_TESTS / subject.mesh.triangles.len()),
                _ => count,
            };
            for class in RayClass::ALL {
                let rays = subject.rays(class, count);
                let limited = subject.limited(&rays[..count / 4]);
                for (parts, sums) in all.iter_mut().filter(|(parts, _)| parts.traversal == *traversal) {
                    for (rays, limits) in [(&rays, ""), (&limited, ", limited")] {
                        let mut cast = |query| backend.cast(*parts, query, rays).unwrap();
                        let (closest, any) = (cast(Query::Closest), cast(Query::Any));
                        let closest = subject.judge_closest(rays, |index| closest[index]);
                        let any = subject.judge_any(rays, |index| any[index].is_hit());
                        if closest.wrong() + any.wrong() > 0 {
                            let (number, name) = (class.number(), class.name());
                            println!(
                                "{}, {parts}, class {number} ({name}){limits}: closest {closest}; any {any}",
                                subject.name
                            );
                        }
                        sums.add(class, &closest);
                        sums.add(class, &any);
                    }
                }
            }
        }
    }
    for (parts, sums) in &all {
        println!(
            "{parts}: of {} rays {} wrong, {} missed or farther within the f32 error; from 10^5 sizes {} wrong",
            sums.total, sums.wrong, sums.overlooked, sums.very_far
        );
    }
    all
}

/// The counts of tests that are not watertight are pinned: the rays are always the same (some are aimed at the cells of the default octree), and what a triangle test loses
/// does not depend on the structure.
#[test]
fn every_combination_equals_the_oracle_on_the_cpu() {
    for (parts, sums) in held_against_the_oracle(4_000, usize::MAX, |scene| Box::new(Cpu::new(scene))) {
        let overlooked = match parts.triangle {
            TriangleKind::Watertight => 0,
            TriangleKind::MollerTrumbore => 2,
            TriangleKind::BaldwinWeber => 47,
            TriangleKind::Plucker => 0,
        };
        assert_eq!((sums.wrong, sums.overlooked), (0, overlooked), "{parts}");
        assert_eq!(sums.very_far, 0, "{parts}");
    }
}

/// Drivers round in their own ways, so there are bounds: where a fused multiply-add rounds twice, the origins of rays from
/// afar are advanced less exactly, and what is not watertight may lose more than on the CPU.
#[test]
#[ignore = "needs a Vulkan driver"]
fn every_combination_equals_the_oracle_on_the_gpu() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    println!("{}", gpu.name);
    let backend = |scene: Arc<Scene>| -> Box<dyn Backend> { Box::new(GpuBackend::new(gpu.clone(), &scene).unwrap()) };
    let brute = if gpu.is_software() {
        LAVAPIPE_TRIANGLES
    } else {
        usize::MAX
    };
    for (parts, sums) in held_against_the_oracle(1_000, brute, backend) {
        let bound = if parts.triangle.description().is_watertight {
            sums.total / 50_000
        } else {
            sums.total / 5_000
        };
        assert_eq!(sums.wrong, 0, "{parts}");
        assert!(sums.overlooked <= bound, "{parts}: {} overlooked", sums.overlooked);
    }
}

/// Oracle: the CPU. What takes long is cast in pieces of 2^18 rays, and this is a little more.
#[test]
#[ignore = "needs a Vulkan driver"]
fn arrays_of_several_pieces_are_cast_whole() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    let mesh = MeshSource::Balls.load(&silent).unwrap();
    let scene = Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent).unwrap());
    let mut random = fastrand::Rng::with_seed(3);
    let (center, radius) = (scene.center(), scene.radius());
    let mut place = |size: f32| {
        let mut coordinate = || (random.f32() * 2.0 - 1.0) * size;
        center + vec3(coordinate(), coordinate(), coordinate())
    };
    let rays: Vec<Ray> = (0..(1 << 18) + 1_000)
        .map(|_| {
            let origin = place(3.0 * radius);
            Ray::new(origin, place(0.5 * radius) - origin)
        })
        .collect();
    let parts = Parts::default();
    let wanted = Cpu::new(scene.clone()).cast(parts, Query::Closest, &rays).unwrap();
    let mut backend = GpuBackend::new(gpu, &scene).unwrap();
    let found = backend.cast(parts, Query::Closest, &rays).unwrap();
    assert_eq!(found.len(), rays.len());
    let others = |range: std::ops::Range<usize>| {
        let pairs = wanted[range.clone()].iter().zip(&found[range]);
        pairs.filter(|(a, b)| a.triangle != b.triangle).count()
    };
    let hits = wanted.iter().filter(|hit| hit.is_hit()).count();
    println!("{hits} hits, {} on other triangles", others(0..rays.len()));
    assert!(hits > rays.len() / 4, "{hits}");
    assert!(others(0..1 << 18) < 30);
    assert_eq!(others(1 << 18..rays.len()), 0);
}

/// Oracle: the default structure. Some of the points are inside of the glass.
#[test]
fn what_a_point_is_inside_of_does_not_depend_on_the_structure() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes/glass.toml");
    let model = Source::from_path(path).load(&silent).unwrap().model;
    let scenes: Vec<Scene> = TraversalKind::ALL
        .iter()
        .map(|traversal| Scene::of_model(model.clone(), &StructureOptions::of(*traversal), &silent).unwrap())
        .collect();
    let mut inside = 0;
    let mesh = &model.mesh;
    for vertex in (0..mesh.positions.len()).step_by(mesh.positions.len().div_ceil(200)) {
        let point = mesh.positions[vertex] - mesh.normals[vertex] * (0.01 * scenes[0].radius());
        let media = media_at(&scenes[0], point);
        inside += usize::from(media != Media::AIR);
        for scene in &scenes[1..] {
            assert_eq!(media_at(scene, point), media, "{}, {point}", scene.parts);
        }
    }
    assert!(inside > 10, "{inside}");
}

/// Every part is in some combination, so that nothing goes untested.
#[test]
fn every_part_is_offered() {
    for traversal in TraversalKind::ALL {
        assert!(
            Parts::OFFERED.iter().any(|parts| parts.traversal == *traversal),
            "{traversal}"
        );
    }
    for triangle in TriangleKind::ALL {
        assert!(
            Parts::OFFERED.iter().any(|parts| parts.triangle == *triangle),
            "{triangle}"
        );
    }
    for box_test in BoxKind::ALL {
        assert!(
            Parts::OFFERED.iter().any(|parts| parts.box_test == *box_test),
            "{box_test}"
        );
    }
}
