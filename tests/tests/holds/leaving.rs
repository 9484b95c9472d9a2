//! Rays that leave a surface do not meet it.

use super::{count, failing, scene, unit};
use glam::{DVec3, Vec3, vec3};
use oktant::mesh::Mesh;
use oktant::ply;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant_shared::hit::Hit;
use oktant_shared::normal::face_normal;
use oktant_shared::ray::Ray;
use oktant_shared::secondary_origin::secondary_origin;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_shared::triangle::Triangle;
use oktant_tests::meshes;
use rayon::prelude::*;
use std::fmt::Write;

/// The ray that leaves the triangle at `hit`, to that side of its plane to which `direction` points.
fn leaving(triangle: &Triangle, hit: &Hit, direction: Vec3) -> Ray {
    let normal = face_normal(triangle);
    let side = if normal.dot(direction) < 0.0 { -normal } else { normal };
    Ray::new(secondary_origin(triangle, hit, side), direction)
}

/// How many of so many rays that leave a convex mesh outwards meet it again; the mesh is met from 3 and 1,000 radii away.
fn returning(mesh: &Mesh, count: usize) -> usize {
    let scene = scene(mesh);
    let (center, radius) = (scene.center(), scene.radius());
    let view = scene.view();
    failing(count, |random, size| {
        let returns = |at: usize, random: &mut fastrand::Rng| {
            let distance = if at.is_multiple_of(2) { 3.0 } else { 1e3 };
            let eye = center + unit(random) * (distance * radius);
            let target = center + unit(random) * (0.5 * radius);
            let hit = Standard::closest_hit(&view, &Ray::new(eye, target - eye));
            assert!(hit.is_hit());
            let normal = face_normal(&scene.triangles[hit.triangle as usize]);
            let out = unit(random);
            let out = if out.dot(normal) < 0.0 { -out } else { out };
            Standard::any_hit(&view, &leaving(&scene.triangles[hit.triangle as usize], &hit, out))
        };
        (0..size).filter(|at| returns(*at, random)).count()
    })
}

/// A ball of 320 triangles, whose rounded corners stay convex.
fn ball(radius: f32, center: Vec3) -> Mesh {
    let mut mesh = meshes::icosphere(2);
    for position in &mut mesh.positions {
        *position = *position * radius + center;
    }
    mesh
}

/// Oracle: convexity. Scales from 10^-6 to 10^6, offsets to 10^4 sizes.
#[test]
fn no_ray_meets_the_surface_that_it_leaves() {
    let scales = [1e-6, 1e-3, 1.0, 1e3, 1e6];
    let offsets = [
        vec3(10.0, -20.0, 5.0),
        vec3(1000.0, 1234.0, -2234.0),
        vec3(20_000.0, -15_000.0, 12_345.0),
    ];
    // Where coordinates have fewer digits for it, a coarser ball stays convex.
    let coarse = |offset: Vec3| {
        let mut mesh = meshes::icosphere(1);
        for position in &mut mesh.positions {
            *position += offset;
        }
        mesh
    };
    let scaled = scales
        .iter()
        .map(|scale| (format!("scale {scale:e}"), ball(*scale, Vec3::ZERO)));
    let moved = offsets
        .iter()
        .map(|offset| (format!("offset {offset}"), coarse(*offset)));
    let cases: Vec<(String, Mesh)> = scaled.chain(moved).collect();
    let each = count().div_ceil(cases.len());
    for (name, mesh) in cases {
        let returned = returning(&mesh, each);
        println!("{name}: {returned} of {each} rays meet what they leave");
        assert_eq!(returned, 0, "{name}");
    }
}

/// Oracle: convexity. Through the loader, 10^6 sizes away.
#[test]
fn no_ray_meets_the_surface_that_it_leaves_far_away_in_a_file() {
    let mesh = ball(1.0, Vec3::ZERO);
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face \
         {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len()
    );
    for position in &mesh.positions {
        let [x, y, z] = (position.as_dvec3() + DVec3::new(2e6, -1.5e6, 1.2e6)).to_array();
        writeln!(text, "{x} {y} {z}").unwrap();
    }
    for [a, b, c] in &mesh.triangles {
        writeln!(text, "3 {a} {b} {c}").unwrap();
    }
    let loaded = ply::parse(text.as_bytes(), "a ball far away", &silent).unwrap();
    assert_ne!(loaded.shift, DVec3::ZERO);
    let returned = returning(&loaded, count());
    println!(
        "10^6 sizes away in a file: {returned} of {} rays meet what they leave",
        count()
    );
    assert_eq!(returned, 0);
}

/// A coordinate of pbrt's tests.
fn power(random: &mut fastrand::Rng) -> f32 {
    10.0_f32.powf(16.0 * random.f32() - 8.0)
}

