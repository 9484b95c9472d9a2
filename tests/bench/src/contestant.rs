//! Who takes part.

use oktant::mesh::Mesh;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;

/// A tracer with its structure over a mesh.
///
/// Each gets the same vertices, triangles and rays, and writes a hit or a byte a ray into the same memory.
pub trait Contestant: Send + Sync {
    /// Closest hits, the triangle by its place in the mesh; `t` and `triangle` count.
    fn closest(&self, rays: &[Ray], hits: &mut [Hit]);

    /// Whether rays hit anything: 1 or 0.
    fn any(&self, rays: &[Ray], found: &mut [bool]);

    /// Bytes of nodes, references and triangles that tracing reads; none where the library does not tell.
    fn bytes(&self) -> Option<usize>;
}

/// A contestant that can be built, again and again.
pub struct Entry {
    /// What tables call it.
    pub name: &'static str,
    /// Whether it is ours, and must not miss.
    pub is_ours: bool,
    /// Builds it.
    pub build: Build,
}

/// Builds a contestant from vertices and triangles that are its own to keep, with the threads of rayon's current pool; what
/// does not build on rayon is given their number.
pub type Build = fn(Mesh, usize) -> Result<Box<dyn Contestant>, Failure>;

/// Why a contestant could not be built.
#[derive(Debug, thiserror::Error)]
#[error("{who} cannot be built ({reason}); give another mesh.")]
pub struct Failure {
    /// The contestant.
    pub who: &'static str,
    /// What it says.
    pub reason: String,
}

/// The corners of a mesh's triangles.
pub fn corners(mesh: &Mesh) -> impl Iterator<Item = [[f32; 3]; 3]> + '_ {
    let position = |i: u32| mesh.positions[i as usize].to_array();
    mesh.triangles.iter().map(move |triangle| triangle.map(position))
}

/// A hit of which only these count.
pub fn hit(t: f32, triangle: u32) -> Hit {
    Hit {
        t,
        triangle,
        u: 0.0,
        v: 0.0,
    }
}
