//! The sets of rays to measure with, against what an independent program made and counted.
#![cfg(test)]

use glam::{UVec2, uvec2};
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::oracle::{Oracle, OracleRay};
use oktant::progress::silent;
use oktant::ray_sets::{RaySet, fitted, outer};
use oktant_tests::data::reference;
use rayon::prelude::*;

fn hits(oracle: &Oracle, set: &RaySet) -> usize {
    let is_hit =
        |ray: &&oktant_shared::ray::Ray| oracle.any(&OracleRay::new(ray.origin, ray.direction, ray.t_min, ray.t_max));
    set.rays.par_iter().filter(is_hit).count()
}

/// The counts of rays and hits of R1 to R4, written down in the peers' results: their generator is another program in
/// another language with another f64 oracle.
fn counts_agree(mesh: &str, size: UVec2, seen: usize, [shadow, mirror, ambient]: [usize; 3]) {
    let mesh: Mesh = MeshSource::File(reference(mesh)).load(&silent).unwrap();
    let oracle = Oracle::new(&mesh);
    let sets = fitted(&mesh, &oracle, size);
    let counts = [0, 1, 2, 3].map(|i| (sets[i].rays.len(), hits(&oracle, &sets[i])));
    let pixels = (size.x * size.y) as usize;
    assert_eq!(
        counts,
        [(pixels, seen), (seen, shadow), (seen, mirror), (seen, ambient)]
    );
}

#[test]
#[ignore = "needs the reference data"]
fn the_bunny_as_the_peers_have_it() {
    counts_agree(
        "meshes/bunny-69k.ply",
        uvec2(1280, 968),
        408_014,
        [149_335, 44_863, 35_977],
    );
    counts_agree(
        "meshes/bunny-69k.ply",
        uvec2(1920, 1080),
        507_885,
        [185_815, 55_918, 44_653],
    );
}

#[test]
#[ignore = "needs the reference data"]
fn the_dragon_as_the_peers_have_it() {
    counts_agree(
        "meshes/dragon-871k.ply",
        uvec2(1280, 968),
        499_602,
        [128_990, 141_157, 100_101],
    );
}

/// Nobody counted these; but each view must see the mesh, and the sets must belong together.
#[test]
fn three_views_of_the_bunny() {
    let mesh = MeshSource::Bunny.load(&silent).unwrap();
    let oracle = Oracle::new(&mesh);
    for (sets, name) in outer(&mesh, &oracle, uvec2(160, 121)).iter().zip(["V1", "V2", "V3"]) {
        assert_eq!(sets[0].view, name);
        let seen = hits(&oracle, &sets[0]);
        assert!((1_500..10_000).contains(&seen), "{name}: {seen}");
        for set in &sets[1..] {
            assert_eq!(set.rays.len(), seen, "{name}");
            let again = hits(&oracle, set);
            assert!((1..seen).contains(&again), "{name} {}: {again}", set.kind.name());
        }
    }
}
