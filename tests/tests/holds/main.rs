//! What must hold of the default, with as many rays as one likes: `OKTANT_RAYS=10000000 cargo test --release --workspace
//! --test holds -- --nocapture --test-threads 1` on the CPU, and with `--ignored` on a GPU. docs/stability.md has the figures.

#![cfg(test)]

mod closed;
mod leaving;
mod others;

use glam::Vec3;
use oktant::mesh::Mesh;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use rayon::prelude::*;

/// Rays of each test.
pub fn count() -> usize {
    let wanted = std::env::var("OKTANT_RAYS").ok();
    wanted.map_or(100_000, |count| count.parse().expect("OKTANT_RAYS is a number"))
}

/// Rays that are made and traced at a time.
pub const CHUNK: usize = 1 << 16;

/// Of so many rays, in chunks of which each has random numbers of its own, how many `fails` says fail.
pub fn failing(count: usize, fails: impl Fn(&mut fastrand::Rng, usize) -> usize + Sync) -> usize {
    (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let size = CHUNK.min(count - chunk * CHUNK);
            fails(&mut fastrand::Rng::with_seed(chunk as u64), size)
        })
        .sum()
}

/// A unit vector.
pub fn unit(random: &mut fastrand::Rng) -> Vec3 {
    loop {
        let point = Vec3::from_array([(); 3].map(|()| 2.0 * random.f32() - 1.0));
        if (0.01..=1.0).contains(&point.length_squared()) {
            return point.normalize();
        }
    }
}

/// The mesh with the default structure.
pub fn scene(mesh: &Mesh) -> Scene {
    Scene::new(mesh, &StructureOptions::default(), &silent).unwrap()
}
