//! The traversal in lanes against its scalar twin, bit for bit.

#![cfg(test)]

use oktant_shared::hit::Hit;
use oktant_shared::octants::{NODE_VECTORS, Octants};
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::Ray;
use oktant_shared::scene::Scene;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle_test::{BaldwinWeber, MollerTrumbore, Plucker, TriangleTest, Watertight};
use oktant_tests::ray_classes::RayClass;
use oktant_tests::subject::Subject;
use rayon::prelude::*;

/// Rays of each class on each mesh.
const RAYS: usize = 20_000;

fn answers<V: Traversal>(scene: &Scene<'_>, rays: &[Ray]) -> Vec<([u32; 4], bool)> {
    let bits = |hit: Hit| [hit.t.to_bits(), hit.triangle, hit.u.to_bits(), hit.v.to_bits()];
    rays.par_iter()
        .map(|ray| (bits(V::closest_hit(scene, ray)), V::any_hit(scene, ray)))
        .collect()
}

fn compare<T: TriangleTest>(name: &str) {
    for subject in Subject::all() {
        let scene = subject.scene(TraversalKind::Octants);
        let mut found = 0;
        for class in RayClass::ALL {
            let mut rays = subject.rays(class, RAYS);
            rays.extend(subject.limited(&rays[..RAYS / 4]));
            let in_lanes = answers::<Octants<T>>(&scene.view(), &rays);
            let one_by_one = answers::<Octants<T, false>>(&scene.view(), &rays);
            for ((ray, a), b) in rays.iter().zip(&in_lanes).zip(&one_by_one) {
                assert_eq!(a, b, "{name}, {}, class {}: {ray:?}", subject.name, class.name());
                found += u32::from(a.1);
            }
        }
        assert!(found > 0, "{}: no ray hits anything", subject.name);
    }
}

#[test]
fn watertight_hits_are_the_same() {
    compare::<Watertight>("watertight");
}

#[test]
fn moller_trumbore_hits_are_the_same() {
    compare::<MollerTrumbore>("moller-trumbore");
}

#[test]
fn baldwin_weber_hits_are_the_same() {
    compare::<BaldwinWeber>("baldwin-weber");
}

#[test]
fn plucker_hits_are_the_same() {
    compare::<Plucker>("plucker");
}

/// Rays at a scene whose arrays end too early.
fn cut(cut: impl for<'a> Fn(Scene<'a>) -> Scene<'a>) {
    let subject = &Subject::all()[0];
    let scene = subject.scene(TraversalKind::Octants);
    for ray in subject.rays(RayClass::ALL[0], 1000) {
        Octants::<Watertight>::closest_hit(&cut(scene.view()), &ray);
    }
}

#[test]
#[should_panic = "there is no such node"]
fn nodes_that_are_not_there_are_not_read() {
    cut(|scene| Scene {
        nodes: &scene.nodes[..NODE_VECTORS as usize],
        ..scene
    });
}

#[test]
#[should_panic = "there is no such triangle"]
fn triangles_that_are_not_there_are_not_read() {
    cut(|scene| Scene {
        triangles: &scene.triangles[..3],
        ..scene
    });
}
