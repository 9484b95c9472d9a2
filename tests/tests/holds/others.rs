//! What other systems test themselves with.

use super::{count, failing, scene, unit};
use glam::{Vec3, vec3};
use oktant::backend::cpu::Cpu;
use oktant::backend::{Backend, Query};
use oktant::mesh::Mesh;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::parts::Parts;
use oktant_shared::ray::Ray;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_tests::meshes;
use rayon::prelude::*;
use std::sync::Arc;

/// The meshes of the Vulkan conformance suite's ray tracing watertightness tests, from their description: a plane of 4 to
/// 65,536 squares whose corners lie at random heights, 10 times each, and 256 x 256 parallel rays. Oracle: seen along the
/// heights the surface is whole.
#[test]
fn folded_planes_are_tight() {
    let mut folds = 0;
    for squares in [2_usize, 4, 8, 16, 32, 64, 128, 256] {
        for seed in 0..10 {
            let mut random = fastrand::Rng::with_seed(seed);
            let row = squares + 1;
            let along = |i: usize| i as f32 / squares as f32;
            let positions: Vec<Vec3> = (0..row * row)
                .map(|at| vec3(along(at % row), along(at / row), random.f32()))
                .collect();
            let square = |at: usize| {
                let a = (at % squares + at / squares * row) as u32;
                let (b, c, d) = (a + 1, a + row as u32 + 1, a + row as u32);
                [[a, b, c], [a, c, d]]
            };
            let mesh = Mesh {
                positions,
                triangles: (0..squares * squares).flat_map(square).collect(),
                ..Mesh::default()
            };
            let scene = scene(&mesh);
            let view = scene.view();
            let rays = (0..1 << 16).into_par_iter().map(|at: u32| {
                // The middles of pixels, most of them on no edge; and the corners of pixels, which are on edges.
                let shift = if seed % 2 == 0 { 0.5 } else { 0.0 };
                let place = |i: u32| (i as f32 + shift) / 256.0;
                Ray::new(vec3(place(at % 256), place(at / 256), -1.0), Vec3::Z)
            });
            let missed = rays.filter(|ray| !Standard::any_hit(&view, ray)).count();
            assert_eq!(missed, 0, "{squares} x {squares} squares, seed {seed}");
            folds += 1;
        }
    }
    println!("0 of {} rays pass through {folds} folded planes", folds * 65_536);
}

/// The stairs of Mitsuba 3's test_kdtrees.py: 20 steps, 127 x 127 rays along an axis. Oracle: the heights of the steps, which
/// f32 holds exactly, but for two units in the last place.
#[test]
fn stairs_are_as_high_as_they_are() {
    const STEPS: usize = 20;
    let step = 1.0 / 16.0;
    let mut mesh = Mesh::default();
    let mut add = |[a, b, c, d]: [Vec3; 4]| {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([a, b, c, d]);
        mesh.triangles
            .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    for i in 0..STEPS {
        let (x, z) = (i as f32 * step, i as f32 * step);
        let level = |x: f32, z: f32| [vec3(x, 0.0, z), vec3(x, 1.0, z)];
        let ([a, d], [b, c]) = (level(x, z), level(x + step, z));
        add([a, b, c, d]);
        let ([a, d], [b, c]) = (level(x + step, z), level(x + step, z + step));
        add([a, b, c, d]);
    }
    let width = STEPS as f32 * step;
    for parts in Parts::OFFERED.iter().copied() {
        let options = StructureOptions {
            parts,
            ..StructureOptions::default()
        };
        let scene = Arc::new(Scene::new(&mesh, &options, &silent).unwrap());
        // Never between two steps, where both have their say.
        let place = |i: usize| (i as f32 + 0.5) / 127.0;
        let rays: Vec<Ray> = (0..127 * 127)
            .map(|at| Ray::new(vec3(place(at % 127) * width, place(at / 127), 2.0), Vec3::NEG_Z))
            .collect();
        let hits = Cpu::new(scene).cast(parts, Query::Closest, &rays).unwrap();
        let wrong = rays.iter().zip(&hits).filter(|(ray, hit)| {
            let height = (ray.origin.x / step).floor() * step;
            // The tests round their quotients, at most twice.
            !hit.is_hit() || (hit.t - (2.0 - height)).abs() > 2.0 * f32::EPSILON * hit.t
        });
        assert_eq!(wrong.count(), 0, "{parts}");
    }
}

/// Embree's verify, WatertightTest: a sphere and a plane 270 km from the origin of coordinates, met from within 1 of its
/// middle. Oracle: the sphere is closed; the plane is wider than what is aimed at.
#[test]
fn a_sphere_and_a_plane_on_a_map_are_tight() {
    let place = vec3(148_376.0, 1234.0, -223_423.0);
    let mut sphere = meshes::uv_sphere(100, 50);
    for position in &mut sphere.positions {
        *position = *position * 2.0 + place;
    }
    let mut plane = meshes::flat_grid(12);
    for position in &mut plane.positions {
        *position = *position * 12.0 + place;
    }
    let (low, high) = plane.bounds().unwrap();
    for (name, mesh, is_plane) in [("sphere", sphere, false), ("plane", plane, true)] {
        let scene = scene(&mesh);
        let view = scene.view();
        let missed = failing(count(), |random, size| {
            let misses = |random: &mut fastrand::Rng| {
                let within = unit(random) * random.f32();
                let ray = if is_plane {
                    // The flat grid lies across z.
                    let origin = place + within + Vec3::Z * 1.5;
                    let corner = mesh.positions[random.usize(..mesh.positions.len())];
                    let target = corner.clamp(low + 0.01, high - 0.01).with_z(low.z);
                    Ray::new(origin, target - origin)
                } else {
                    Ray::new(place + within, unit(random))
                };
                !Standard::any_hit(&view, &ray)
            };
            (0..size).filter(|_| misses(random)).count()
        });
        println!("{name}: {missed} of {} rays miss", count());
        assert_eq!(missed, 0, "{name}");
    }
}
