//! A mesh, and the rays that everyone traces through it.

use oktant::backend::Query;
use oktant::bench::Truth;
use oktant::mesh::Mesh;
use oktant::oracle::Oracle;
use oktant::ray_sets::{SetKind, outer};
use oktant_shared::ray::Ray;

/// What is traced.
pub struct Course {
    /// What tables call the mesh.
    pub name: String,
    /// The mesh: positions and triangles alone.
    pub mesh: Mesh,
    /// What judges.
    pub oracle: Oracle,
    /// R1 to R4.
    pub sets: Vec<Set>,
}

/// Rays of one kind from all three views, tile by tile.
pub struct Set {
    /// What they are for.
    pub kind: SetKind,
    /// The rays.
    pub rays: Vec<Ray>,
    /// The right answers.
    pub truth: Truth,
}

impl Course {
    /// The sets of [`outer`] for pictures of that size.
    pub fn new(name: String, mesh: Mesh, size: [u32; 2]) -> Self {
        let mesh = Mesh {
            positions: mesh.positions,
            triangles: mesh.triangles,
            ..Mesh::default()
        };
        let oracle = Oracle::new(&mesh);
        let views = outer(&mesh, &oracle, glam::UVec2::from(size));
        let sets = SetKind::ALL.map(|kind| {
            let sets = views.iter().flatten().filter(|set| set.kind == kind);
            let rays: Vec<Ray> = sets.flat_map(|set| set.rays.iter().copied()).collect();
            Set {
                kind,
                truth: Truth::new(&oracle, kind.query(), &rays),
                rays,
            }
        });
        Course {
            name,
            mesh,
            oracle,
            sets: sets.into_iter().filter(|set| !set.rays.is_empty()).collect(),
        }
    }
}

impl Set {
    /// Whether it asks for any hit.
    pub fn is_any(&self) -> bool {
        self.kind.query() == Query::Any
    }
}
