//! The traversal in lanes against its scalar twin, bit for bit.

#![cfg(test)]

use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::octants::{NODE_VECTORS, Octants};
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::{Ray, T_MAX};
use oktant_shared::scene::Scene;
use oktant_shared::traversal::{Compact, Standard, Traversal};
use oktant_shared::triangle_test::{BaldwinWeber, Indexed, MollerTrumbore, Plucker, TriangleTest, Watertight};
use oktant_tests::ray_classes::RayClass;
use oktant_tests::subject::Subject;
use rayon::prelude::*;

/// Rays of each class on each mesh.
const RAYS: usize = 20_000;

/// How many rays are given at once where many are: neither even nor a divisor of all.
const AT_ONCE: usize = 61;

/// The same where packets of eight are to be as they were made.
const PACKETS: usize = 800;

fn bits(hit: Hit) -> [u32; 4] {
    [hit.t.to_bits(), hit.triangle, hit.u.to_bits(), hit.v.to_bits()]
}

fn answers<V: Traversal>(scene: &Scene<'_>, rays: &[Ray]) -> Vec<([u32; 4], bool)> {
    rays.par_iter()
        .map(|ray| (bits(V::closest_hit(scene, ray)), V::any_hit(scene, ray)))
        .collect()
}

fn answers_at_once<V: Traversal>(scene: &Scene<'_>, rays: &[Ray], count: usize) -> Vec<([u32; 4], bool)> {
    let chunks = rays.par_chunks(count).map(|rays| {
        let mut hits = vec![Hit::miss(-1.0); rays.len()];
        let mut are_hit = vec![false; rays.len()];
        V::closest_hits(scene, rays, &mut hits);
        V::any_hits(scene, rays, &mut are_hit);
        hits.into_iter().map(bits).zip(are_hit).collect::<Vec<_>>()
    });
    chunks.flatten().collect()
}

/// Checks every way of the lanes against the scalar twin, and counts the rays that hit anything.
fn compare_all<T: TriangleTest>(scene: &Scene<'_>, rays: &[Ray], what: &str) -> usize {
    let one_by_one = answers::<Octants<T, false>>(scene, rays);
    for (way, in_lanes) in [
        ("alone", answers::<Octants<T>>(scene, rays)),
        ("at once", answers_at_once::<Octants<T>>(scene, rays, AT_ONCE)),
    ] {
        for ((ray, a), b) in rays.iter().zip(&in_lanes).zip(&one_by_one) {
            assert_eq!(a, b, "{what}, {way}: {ray:?}");
        }
    }
    one_by_one.iter().filter(|answer| answer.1).count()
}

fn compare<T: TriangleTest>(name: &str) {
    for subject in Subject::all() {
        let scene = subject.scene(TraversalKind::Octants);
        let mut found = 0;
        for class in RayClass::ALL {
            let mut rays = subject.rays(class, RAYS);
            rays.extend(subject.limited(&rays[..RAYS / 4]));
            found += compare_all::<T>(
                &scene.view(),
                &rays,
                &format!("{name}, {}, class {}", subject.name, class.name()),
            );
        }
        assert!(found > 0, "{}: no ray hits anything", subject.name);
    }
}

/// Rays that are prepared in lanes, and such that just are not: they begin ever further away, are long and short, lie in
/// planes of the axes, and have limits of every kind.
#[test]
fn rays_of_all_sizes_are_the_same() {
    for subject in Subject::all() {
        let scene = subject.scene(TraversalKind::Octants);
        let view = scene.view();
        let size = view.root.size();
        let aimed = subject.rays(RayClass::ALL[0], 400);
        let mut rays = Vec::new();
        for (k, ray) in aimed.iter().enumerate() {
            let way = ray.direction.normalize_or_zero();
            let target = ray.at(0.5);
            for distance in [0.0, 0.5, 2.0, 2.99, 3.0, 3.01, 3.99, 4.0, 4.01, 5.0, 7.0, 1000.0] {
                for exponent in [-130, -120, -61, -31, -30, -29, 0, 29, 30, 31, 61, 120] {
                    let mut direction = way * 2.0_f32.powi(exponent);
                    direction[k % 3] *= [1.0, 0.0, -0.0, 1e-9, 1e-12, 1e-20, 1e-39][k / 3 % 7];
                    rays.push(Ray {
                        t_min: [0.0, -1.0, 0.25 * size, f32::NAN, f32::INFINITY][k / 21 % 5 * usize::from(k % 2 == 0)],
                        t_max: [T_MAX, f32::INFINITY, size * 5.0, -1.0, f32::NAN][k / 7 % 5 * usize::from(k % 4 == 1)],
                        ..Ray::new(target - way * size * distance, direction)
                    });
                }
            }
        }
        let found = compare_all::<Watertight>(&view, &rays, subject.name);
        assert!(
            found > rays.len() / 50,
            "{}: {found} of {} rays hit",
            subject.name,
            rays.len()
        );
    }
}

