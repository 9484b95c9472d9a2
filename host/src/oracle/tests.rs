//! The oracle's conventions, one by one. That it is right on many rays is shown in the crate `oktant-tests`.

use glam::{DVec3, Vec3};

use super::{Contact, Oracle, OracleHit, OracleRay};
use crate::mesh::Mesh;

fn oracle(triangles: &[[[f32; 3]; 3]]) -> Oracle {
    Oracle::new(&Mesh {
        positions: triangles.iter().flatten().copied().map(Vec3::from_array).collect(),
        triangles: (0..triangles.len() as u32)
            .map(|id| [3 * id, 3 * id + 1, 3 * id + 2])
            .collect(),
        ..Mesh::default()
    })
}

fn ray(origin: [f64; 3], direction: [f64; 3]) -> OracleRay {
    OracleRay {
        origin: DVec3::from_array(origin),
        direction: DVec3::from_array(direction),
        t_min: 0.0,
        t_max: f64::INFINITY,
    }
}

/// All four searches, which must agree.
fn closest(oracle: &Oracle, ray: &OracleRay) -> Option<OracleHit> {
    let hit = oracle.closest(ray);
    assert_eq!(hit, oracle.closest_brute(ray), "{ray:?}");
    assert_eq!(hit.is_some(), oracle.any(ray), "{ray:?}");
    assert_eq!(hit.is_some(), oracle.any_brute(ray), "{ray:?}");
    hit
}

const RIGHT: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const LEFT: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];

#[test]
fn a_hit_says_where() {
    let oracle = oracle(&[RIGHT]);
    for side in [1.0, -1.0] {
        let hit = closest(&oracle, &ray([0.25, 0.5, -3.0 * side], [0.0, 0.0, 2.0 * side])).unwrap();
        assert_eq!((hit.t, hit.triangle, hit.u, hit.v), (1.5, 0, 0.25, 0.5));
    }
}

#[test]
fn edges_and_corners_belong_to_the_triangle() {
    let oracle = oracle(&[RIGHT]);
    for (x, y) in [
        (0.0, 0.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (0.5, 0.0),
        (0.0, 0.5),
        (0.5, 0.5),
        (0.75, 0.25),
    ] {
        for direction in [[0.0, 0.0, 1.0], [-0.0, -0.0, 1.0], [0.0, -0.0, 7.0]] {
            assert!(closest(&oracle, &ray([x, y, -1.0], direction)).is_some(), "{x} {y}");
        }
    }
    for (x, y) in [(-1e-15, 0.5), (0.5, -1e-15), (0.5, 0.5 + 1e-15)] {
        assert!(
            closest(&oracle, &ray([x, y, -1.0], [0.0, 0.0, 1.0])).is_none(),
            "{x} {y}"
        );
    }
}

#[test]
fn both_ends_of_t_are_included() {
    let oracle = oracle(&[RIGHT]);
    let limited = |t_min, t_max| OracleRay {
        t_min,
        t_max,
        ..ray([0.25, 0.25, -1.0], [0.0, 0.0, 1.0])
    };
    for (t_min, t_max) in [(1.0, 2.0), (0.0, 1.0), (1.0, 1.0), (f64::NEG_INFINITY, f64::INFINITY)] {
        assert!(closest(&oracle, &limited(t_min, t_max)).is_some());
    }
    for (t_min, t_max) in [
        (1.0_f64.next_up(), 2.0),
        (0.0, 1.0_f64.next_down()),
        (2.0, 0.0),
        (f64::NAN, 2.0),
        (0.0, f64::NAN),
    ] {
        assert!(closest(&oracle, &limited(t_min, t_max)).is_none());
    }
    assert_eq!(
        closest(&oracle, &ray([0.25, 0.25, 0.0], [0.3, 0.1, 1.0])).unwrap().t,
        0.0
    );
}

#[test]
fn of_equal_t_the_lowest_id_wins() {
    let many = vec![RIGHT; 1000];
    let at_once = closest(&oracle(&many), &ray([0.2, 0.3, -1.0], [0.0, 0.0, 1.0])).unwrap();
    assert_eq!(at_once.triangle, 0);
    let hits = oracle(&many).hits(&ray([0.2, 0.3, -1.0], [0.0, 0.0, 1.0]));
    assert!(hits.iter().map(|hit| hit.triangle).eq(0..1000));
    // The shared edge belongs to both.
    for pair in [[RIGHT, LEFT], [LEFT, RIGHT]] {
        let hit = closest(&oracle(&pair), &ray([0.0, 0.5, -1.0], [0.0, 0.0, 1.0])).unwrap();
        assert_eq!(hit.triangle, 0);
    }
}

#[test]
fn degenerate_triangles_and_rays_in_the_plane_do_not_hit() {
    let line = [[0.1, 0.1, 0.3], [0.2, 0.2, 0.6], [0.4, 0.4, 1.2]];
    let point = [[0.1, 0.2, 0.3]; 3];
    let degenerate = oracle(&[line, point]);
    assert_eq!(degenerate.triangle_count(), 2);
    for corner in line.into_iter().chain(point) {
        let target = Vec3::from_array(corner).as_dvec3();
        let origin = DVec3::new(0.7, -0.4, -2.0);
        assert!(closest(&degenerate, &ray(origin.to_array(), (target - origin).to_array())).is_none());
    }
    let flat = oracle(&[RIGHT]);
    assert!(closest(&flat, &ray([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0])).is_none());
    assert!(closest(&flat, &ray([0.25, 0.25, 0.0], [1.0, 0.5, 0.0])).is_none());
}

#[test]
fn rays_that_can_hit_nothing_miss() {
    let oracle = oracle(&[RIGHT]);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(closest(&oracle, &ray([0.25, 0.25, bad], [0.0, 0.0, 1.0])).is_none());
        assert!(closest(&oracle, &ray([0.25, 0.25, -1.0], [0.0, bad, 1.0])).is_none());
    }
    assert!(closest(&oracle, &ray([0.25, 0.25, 0.0], [0.0, -0.0, 0.0])).is_none());
    assert!(closest(&Oracle::new(&Mesh::default()), &ray([0.0; 3], [0.0, 0.0, 1.0])).is_none());
}

