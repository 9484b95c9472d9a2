//! The failure modes that are a mesh and rays.

mod traversals;
mod triangle_tests;

pub use traversals::TRAVERSALS;
pub use triangle_tests::TRIANGLE_TESTS;

use super::method::Method;
use super::subject::Wanted;
use crate::mesh::Mesh;
use crate::mesh_source::MeshError;
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

fn rays(count: usize, ray: impl FnMut() -> Ray) -> Vec<Ray> {
    std::iter::repeat_with(ray).take(count).collect()
}
