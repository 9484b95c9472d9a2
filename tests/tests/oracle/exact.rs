//! The oracle against exact predicates, and its hierarchy against its brute force.

use std::iter;

use glam::{DVec3, Vec3};
use oktant::mesh::Mesh;
use oktant::oracle::{self, Oracle, OracleHit, OracleRay};
use oktant_shared::ray::Ray;
use oktant_tests::exact::{Contact, ExactMesh, ExactRay};
use oktant_tests::meshes::{fan_64, flat_grid, icosphere, is_closed, room, soup, torus, uv_sphere};
use oktant_tests::ray_classes::{RayClass, for_oracle, rays};
use rayon::prelude::*;

use super::{cells, meshes};

/// How the oracle's hits of many rays compare with their exact contacts, counted in pairs of a ray and a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Comparison {
    /// Rays that exact predicates can judge.
    rays: usize,
    /// Passed through by the ray, exactly.
    inside: usize,
    /// Of these, not hit by the oracle.
    lost: usize,
    /// Hit by the oracle without any contact.
    invented: usize,
    /// Touched by the ray, exactly.
    touched: usize,
    /// Of these, hit by the oracle.
    touched_and_hit: usize,
}

fn compare(oracle: &Oracle, exact: &ExactMesh, ray: &Ray) -> Comparison {
    let Some(exact_ray) = ExactRay::new(ray) else {
        return Comparison::default();
    };
    let contacts = exact.contacts(&exact_ray);
    let mut hits: Vec<u32> = oracle.hits(&for_oracle(ray)).iter().map(|hit| hit.triangle).collect();
    hits.sort_unstable();
    let hit = |triangle: u32| hits.binary_search(&triangle).is_ok();
    for &(id, contact) in &contacts {
        // Two exact ways, by `robust` and by expansions, say the same.
        let wanted = match contact {
            Contact::None => oracle::Contact::None,
            Contact::Inside => oracle::Contact::Inside,
            Contact::Touch => oracle::Contact::Touch,
        };
        assert_eq!(oracle.contact(id, &for_oracle(ray)), Some(wanted), "{ray:?}");
    }
    let count = |wanted: Contact, hit_too: bool| {
        let matching = contacts
            .iter()
            .filter(|&&(id, contact)| contact == wanted && (!hit_too || hit(id)));
        matching.count()
    };
    let inside = count(Contact::Inside, false);
    let inside_and_hit = count(Contact::Inside, true);
    let touched_and_hit = count(Contact::Touch, true);
    Comparison {
        rays: 1,
        inside,
        lost: inside - inside_and_hit,
        invented: hits.len() - inside_and_hit - touched_and_hit,
        touched: count(Contact::Touch, false),
        touched_and_hit,
    }
}

fn compare_all(mesh: &Mesh, rays: &[Ray]) -> Comparison {
    let (oracle, exact) = (Oracle::new(mesh), ExactMesh::new(mesh));
    rays.par_iter()
        .map(|ray| compare(&oracle, &exact, ray))
        .reduce(Comparison::default, |a, b| Comparison {
            rays: a.rays + b.rays,
            inside: a.inside + b.inside,
            lost: a.lost + b.lost,
            invented: a.invented + b.invented,
            touched: a.touched + b.touched,
            touched_and_hit: a.touched_and_hit + b.touched_and_hit,
        })
}

/// Over 10,000 rays a mesh. Every triangle that a ray exactly passes through is hit, and none that it exactly has no
/// contact with, and every one that it exactly touches; on rays that are aimed at random there are no touches.
#[test]
fn the_oracle_agrees_with_exact_predicates() {
    for (name, mesh) in meshes() {
        for class in RayClass::ALL {
            let found = compare_all(&mesh, &rays(class, &mesh, &cells(&mesh), 800, 1));
            println!("{name}, {}: {found:?}", class.name());
            assert_eq!((found.lost, found.invented), (0, 0), "{name}, {}", class.name());
            assert_eq!(found.touched_and_hit, found.touched, "{name}, {}", class.name());
            let exact = match class {
                // Beside components of 1e-20 few origins leave room in the 53 bits of an f64; zeros do.
                RayClass::TinyComponents | RayClass::DenormalComponents => 10..800,
                _ => 800..801,
            };
            assert!(exact.contains(&found.rays), "{name}, {}", class.name());
            if matches!(class, RayClass::AimedNear | RayClass::FromInside) {
                assert_eq!(found.touched, 0, "{name}, {}", class.name());
                assert!(found.inside > 200, "{name}, {}", class.name());
            }
        }
    }
}