#[test]
fn directions_of_any_size_hit() {
    let oracle = oracle(&[RIGHT, LEFT]);
    for size in [1e-39, 1e-20, 1.0, 1e20, 1e38] {
        for small in [0.0, -0.0, 1e-39, -1e-39, 1e-45, 1e-320, -1e-320] {
            let hit = closest(&oracle, &ray([0.25, 0.25, -1.0], [size * small, size * small, size])).unwrap();
            assert!((hit.t * size - 1.0).abs() < 1e-9, "{size} {small}");
        }
    }
}

#[test]
fn distances_are_in_scene_units() {
    let oracle = oracle(&[RIGHT, [[0.0; 3], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0]]]);
    let inside = ray([0.25, 0.125, -4.0], [0.0, 0.0, 0.01]);
    assert!((oracle.edge_distance(0, &inside) - 0.125).abs() < 1e-12);
    let outside = ray([-3.0, -4.0, 9.0], [0.0, 0.0, 100.0]);
    assert!((oracle.edge_distance(0, &outside) - 5.0).abs() < 1e-12);
    assert!((oracle.edge_distance(1, &ray([3.0, 0.5, 1.0], [0.0, 0.0, 3.0])) - 0.5).abs() < 1e-12);
    // Perpendicular to a ray at 45 degrees, half a unit in x looks shorter.
    let oblique = ray([1.5, 0.0, -1.0], [0.0, 0.0, 1.0]);
    let oblique = OracleRay {
        direction: DVec3::new(1.0, 0.0, 1.0),
        origin: oblique.origin - DVec3::X,
        ..oblique
    };
    assert!((oracle.edge_distance(0, &oblique) - 0.5 * 0.5_f64.sqrt()).abs() < 1e-12);

    let plane = oracle.plane_hit(0, &ray([9.0, 9.0, 3.0], [0.0, 0.0, -2.0])).unwrap();
    assert_eq!((plane.t, plane.distance, plane.cosine), (1.5, 3.0, 1.0));
    let plane = oracle.plane_hit(0, &ray([9.0, 9.0, -3.0], [3.0, 0.0, -4.0])).unwrap();
    assert_eq!((plane.t, plane.distance, plane.cosine), (-0.75, -3.0, 0.8));
    assert!(oracle.plane_hit(0, &ray([0.0, 0.0, 1.0], [1.0, 2.0, 0.0])).is_none());
    assert!(oracle.plane_hit(1, &ray([0.0, 0.0, 1.0], [1.0, 2.0, 3.0])).is_none());
    assert!(
        oracle
            .meet(0, &ray([0.25, 0.25, 1.0], [0.0, 0.0, 1.0]))
            .is_some_and(|hit| hit.t == -1.0)
    );
}

