//! The failure modes that are a mesh and rays.

mod traversals;
mod triangle_tests;

pub use traversals::TRAVERSALS;
pub use triangle_tests::TRIANGLE_TESTS;

use super::aim::Aim;
use super::meshes::sphere;
use super::method::Method;
use super::subject::Wanted;
use crate::mesh::Mesh;
use crate::mesh_source::MeshError;
use glam::Vec3;
use oktant_shared::ray::Ray;

/// A failure mode.
pub struct Mode {
    /// What a command line calls it.
    pub id: &'static str,
    /// What fails.
    pub title: &'static str,
    /// The mesh and the rays.
    pub input: &'static str,
    /// What is done about it.
    pub remedy: &'static str,
    /// What is asked.
    pub wanted: Wanted,
    /// The mesh.
    pub mesh: fn() -> Result<Mesh, MeshError>,
    /// So many rays for it, or all that there are.
    pub rays: fn(&Mesh, usize) -> Vec<Ray>,
    /// Whether crossings of more triangles than there are to cross are counted.
    pub counts_doubles: bool,
    /// What is shown beside what is offered.
    pub exhibits: &'static [Method],
    /// Names of the methods that must fail.
    pub fails: &'static [&'static str],
}

/// What most rows have: the closed sphere of radius 1, held against the oracle, and nothing doubled.
const ON_SPHERE: Mode = Mode {
    id: "",
    title: "",
    input: "",
    remedy: "",
    wanted: Wanted::Oracle,
    mesh: || Ok(sphere(1.0, Vec3::ZERO)),
    rays: |_, _| Vec::new(),
    counts_doubles: false,
    exhibits: &[],
    fails: &[],
};

/// As before, but all of whose rays must hit, and of whose triangle tests crossings of too many triangles are counted.
const TIGHT: Mode = Mode {
    wanted: Wanted::Hit,
    counts_doubles: true,
    ..ON_SPHERE
};

/// So many rays, always the same ones for a seed.
fn aimed(mesh: &Mesh, count: usize, seed: u64, ray: impl Fn(&mut Aim<'_>) -> Ray) -> Vec<Ray> {
    let mut aim = Aim::new(mesh, seed);
    std::iter::repeat_with(|| ray(&mut aim)).take(count).collect()
}