/// The hierarchy loses nothing and changes nothing, bit for bit, on rays of all classes.
#[test]
fn the_hierarchy_equals_brute_force() {
    for (name, mesh) in meshes() {
        let oracle = Oracle::new(&mesh);
        let count = if mesh.triangles.len() > 20_000 { 30 } else { 300 };
        for class in RayClass::ALL {
            rays(class, &mesh, &cells(&mesh), count, 2).par_iter().for_each(|ray| {
                let ray = for_oracle(ray);
                assert_eq!(oracle.closest(&ray), oracle.closest_brute(&ray), "{name}, {ray:?}");
                assert_eq!(oracle.any(&ray), oracle.any_brute(&ray), "{name}, {ray:?}");
            });
        }
    }
}

/// Aimed at corners, where rays graze the boxes of the hierarchy and rounding carries them in or out.
#[test]
fn the_hierarchy_loses_no_corner() {
    let mut random = fastrand::Rng::with_seed(8);
    for (name, mesh) in meshes().into_iter().filter(|(_, mesh)| mesh.triangles.len() < 20_000) {
        let oracle = Oracle::new(&mesh);
        let aimed = || {
            let corners = oracle.corners(random.u32(..mesh.triangles.len() as u32));
            let target = corners[random.usize(..3)];
            let away = DVec3::from_array([(); 3].map(|()| random.f64() - 0.5)) * 10.0_f64.powi(random.i32(0..6));
            OracleRay {
                origin: target + away,
                direction: -away,
                t_min: 0.0,
                t_max: f64::INFINITY,
            }
        };
        let rays: Vec<OracleRay> = iter::repeat_with(aimed).take(2_000).collect();
        rays.par_iter().for_each(|ray| {
            assert_eq!(oracle.closest(ray), oracle.closest_brute(ray), "{name}, {ray:?}");
            assert_eq!(oracle.any(ray), oracle.any_brute(ray), "{name}, {ray:?}");
        });
    }
}

/// In the planes of triangles that no axis is parallel to, through their middles.
#[test]
fn rays_in_the_plane_do_not_hit() {
    let mesh = soup(5_000, 3);
    let oracle = Oracle::new(&mesh);
    let mut random = fastrand::Rng::with_seed(9);
    for triangle in 0..5_000 {
        let [a, b, c] = oracle.corners(triangle);
        let direction = (random.f64() - 0.5) * (b - a) + (random.f64() - 0.5) * (c - a);
        let ray = OracleRay {
            origin: (a + b + c) / 3.0 - direction * 10.0_f64.powi(random.i32(0..5)),
            direction,
            t_min: f64::NEG_INFINITY,
            t_max: f64::INFINITY,
        };
        assert_eq!(oracle.meet(triangle, &ray), None, "{ray:?}, triangle {triangle}");
    }
}

/// `t`, `u` and `v` of a hit name the same point.
#[test]
fn hits_lie_where_they_say() {
    for (name, mesh) in meshes() {
        let oracle = Oracle::new(&mesh);
        for class in [
            RayClass::AimedNear,
            RayClass::AimedVeryFar,
            RayClass::DenormalComponents,
        ] {
            for ray in rays(class, &mesh, &cells(&mesh), 1_000, 3) {
                let ray = for_oracle(&ray);
                for OracleHit { t, triangle, u, v } in oracle.hits(&ray) {
                    let [a, b, c] = oracle.corners(triangle);
                    let on_ray = ray.origin + t * ray.direction;
                    let on_triangle = (1.0 - u - v) * a + u * b + v * c;
                    let grazing = oracle.plane_hit(triangle, &ray).unwrap().cosine;
                    let error = 2e-14 * (ray.origin - a).length() / grazing;
                    assert!(
                        (on_ray - on_triangle).length() <= error,
                        "{name}, {ray:?}, triangle {triangle}"
                    );
                }
            }
        }
    }
}

