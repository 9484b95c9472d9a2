//! The standard traversal against the oracle, at length: 13 classes of rays on six meshes. `parts` holds all that is
//! offered against it.

#![cfg(test)]

use oktant_shared::box_test::KayKajiya;
use oktant_shared::octree::INNER;
use oktant_shared::parts::TraversalKind;
use oktant_shared::revelles::Revelles;
use oktant_shared::traversal::Standard;
use oktant_shared::triangle_test::Watertight;
use oktant_tests::ray_classes::RayClass;
use oktant_tests::subject::Subject;
use oktant_tests::tally::Tally;
use std::sync::Arc;

/// Rays of each class on each mesh.
const RAYS: usize = 100_000;

/// Of all rays, how many may overlook a hit because they pass an edge within the f32 error.
const OVERLOOKED: f64 = 1e-6;

/// Of all rays, how many may differ from the oracle in any way within the f32 error. Most find something nearer: edges
/// of a closed surface belong to both neighbours, and the classes aim at edges on purpose.
const EXCUSED: f64 = 2e-5;

#[test]
fn the_standard_traversal_equals_the_oracle() {
    let (mut total, mut overlooked, mut excused, mut wrong) = (0, 0, 0, 0);
    let mut count = |name: &str, class: RayClass, query: &str, tally: Tally| {
        if tally.wrong() + tally.excused() > 0 {
            println!("{name}, class {} ({}), {query}: {tally}", class.number(), class.name());
        }
        // From 10^5 sizes away f32 itself cannot aim; what that costs is printed.
        if class != RayClass::AimedVeryFar {
            total += tally.total();
            overlooked += tally.overlooked();
            excused += tally.excused();
            wrong += tally.wrong();
        }
    };
    for subject in Subject::all() {
        let scene = subject.scene(TraversalKind::default());
        for class in RayClass::ALL {
            let rays = subject.rays(class, RAYS);
            assert!(rays.len() >= RAYS);
            let [closest, any] = subject.judge::<Standard>(&scene, &rays);
            count(subject.name, class, "closest", closest);
            count(subject.name, class, "any", any);
            let limited = subject.limited(&rays[..RAYS / 4]);
            let [closest, any] = subject.judge::<Standard>(&scene, &limited);
            count(subject.name, class, "closest, limited", closest);
            count(subject.name, class, "any, limited", any);
        }
    }
    println!(
        "{total} rays: {wrong} wrong, {excused} within the f32 error of an edge or limit, of these {overlooked} missed \
         or farther"
    );
    assert_eq!(wrong, 0);
    assert!(overlooked as f64 <= OVERLOOKED * total as f64);
    assert!(excused as f64 <= EXCUSED * total as f64);
}

/// The suite must be able to fail: a traversal that stops at the first leaf with a hit, or one that forgets triangles.
#[test]
fn the_suite_notices_a_lost_reference() {
    type Thesis = Revelles<KayKajiya, Watertight>;
    let subject = Subject::all().swap_remove(5);
    let mut scene = subject.scene(TraversalKind::Octree);
    let rays = subject.rays(RayClass::AimedNear, 10_000);
    assert_eq!(
        subject.judge::<Thesis>(&scene, &rays).map(|tally| tally.wrong()),
        [0, 0]
    );
    // All leaves forget their first reference.
    for words in Arc::make_mut(&mut scene.nodes) {
        if words.y != INNER && words.y > 0 {
            words.x += 1;
            words.y -= 1;
        }
        if words.w != INNER && words.w > 0 {
            words.z += 1;
            words.w -= 1;
        }
    }
    assert!(subject.judge::<Thesis>(&scene, &rays)[0].wrong() > 100);
}