fn powers(random: &mut fastrand::Rng) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| power(random)))
}

/// Three corners with coordinates of 10^-8 to 10^8, up to 10^16 times as long as wide, and the longest edge over the height
/// above it.
fn any_triangle(random: &mut fastrand::Rng, has_signs: bool) -> ([Vec3; 3], f64) {
    let corners = [(); 3].map(|()| {
        powers(random).map(|coordinate| {
            if has_signs && random.bool() {
                -coordinate
            } else {
                coordinate
            }
        })
    });
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let squares = [b - a, c - b, a - c].map(DVec3::length_squared);
    let longest = squares.into_iter().fold(0.0, f64::max);
    (corners, longest / (b - a).cross(c - a).length())
}

fn alone(corners: [Vec3; 3]) -> Scene {
    scene(&Mesh {
        positions: corners.into(),
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    })
}

const RAYS: usize = 1000;

/// A test in the manner of pbrt-v4's shapes_test.cpp, harder than that: triangles with coordinates of 10^-8 to 10^8 and signs,
/// and rays from all over them. Oracle: a line meets a plane once.
#[test]
fn triangles_of_any_size_are_not_met_again() {
    /// Edges of triangles that are more slender may come out the same: 2^24.
    const KNOWN: f64 = (1 << 24) as f64;
    /// The longest edge over the height above it, up to which triangles belong to a class.
    const SLENDER: [f64; 4] = [32.0, 1000.0, KNOWN, f64::INFINITY];
    let triangles = count().div_ceil(100);
    let found: Vec<(f64, usize)> = (0..triangles as u64)
        .into_par_iter()
        .map(|seed| {
            let mut random = fastrand::Rng::with_seed(seed);
            let (corners, slenderness) = any_triangle(&mut random, true);
            let scene = alone(corners);
            let view = scene.view();
            let triangle = &scene.triangles[0];
            let returns = |_: &usize| {
                let (u, v) = (random.f32(), random.f32());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let hit = Hit {
                    t: 1.0,
                    triangle: 0,
                    u,
                    v,
                };
                Standard::any_hit(&view, &leaving(triangle, &hit, unit(&mut random)))
            };
            (slenderness, (0..RAYS).filter(returns).count())
        })
        .collect();
    let mut least = 0.0;
    for most in SLENDER {
        let class = found.iter().filter(|found| found.0 > least && found.0 <= most);
        let (triangles, returned) = class.fold((0, 0), |sum, found| (sum.0 + 1, sum.1 + found.1));
        println!(
            "{returned} rays return, of {triangles} triangles {least} to {most} times as long as wide, {RAYS} rays each"
        );
        assert!(triangles > 0);
        // Of the others, single precision does not know the normal.
        assert!(returned == 0 || most > KNOWN && returned * 1000 < triangles * RAYS);
        least = most;
    }
}

/// The test Triangle.Reintersect of pbrt-v4's shapes_test.cpp: triangles with positive coordinates of 10^-8 to 10^8, but for
/// those with next to no area, each met by a ray from as random a point, and left in random directions and towards random
/// points. Oracle: a line meets a plane once.
#[test]
fn the_triangles_of_pbrt_are_not_met_again() {
    let [triangles, returned] = (0..count().div_ceil(100) as u64)
        .into_par_iter()
        .map(|seed| {
            let mut random = fastrand::Rng::with_seed(seed);
            let (corners, _) = any_triangle(&mut random, false);
            let [a, b, c] = corners;
            if (b - a).cross(c - a).length_squared() < 1e-20 {
                return [0, 0];
            }
            let scene = alone(corners);
            let view = scene.view();
            let (u, v) = (random.f32(), random.f32());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let origin = powers(&mut random);
            let hit = Standard::closest_hit(&view, &Ray::new(origin, scene.triangles[0].point(u, v) - origin));
            if !hit.is_hit() {
                // Of some triangles rounding leaves nothing to hit.
                return [0, 0];
            }
            let returns = |_: &usize| {
                let away = leaving(&scene.triangles[hit.triangle as usize], &hit, unit(&mut random));
                let way = powers(&mut random) - scene.triangles[0].point(hit.u, hit.v);
                let to = Ray {
                    t_max: 1.0,
                    ..leaving(&scene.triangles[hit.triangle as usize], &hit, way)
                };
                [away, to].iter().any(|ray| {
                    let is_hit = Standard::any_hit(&view, ray);
                    assert_eq!(is_hit, Standard::closest_hit(&view, ray).is_hit());
                    is_hit
                })
            };
            [1, (0..RAYS).filter(returns).count()]
        })
        .reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    println!("{returned} rays return, of {triangles} triangles of pbrt, 2 times {RAYS} rays each");
    assert!(triangles * 1000 > count() * 9);
    assert_eq!(returned, 0);
}
