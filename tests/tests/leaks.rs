//! Closed meshes have no holes, and rays that leave a surface do not meet it.

#![cfg(test)]

use glam::{DMat3, DVec3, Vec3};
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions};
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant::view::{Place, View};
use oktant_shared::hit::Hit;
use oktant_shared::normal::face_normal;
use oktant_shared::ray::Ray;
use oktant_shared::secondary_origin::secondary_origin;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_tests::meshes;
use rayon::prelude::*;
use std::sync::Arc;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 968;

fn closed_meshes() -> Vec<(&'static str, Mesh)> {
    let bunny = MeshSource::Bunny.load(&silent).unwrap();
    let all = vec![
        ("icosphere", meshes::icosphere(5)),
        ("UV sphere", meshes::uv_sphere(100, 60)),
        ("torus", meshes::torus(1.0, 0.35, 120, 60)),
        ("bunny with its holes shut", meshes::with_holes_fanned(&bunny)),
    ];
    for (name, mesh) in &all {
        assert!(meshes::is_closed(mesh), "{name}");
    }
    all
}

/// Pixels that see the background although all their eight neighbours see the mesh.
fn isolated_background(hits: &[Hit]) -> usize {
    let hit = |x: u32, y: u32| hits[(y * WIDTH + x) as usize].is_hit();
    (1..HEIGHT - 1)
        .flat_map(|y| (1..WIDTH - 1).map(move |x| (x, y)))
        .filter(|&(x, y)| !hit(x, y) && (y - 1..=y + 1).all(|b| (x - 1..=x + 1).all(|a| (a, b) == (x, y) || hit(a, b))))
        .count()
}

fn no_isolated_background(backend_of: impl Fn(&Arc<Scene>) -> Box<dyn Backend>) {
    for (name, mesh) in closed_meshes() {
        let scene = Arc::new(Scene::new(&mesh, &StructureOptions::default(), &silent).unwrap());
        let mut backend = backend_of(&scene);
        for (azimuth, elevation, distance) in [(0.0, 0.0, 2.6), (45.0, 35.0, 1.8), (200.0, -20.0, 40.0)] {
            let view = View {
                camera: Place {
                    azimuth,
                    elevation,
                    distance,
                },
                field_of_view: if distance > 10.0 { 3.0 } else { 40.0 },
                ..View::default()
            };
            let hits = backend.hits(&view.frame(&scene, WIDTH, HEIGHT)).unwrap();
            assert!(
                hits.iter().filter(|hit| hit.is_hit()).count() > 100_000,
                "{name} fills the picture"
            );
            assert_eq!(isolated_background(&hits), 0, "{name} from {azimuth}, {elevation}");
        }
    }
}

#[test]
fn no_isolated_background_pixels_on_the_cpu() {
    no_isolated_background(|scene| Box::new(Cpu::new(scene.clone())));
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn no_isolated_background_pixels_on_the_gpu() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    println!("{}", gpu.name);
    no_isolated_background(|scene| Box::new(GpuBackend::new(gpu.clone(), scene).unwrap()));
}

#[test]
fn the_count_of_isolated_pixels_can_fail() {
    let mut hits = vec![
        Hit {
            triangle: 0,
            ..Hit::miss(1.0)
        };
        (WIDTH * HEIGHT) as usize
    ];
    assert_eq!(isolated_background(&hits), 0);
    hits[(5 * WIDTH + 7) as usize] = Hit::miss(1.0);
    assert_eq!(isolated_background(&hits), 1);
}

/// Of rays that leave a convex mesh outwards, how many meet it again, and the largest distance by which an origin was
/// moved, in lengths of the triangle's edges. Hits come from rays aimed at the mesh from `distance` radii away.
fn returned(mesh: &Mesh, distance: f32, count: usize) -> (usize, f32) {
    let scene = Scene::new(mesh, &StructureOptions::default(), &silent).unwrap();
    let (center, radius) = (scene.center(), scene.radius());
    let view = scene.view();
    (0..count)
        .into_par_iter()
        .map(|index| {
            let mut random = fastrand::Rng::with_seed(index as u64);
            let mut direction = || loop {
                let v = Vec3::from([(); 3].map(|()| random.f32() * 2.0 - 1.0));
                if (0.01..1.0).contains(&v.length_squared()) {
                    break v.normalize();
                }
            };
            let origin = center + direction() * (distance * radius);
            let target = center + direction() * (radius * 0.5);
            let out = direction();
            let hit = Standard::closest_hit(&view, &Ray::new(origin, target - origin));
            assert!(hit.is_hit());
            let triangle = scene.triangles[hit.triangle as usize];
            // The mesh's triangles face outwards.
            let normal = face_normal(&triangle);
            let start = secondary_origin(&triangle, &hit, normal);
            let moved = (start.as_dvec3() - exact_point(&triangle, &hit)).length() as f32;
            let out = if out.dot(normal) < 0.0 { -out } else { out };
            let again = Standard::any_hit(&view, &Ray::new(start, out));
            (
                usize::from(again),
                moved
                    / (triangle.b - triangle.a)
                        .length()
                        .max((triangle.c - triangle.a).length()),
            )
        })
        .reduce(|| (0, 0.0), |a, b| (a.0 + b.0, a.1.max(b.1)))
}

fn exact_point(triangle: &oktant_shared::triangle::Triangle, hit: &Hit) -> DVec3 {
    let corners = DMat3::from_cols(triangle.a.as_dvec3(), triangle.b.as_dvec3(), triangle.c.as_dvec3());
    let (u, v) = (f64::from(hit.u), f64::from(hit.v));
    corners * DVec3::new(1.0 - u - v, u, v)
}

fn transformed(mesh: &Mesh, scale: f32, offset: Vec3) -> Mesh {
    let mut mesh = mesh.clone();
    for position in &mut mesh.positions {
        *position = *position * scale + offset;
    }
    mesh
}

#[test]
fn rays_that_leave_a_convex_mesh_do_not_meet_it() {
    let sphere = meshes::uv_sphere(100, 50);
    let cases = [
        (1.0, Vec3::ZERO, 3.0),
        (1.0, Vec3::ZERO, 1e3),
        (1e-3, Vec3::ZERO, 3.0),
        (1e-6, Vec3::ZERO, 3.0),
        (1e3, Vec3::ZERO, 3.0),
        (1e6, Vec3::ZERO, 1e3),
        (1.0, Vec3::new(16.0, -12.0, 9.0), 3.0),
    ];
    for (scale, offset, distance) in cases {
        let mesh = transformed(&sphere, scale, offset);
        let (again, moved) = returned(&mesh, distance, 200_000);
        println!(
            "scale {scale:e}, offset {offset}, from {distance} radii: {again} of 200,000 return, moved {moved:e} edges"
        );
        assert_eq!(again, 0);
    }
}
