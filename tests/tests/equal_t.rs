//! Of hits at equal `t` the one of the lowest id wins, whatever the structure.

#![cfg(test)]

use glam::Vec3;
use oktant::backend::cpu::Cpu;
use oktant::backend::{Backend, Query};
use oktant::mesh::Mesh;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind, TriangleKind};
use oktant_shared::ray::Ray;
use rayon::prelude::*;
use std::sync::Arc;

/// Triangles between points with whole coordinates of 0 to `reach`, of which many lie in the same planes, in other order and
/// partly on each other.
fn overlapping(random: &mut fastrand::Rng, reach: u32) -> Mesh {
    let triangles = random.u32(2..64);
    let positions = (0..3 * triangles).map(|_| Vec3::from_array([(); 3].map(|()| random.u32(..=reach) as f32)));
    Mesh {
        positions: positions.collect(),
        triangles: (0..triangles).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect(),
        ..Mesh::default()
    }
}

/// From and to any points, or from whole numbers in a direction of whole numbers, of which the largest is a power of two: the
/// rays that lie in a triangle's plane are among these, and f32 computes exactly that they do.
fn ray(random: &mut fastrand::Rng, reach: u32) -> Ray {
    let mut point = || Vec3::from_array([(); 3].map(|()| random.f32() * reach as f32));
    let (origin, target) = (point(), point());
    if random.bool() {
        return Ray::new(origin, target - origin);
    }
    let main = 1 << random.i32(0..4);
    let mut direction = Vec3::from_array([(); 3].map(|()| random.i32(-main..=main) as f32));
    direction[random.usize(..3)] = main as f32 * if random.bool() { 1.0 } else { -1.0 };
    Ray::new(origin.round(), direction)
}

fn cast(mesh: &Mesh, parts: Parts, rays: &[Ray]) -> Option<Vec<Hit>> {
    let options = StructureOptions {
        parts,
        ..StructureOptions::default()
    };
    let scene = Scene::new(mesh, &options, &silent).ok()?;
    Some(Cpu::new(Arc::new(scene)).cast(parts, Query::Closest, rays).unwrap())
}

/// Oracle: the same triangle test on all triangles in turn, where no box and no cell comes in between.
#[test]
fn structures_find_the_triangle_that_trying_all_finds() {
    let watertight = Parts::OFFERED
        .iter()
        .filter(|parts| parts.triangle == TriangleKind::Watertight);
    let all: Vec<Parts> = watertight.copied().collect();
    let none = || vec![0; all.len()];
    let differing = (0..3_000)
        .into_par_iter()
        .map(|seed| {
            let mut random = fastrand::Rng::with_seed(seed);
            let reach = random.u32(1..9);
            let mesh = overlapping(&mut random, reach);
            let rays: Vec<Ray> = (0..256).map(|_| ray(&mut random, reach)).collect();
            let brute = Parts {
                traversal: TraversalKind::Brute,
                ..Parts::default()
            };
            // Of few triangles all may be without area.
            let Some(wanted) = cast(&mesh, brute, &rays) else {
                return none();
            };
            let differing = |parts: &Parts| {
                let found = cast(&mesh, *parts, &rays).unwrap();
                found
                    .iter()
                    .zip(&wanted)
                    .filter(|(found, wanted)| found != wanted)
                    .count()
            };
            all.iter().map(differing).collect()
        })
        .reduce(none, |a, b| {
            a.iter().zip(&b).map(|(a, b)| a + b).collect::<Vec<usize>>()
        });
    for (parts, differing) in all.iter().zip(differing) {
        assert_eq!(differing, 0, "{parts}");
    }
}
