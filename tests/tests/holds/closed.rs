//! Closed meshes do not leak.

use super::{count, failing, scene, unit};
use glam::Vec3;
use oktant::backend::cpu::Cpu;
use oktant::backend::{Backend, Query};
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::oracle::{Oracle, OracleRay};
use oktant::progress::silent;
use oktant_shared::parts::{Parts, TriangleKind};
use oktant_shared::ray::Ray;
use oktant_tests::meshes;
use std::sync::Arc;

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

/// Oracle: the meshes are closed, so that every ray from inside meets them. The rays are aimed at edges and vertices, where
/// Moller and Trumbore's test lets some through.
#[test]
fn closed_meshes_do_not_leak() {
    for (name, mesh) in closed_meshes() {
        assert!(meshes::is_closed(&mesh), "{name}");
        let origins = inside(&mesh);
        let scene = Arc::new(scene(&mesh));
        let leaks = |test: TriangleKind, count: usize| {
            let parts = Parts {
                triangle: test,
                ..Parts::default()
            };
            failing(count, |random, size| {
                let rays: Vec<Ray> = (0..size)
                    .map(|at| {
                        let corners = corners(&mesh, random.usize(..mesh.triangles.len()));
                        let first = random.usize(..3);
                        let along = if at.is_multiple_of(2) { 0.0 } else { random.f32() };
                        let target = corners[first].lerp(corners[(first + 1) % 3], along);
                        let origin = origins[random.usize(..origins.len())];
                        Ray::new(origin, target - origin)
                    })
                    .collect();
                let hits = Cpu::new(scene.clone()).cast(parts, Query::Closest, &rays).unwrap();
                hits.iter().filter(|hit| !hit.is_hit()).count()
            })
        };
        let hard = leaks(TriangleKind::MollerTrumbore, 20_000);
        let leaked = leaks(TriangleKind::Watertight, count());
        println!(
            "{name}: {leaked} of {} rays leak; of 20,000 with moller-trumbore {hard}",
            count()
        );
        assert!(hard > 100, "{name}: the rays are not hard");
        assert_eq!(leaked, 0, "{name}");
    }
}
