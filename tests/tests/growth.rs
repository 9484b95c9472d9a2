//! How the work of a ray grows with the number of triangles: no faster than its logarithm. Nodes and tests are counted, so that
//! the figures are the same on every machine.

#![cfg(test)]

use glam::uvec2;
use oktant::bench::{Workload, count};
use oktant::progress::silent;
use oktant::ray_sets::SetKind;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::parts::Parts;

/// Triangles, and nodes and triangle tests of a ray of each set, R1 to R4, by the default parts.
fn work(workload: &Workload) -> (f64, Vec<f64>) {
    let subject = workload.subject(&SetKind::ALL, uvec2(160, 121), &silent).unwrap();
    let scene = Scene::new(&subject.mesh, &StructureOptions::default(), &silent).unwrap();
    let of_ray = subject.sets.iter().map(|set| {
        let counts = count(&scene, Parts::default(), set.kind.query(), &set.rays);
        (counts.nodes + counts.triangle_tests) as f64 / set.rays.len() as f64
    });
    (subject.mesh.triangles.len() as f64, of_ray.collect())
}

/// Holds the growth of R1 to R4 from the first of some meshes on against that of the logarithm, so many times.
fn grows_no_faster(workloads: impl IntoIterator<Item = Workload>, times: [f64; 4]) {
    let mut first: Option<(f64, Vec<f64>)> = None;
    for workload in workloads {
        let (triangles, work) = work(&workload);
        let (fewest, least) = first.get_or_insert_with(|| (triangles, work.clone()));
        let logarithm = triangles.ln() / fewest.ln();
        let growth: Vec<f64> = work.iter().zip(least).map(|(work, least)| work / *least).collect();
        println!("{workload}: {triangles} triangles, work {work:.2?}, growth {growth:.3?}, logarithm {logarithm:.3}");
        assert_eq!(growth.len(), times.len());
        for ((growth, times), kind) in growth.into_iter().zip(times).zip(SetKind::ALL) {
            assert!(
                growth <= times * logarithm,
                "{workload} {}: {growth} {logarithm}",
                kind.name()
            );
        }
    }
}

/// A thousand triangles, four times as many from one mesh to the next.
fn sizes(count: u32) -> impl Iterator<Item = u32> {
    (0..count).map(|step| 1_000 << (2 * step))
}

#[test]
fn work_grows_no_faster_than_the_logarithm() {
    grows_no_faster(sizes(6).map(Workload::Knot), [1.0; 4]);
}

#[test]
#[ignore = "takes minutes and 10 GB"]
fn work_grows_no_faster_than_the_logarithm_to_14_million_triangles() {
    grows_no_faster(sizes(7).chain([14_000_000]).map(Workload::Knot), [1.0; 4]);
}

/// Of a ball, rays to a light and mirrored ones cost so little at first, for most leave at once, that what each level of the
/// tree adds is more than the logarithm's part of it.
#[test]
fn on_balls_shadow_rays_and_mirrored_ones_grow_a_little_faster() {
    grows_no_faster(sizes(5).map(Workload::Ball), [1.0, 1.2, 1.15, 1.05]);
}