/// Eight rays and eight and so on that go nearly the same way from nearly the same place, with limits of their own: such go
/// together where all are alike enough.
fn alike(subject: &Subject, rays: &[Ray]) -> Vec<Ray> {
    let size = subject.scene(TraversalKind::Octants).view().root.size();
    let mut alike = Vec::with_capacity(8 * rays.len());
    for (k, ray) in rays.iter().enumerate() {
        // None, few and many of the packet's rays end elsewhere.
        let spread = [0.0, 1e-6, 1e-3, 0.02, 0.2][k % 5];
        let length = ray.direction.length();
        for lane in 0..8 {
            let aside = [0.0, 1.0, -1.0, 0.3, -0.7, 0.5, 0.1, -0.2].map(|part: f32| part * spread);
            let change = Vec3::new(aside[lane], aside[(lane + 3) % 8], aside[(lane + 5) % 8]);
            let limited = k / 5 % 3 == 1 && lane % 3 == k % 3;
            alike.push(Ray {
                origin: ray.origin + change * (if k % 2 == 0 { 0.0 } else { size }),
                direction: ray.direction + change * length,
                t_min: if limited { 0.4 * size / length } else { ray.t_min },
                t_max: if limited { 0.9 * size / length } else { ray.t_max },
            });
        }
    }
    alike
}

#[test]
fn rays_that_go_together_are_the_same() {
    for subject in Subject::all() {
        let (own, shared) = (
            subject.scene(TraversalKind::Octants),
            subject.scene(TraversalKind::Compact),
        );
        let mut found = 0;
        for class in RayClass::ALL {
            let rays = alike(&subject, &subject.rays(class, RAYS / 8));
            let what = format!("together, {}, class {}", subject.name, class.name());
            let one_by_one = answers::<Octants<Watertight, false>>(&own.view(), &rays);
            for (indexed, answers) in [
                (
                    false,
                    answers_at_once::<Octants<Watertight>>(&own.view(), &rays, PACKETS),
                ),
                (
                    true,
                    answers_at_once::<Octants<Indexed<Watertight>>>(&shared.view(), &rays, PACKETS),
                ),
            ] {
                for ((ray, a), b) in rays.iter().zip(&answers).zip(&one_by_one) {
                    assert_eq!(a, b, "{what}, indexed: {indexed}: {ray:?}");
                }
            }
            found += one_by_one.iter().filter(|answer| answer.1).count();
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

/// Triangles that share their corners are found as those that have their own, bit for bit.
#[test]
fn indexed_triangles_are_hit_the_same() {
    for subject in Subject::all() {
        let (own, shared) = (
            subject.scene(TraversalKind::Octants),
            subject.scene(TraversalKind::Compact),
        );
        assert!(own.nodes == shared.nodes && own.ids == shared.ids, "{}", subject.name);
        let (own, shared) = (own.view(), shared.view());
        let mut found = 0;
        for class in RayClass::ALL {
            let mut rays = subject.rays(class, RAYS);
            rays.extend(subject.limited(&rays[..RAYS / 4]));
            let what = format!("indexed, {}, class {}", subject.name, class.name());
            found += compare_all::<Indexed<Watertight>>(&shared, &rays, &what);
            let (a, b) = (
                answers_at_once::<Octants<Watertight>>(&own, &rays, AT_ONCE),
                answers_at_once::<Octants<Indexed<Watertight>>>(&shared, &rays, AT_ONCE),
            );
            for ((ray, a), b) in rays.iter().zip(&a).zip(&b) {
                assert_eq!(a, b, "{what}: {ray:?}");
            }
        }
        assert!(found > 0, "{}: no ray hits anything", subject.name);
    }
}

/// Rays, alone and eight together, at a scene whose arrays end too early must find out.
macro_rules! cut {
    ($($alone:ident $together:ident $message:literal $way:ident $kind:expr, $cut:expr;)+) => {$(
        #[test]
        #[should_panic = $message]
        fn $alone() {
            ask($kind, $cut, |scene, ray| {
                $way::closest_hit(scene, ray);
            });
        }

        #[test]
        #[should_panic = $message]
        fn $together() {
            ask($kind, $cut, |scene, ray| $way::closest_hits(scene, &[*ray; 8], &mut [Hit::miss(0.0); 8]));
        }
    )+};
}

fn ask(traversal: TraversalKind, cut: fn(Scene<'_>) -> Scene<'_>, ask: fn(&Scene<'_>, &Ray)) {
    let subject = &Subject::all()[0];
    let scene = subject.scene(traversal);
    for ray in subject.rays(RayClass::ALL[0], 1000) {
        ask(&cut(scene.view()), &ray);
    }
}

cut! {
    nodes_that_are_not_there_are_not_read nodes_that_are_not_there_are_not_read_together
    "there is no such node" Standard TraversalKind::Octants, |scene| Scene {
        nodes: &scene.nodes[..NODE_VECTORS as usize],
        ..scene
    };
    triangles_that_are_not_there_are_not_read triangles_that_are_not_there_are_not_read_together
    "there is no such triangle" Standard TraversalKind::Octants, |scene| Scene {
        triangles: &scene.triangles[..3],
        ..scene
    };
    indices_that_are_not_there_are_not_read indices_that_are_not_there_are_not_read_together
    "there is no such triangle" Compact TraversalKind::Compact, |scene| Scene {
        references: &scene.references[..3],
        ..scene
    };
    corners_that_are_not_there_are_not_read corners_that_are_not_there_are_not_read_together
    "there is no such vertex" Compact TraversalKind::Compact, |scene| Scene {
        triangles: &scene.triangles[..1],
        ..scene
    };
}
