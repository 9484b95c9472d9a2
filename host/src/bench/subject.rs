//! A mesh with rays whose hits are known.

use super::judgement::Truth;
use crate::mesh::Mesh;
use crate::oracle::Oracle;
use crate::ray_sets::{SetKind, fitted, inner};
use glam::{DVec3, UVec2};
use oktant_shared::ray::Ray;

/// A mesh to measure on.
#[derive(Debug)]
pub struct Subject {
    /// What tables call it.
    pub name: String,
    /// Its triangles, and nothing that they look like: what a structure is built from.
    pub mesh: Mesh,
    /// What judges.
    pub oracle: Oracle,
    /// The rays.
    pub sets: Vec<JudgedSet>,
}

/// A set of rays, and the right answers to them.
#[derive(Debug)]
pub struct JudgedSet {
    /// What the rays are for.
    pub kind: SetKind,
    /// The rays.
    pub rays: Vec<Ray>,
    /// What is right.
    pub truth: Truth,
}

impl Subject {
    /// A mesh with the sets of those kinds, for a picture of `size`: of [`inner`] where the mesh is seen from inside, from
    /// `view[0]` towards `view[1]`; else of [`fitted`]. Sets without a ray are left out.
    pub fn new(name: String, mesh: Mesh, view: Option<[DVec3; 2]>, kinds: &[SetKind], size: UVec2) -> Self {
        let mesh = Mesh {
            positions: mesh.positions,
            triangles: mesh.triangles,
            ..Mesh::default()
        };
        let oracle = Oracle::new(&mesh);
        let sets = match view {
            Some(view) => inner(&mesh, &oracle, view, size),
            None => fitted(&mesh, &oracle, size),
        };
        let sets = sets
            .into_iter()
            .filter(|set| kinds.contains(&set.kind) && !set.rays.is_empty());
        let sets = sets
            .map(|set| JudgedSet {
                kind: set.kind,
                truth: Truth::new(&oracle, set.kind.query(), &set.rays),
                rays: set.rays,
            })
            .collect();
        Subject {
            name,
            mesh,
            oracle,
            sets,
        }
    }
}
