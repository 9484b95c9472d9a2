//! A mesh, and the rays that everyone traces through it.

use oktant::backend::Query;
use oktant::bench::Truth;
use oktant::chart::{LEAKS, leak_rays};
use oktant::mesh::Mesh;
use oktant::oracle::Oracle;
use oktant::ray_sets::{RaySet, SetKind, fitted, outer};
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

/// Rays of one kind from all views.
pub struct Set {
    /// What they are for.
    pub kind: SetKind,
    /// The rays.
    pub rays: Vec<Ray>,
    /// The right answers.
    pub truth: Truth,
}

impl Course {
    /// The sets of [`outer`] for pictures of that size, tile by tile, as caches of a CPU like it.
    pub fn outer(name: String, mesh: Mesh, size: [u32; 2]) -> Self {
        Self::new(name, mesh, |mesh, oracle| outer(mesh, oracle, size.into()).into())
    }

    /// The sets of [`fitted`] for a picture of that size, row by row, as a GPU gets them.
    pub fn fitted(name: String, mesh: Mesh, size: [u32; 2]) -> Self {
        Self::new(name, mesh, |mesh, oracle| vec![fitted(mesh, oracle, size.into())])
    }

    /// So many rays at edges and corners of a closed ball, as [`leak_rays`] makes them, for the closest hit: none may miss.
    pub fn leaks(count: usize) -> Self {
        let (mesh, rays) = leak_rays(count);
        let oracle = Oracle::new(&mesh);
        let kind = SetKind::Primary;
        Course {
            name: LEAKS.into(),
            sets: vec![Set {
                kind,
                truth: Truth::new(&oracle, kind.query(), &rays),
                rays,
            }],
            mesh,
            oracle,
        }
    }

    fn new(name: String, mesh: Mesh, views: impl Fn(&Mesh, &Oracle) -> Vec<[RaySet; 4]>) -> Self {
        let mesh = Mesh {
            positions: mesh.positions,
            triangles: mesh.triangles,
            ..Mesh::default()
        };
        let oracle = Oracle::new(&mesh);
        let views = views(&mesh, &oracle);
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

    /// The mesh for someone to keep.
    pub fn own_mesh(&self) -> Mesh {
        // With room for one vertex more, which some libraries want.
        let mut positions = Vec::with_capacity(self.mesh.positions.len() + 1);
        positions.extend_from_slice(&self.mesh.positions);
        Mesh {
            positions,
            triangles: self.mesh.triangles.clone(),
            ..Mesh::default()
        }
    }
}

impl Set {
    /// Whether it asks for any hit.
    pub fn is_any(&self) -> bool {
        self.kind.query() == Query::Any
    }
}
