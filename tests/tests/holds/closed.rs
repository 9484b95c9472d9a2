//! Closed meshes do not leak.

use super::{CHUNK, count, failing, scene, unit};
use glam::Vec3;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions};
use oktant::backend::{Backend, Query};
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::oracle::{Oracle, OracleRay};
use oktant::progress::silent;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TriangleKind};
use oktant_shared::ray::Ray;
use oktant_tests::meshes;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

fn corners(mesh: &Mesh, triangle: usize) -> [Vec3; 3] {
    mesh.triangles[triangle].map(|vertex| mesh.positions[vertex as usize])
}

/// Points inside of a closed mesh: a line to anywhere crosses it an odd number of times.
fn inside(mesh: &Mesh) -> Vec<Vec3> {
    let oracle = Oracle::new(mesh);
    let (low, high) = mesh.bounds().unwrap();
    let mut random = fastrand::Rng::with_seed(1);
    let points = std::iter::repeat_with(|| {
        let point = low + (high - low) * Vec3::from_array([(); 3].map(|()| random.f32()));
        let ray = OracleRay::new(point, unit(&mut random), 0.0, f32::INFINITY);
        (oracle.hits(&ray).len() % 2 == 1).then_some(point)
    });
    points.flatten().take(64).collect()
}

fn closed_meshes() -> [(&'static str, Mesh); 4] {
    let bunny = MeshSource::Bunny.load(&silent).unwrap();
    [
        ("icosphere", meshes::icosphere(5)),
        ("UV sphere", meshes::uv_sphere(100, 60)),
        ("torus", meshes::torus(1.0, 0.35, 120, 60)),
        ("bunny with its holes shut", meshes::with_holes_fanned(&bunny)),
    ]
}

/// Rays from inside of a closed mesh, aimed at its edges and vertices.
struct Hard<'a> {
    mesh: &'a Mesh,
    origins: Vec<Vec3>,
}

impl<'a> Hard<'a> {
    fn new(mesh: &'a Mesh) -> Self {
        assert!(meshes::is_closed(mesh));
        Hard {
            mesh,
            origins: inside(mesh),
        }
    }

    fn ray(&self, random: &mut fastrand::Rng) -> Ray {
        let corners = corners(self.mesh, random.usize(..self.mesh.triangles.len()));
        let first = random.usize(..3);
        let along = if random.bool() { 0.0 } else { random.f32() };
        let target = corners[first].lerp(corners[(first + 1) % 3], along);
        let origin = self.origins[random.usize(..self.origins.len())];
        Ray::new(origin, target - origin)
    }
}

fn parts(triangle: TriangleKind) -> Parts {
    Parts {
        triangle,
        ..Parts::default()
    }
}

fn leaks(hits: &[Hit]) -> usize {
    hits.par_iter().filter(|hit| !hit.is_hit()).count()
}

/// Oracle: the meshes are closed, so that every ray from inside meets them. The rays are aimed at edges and vertices, where
/// Moller and Trumbore's test lets some through.
#[test]
fn closed_meshes_do_not_leak() {
    for (name, mesh) in closed_meshes() {
        let rays = Hard::new(&mesh);
        let scene = Arc::new(scene(&mesh));
        let leaked = |test: TriangleKind, count: usize| {
            failing(count, |random, size| {
                let rays: Vec<Ray> = (0..size).map(|_| rays.ray(random)).collect();
                leaks(
                    &Cpu::new(scene.clone())
                        .cast(parts(test), Query::Closest, &rays)
                        .unwrap(),
                )
            })
        };
        told(name, "the CPU", count(), leaked);
    }
}

/// So many rays are made and traced at a time: 192 MiB with their hits.
const BATCH: usize = 1 << 22;

/// The same on the GPU: a real one if there is one. What a binding holds, and its memory, bound a batch and not the number of
/// rays; the next batch is made while one is traced.
#[test]
#[ignore = "needs a Vulkan driver"]
fn closed_meshes_do_not_leak_on_the_gpu() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    for (name, mesh) in closed_meshes() {
        let rays = Hard::new(&mesh);
        let mut backend = GpuBackend::new(gpu.clone(), &Arc::new(scene(&mesh))).unwrap();
        let batch = |first: usize, count: usize| -> Vec<Ray> {
            let chunks = first..count.min(first + BATCH);
            let chunks = chunks.into_par_iter().step_by(CHUNK);
            let rays = chunks.flat_map_iter(|first| {
                let mut random = fastrand::Rng::with_seed(first as u64);
                let size = CHUNK.min(count - first);
                let rays = &rays;
                (0..size).map(move |_| rays.ray(&mut random))
            });
            rays.collect()
        };
        let leaked = |test: TriangleKind, count: usize| {
            let mut leaked = 0;
            let mut rays = batch(0, count);
            for first in (0..count).step_by(BATCH) {
                let (next, hits) = rayon::join(
                    || batch(first + BATCH, count),
                    || backend.cast(parts(test), Query::Closest, &rays).unwrap(),
                );
                assert_eq!(hits.len(), rays.len());
                leaked += leaks(&hits);
                rays = next;
            }
            leaked
        };
        told(name, &gpu.name, count(), leaked);
    }
}

/// Counts the leaks of few rays by Moller and Trumbore's test, and of all by the default; prints and asserts.
fn told(name: &str, device: &str, count: usize, mut leaked: impl FnMut(TriangleKind, usize) -> usize) {
    let start = Instant::now();
    let hard = leaked(TriangleKind::MollerTrumbore, 20_000);
    let leaked = leaked(TriangleKind::Watertight, count);
    println!(
        "{name}: {leaked} of {count} rays leak on {device}; of 20,000 with moller-trumbore {hard}; {:.1} s",
        start.elapsed().as_secs_f32()
    );
    assert!(hard > 100, "{name}: the rays are not hard");
    assert_eq!(leaked, 0, "{name}");
}