#[test]
fn what_f64_cannot_tell_is_decided_exactly() {
    // The middle of an edge in general position, from so far away that the side of the edge is lost in rounding.
    let a = DVec3::new(0.3, -0.7, 0.2).as_vec3();
    let b = DVec3::new(-0.5, 0.1, 0.9).as_vec3();
    let (left, right) = (Vec3::new(0.4, 0.8, 0.1), Vec3::new(-0.6, -0.6, 0.3));
    let pair = oracle(&[[a, b, left].map(|p| p.to_array()), [b, a, right].map(|p| p.to_array())]);
    let mut touched = 0;
    for i in 0..2_000_u32 {
        let weight = f64::from(1 + i % 62) / 64.0;
        let target = a.as_dvec3().lerp(b.as_dvec3(), weight).as_vec3();
        let away = Vec3::new(0.1 + 1e-3 * i as f32, 0.2, -3.0) * (1.0 + (i % 7) as f32 * 1e3);
        let ray = OracleRay::new(target + away, -away, 0.0, f32::INFINITY);
        let contacts = [0, 1].map(|triangle| pair.contact(triangle, &ray).unwrap());
        touched += contacts.iter().filter(|contact| **contact == Contact::Touch).count();
        assert!(
            contacts.contains(&Contact::Inside) || contacts == [Contact::Touch; 2],
            "{ray:?}: {contacts:?}"
        );
        let hits = pair.hits(&ray);
        assert_eq!(
            hits.len(),
            contacts.iter().filter(|contact| **contact != Contact::None).count()
        );
    }
    println!("{touched} touches");
    // A direction that `origin + direction` would swallow, and an edge that it misses by 1e-38 of its length.
    let small = oracle(&[RIGHT]);
    for (x, wanted) in [(-1e-38, Contact::None), (0.0, Contact::Touch), (1e-38, Contact::Inside)] {
        let ray = OracleRay::new(Vec3::new(0.0, 0.25, -1.0), Vec3::new(x, 0.0, 1.0), 0.0, f32::INFINITY);
        assert_eq!(small.contact(0, &ray), Some(wanted), "{x}");
        assert_eq!(small.closest(&ray).is_some(), wanted != Contact::None);
    }
}

#[test]
fn ends_of_t_are_decided_exactly() {
    // t = 1/3, which no f32 is.
    let oracle = oracle(&[RIGHT]);
    let third = 1.0_f32 / 3.0;
    let contact = |t_min: f32, t_max: f32, speed: f32| {
        let ray = OracleRay::new(Vec3::new(0.25, 0.25, -1.0), Vec3::new(0.0, 0.0, speed), t_min, t_max);
        let contact = oracle.contact(0, &ray).unwrap();
        assert_eq!(oracle.any(&ray), contact != Contact::None);
        contact
    };
    assert!(f64::from(third) > 1.0 / 3.0);
    assert_eq!(contact(0.0, third, 3.0), Contact::Inside);
    assert_eq!(contact(third, 1.0, 3.0), Contact::None);
    assert_eq!(contact(third.next_down(), 1.0, 3.0), Contact::Inside);
    assert_eq!(contact(0.0, third.next_down(), 3.0), Contact::None);
    assert_eq!(
        (contact(0.5, 1.0, 2.0), contact(0.0, 0.5, 2.0)),
        (Contact::Touch, Contact::Touch)
    );
    assert_eq!(contact(f32::NEG_INFINITY, f32::INFINITY, 3.0), Contact::Inside);
}

#[test]
fn triangles_of_corners_that_differ_much_in_size_have_an_area() {
    // In f64 the small corner vanishes beside the large ones.
    let far = [[1e20, 1e20, 0.0], [-1e20, -1e20, 0.0], [1.0, 0.0, 0.0]];
    let oracle = oracle(&[far]);
    let hit = closest(&oracle, &ray([0.5, f64::from(0.2_f32), 1.0], [0.0, 0.0, -1.0]));
    assert_eq!(hit.map(|hit| hit.t), Some(1.0));
    assert!(closest(&oracle, &ray([0.5, 0.75, 1.0], [0.0, 0.0, -1.0])).is_none());
}