/// A mesh whose coordinates are multiples of 2^-10.
fn snapped(mesh: Mesh) -> Mesh {
    Mesh {
        positions: mesh
            .positions
            .iter()
            .map(|&point| (point * 1024.0).round() / 1024.0)
            .collect(),
        ..mesh
    }
}

/// Rays at corners and middles of edges, from multiples of 2^-11 in a cube round `centre`: origin, target and their
/// difference are exact in f32, so the ray passes through its target exactly. Threefold directions put the target at
/// `t` = 1/3, which no float is.
fn touching_rays(mesh: &Mesh, centre: Vec3, half_size: f32, count: usize) -> Vec<Ray> {
    let mut random = fastrand::Rng::with_seed(4);
    let mut ray = || {
        let corners = mesh.triangles[random.usize(..mesh.triangles.len())];
        let first = random.usize(..3);
        let [from, to] = [first, (first + 1) % 3].map(|corner| mesh.positions[corners[corner] as usize]);
        let target = if random.bool() { from } else { 0.5 * (from + to) };
        let offset = Vec3::from_array([(); 3].map(|()| 2.0 * random.f32() - 1.0)) * half_size;
        let origin = centre + (offset * 2048.0).round() / 2048.0;
        let direction = (target - origin) * if random.bool() { 1.0 } else { 3.0 };
        assert_eq!((target - origin).as_dvec3(), target.as_dvec3() - origin.as_dvec3());
        Ray::new(origin, direction)
    };
    (0..count).map(|_| ray()).collect()
}

/// Aimed exactly at corners and edges, 10,000 rays a mesh. From inside a closed mesh no ray slips out, and all triangles
/// round a corner are hit.
#[test]
fn exact_touches_leave_no_leak_in_closed_meshes() {
    for (name, mesh, centre) in [
        ("icosphere", snapped(icosphere(4)), Vec3::ZERO),
        ("UV sphere", snapped(uv_sphere(64, 32)), Vec3::ZERO),
        ("torus", snapped(torus(1.0, 0.5, 48, 24)), Vec3::X),
    ] {
        assert!(is_closed(&mesh));
        let rays = touching_rays(&mesh, centre, 0.125, 10_000);
        let oracle = Oracle::new(&mesh);
        let leaks = rays.iter().filter(|ray| !oracle.any(&for_oracle(ray))).count();
        let found = compare_all(&mesh, &rays);
        println!("{name}, touching: {leaks} leaks, {found:?}");
        assert_eq!(
            (leaks, found.lost, found.invented, found.rays),
            (0, 0, 0, 10_000),
            "{name}"
        );
        assert!(found.touched > 20_000, "{name}");
        assert_eq!(found.touched_and_hit, found.touched, "{name}");
    }
}

/// On open meshes a boundary that is touched is hit, too.
#[test]
fn exact_touches_from_outside_are_hits() {
    for (name, mesh) in [
        ("64-fan", snapped(fan_64())),
        ("flat grid", flat_grid(32)),
        ("soup", snapped(soup(3_000, 1))),
        ("room", snapped(room())),
        ("icosphere", snapped(icosphere(4))),
    ] {
        let found = compare_all(&mesh, &touching_rays(&mesh, Vec3::new(3.0, -2.0, 5.0), 1.0, 2_000));
        println!("{name}, touching: {found:?}");
        assert_eq!((found.lost, found.invented, found.rays), (0, 0, 2_000), "{name}");
        assert!(found.touched > 1_000, "{name}");
        assert_eq!(found.touched_and_hit, found.touched, "{name}");
    }
}
