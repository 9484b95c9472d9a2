//! Meshes on which traversals are held against the oracle.

use crate::meshes;
use crate::ray_classes::{CellGrid, RayClass, for_oracle, rays};
use crate::tally::Tally;
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::octree::{Octree, OctreeOptions};
use oktant::oracle::Oracle;
use oktant::oracle::judge::{Answer, Verdict, judge_any, judge_closest};
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::hit::Hit;
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::Ray;
use oktant_shared::traversal::Traversal;
use rayon::prelude::*;

/// A mesh, what the oracle makes of it, and rays for it.
#[derive(Debug)]
pub struct Subject {
    /// What a table calls it.
    pub name: &'static str,
    /// The mesh.
    pub mesh: Mesh,
    /// The octree's cells, at whose corners some rays are aimed.
    cells: CellGrid,
    oracle: Oracle,
}

impl Subject {
    /// Six of them: a scan, shapes that traversals find hard, and a closed one.
    ///
    /// # Panics
    /// If the bunny of the assets cannot be read, or a mesh has no octree.
    pub fn all() -> Vec<Subject> {
        let bunny = MeshSource::Bunny.load(&silent).expect("the asset is a mesh");
        [
            ("bunny", bunny),
            ("fan", meshes::fan_64()),
            ("flat grid", meshes::flat_grid(32)),
            ("soup", meshes::soup(1_000, 1)),
            ("room", meshes::room()),
            ("icosphere", meshes::icosphere(5)),
        ]
        .into_iter()
        .map(|(name, mesh)| {
            let octree = Octree::build(&mesh, &OctreeOptions::default(), &silent).expect("the mesh has an area");
            Subject {
                name,
                cells: CellGrid {
                    low: octree.root.low,
                    size: octree.root.size(),
                    depth: octree.root.depth,
                },
                oracle: Oracle::new(&mesh),
                mesh,
            }
        })
        .collect()
    }

    /// The mesh with the structure of a traversal.
    ///
    /// # Panics
    /// If it cannot be built.
    pub fn scene(&self, traversal: TraversalKind) -> Scene {
        let options = StructureOptions::of(traversal);
        Scene::new(&self.mesh, &options, &silent).expect("the mesh has an area")
    }

    /// Rays of a class, always the same ones.
    pub fn rays(&self, class: RayClass, count: usize) -> Vec<Ray> {
        rays(class, &self.mesh, &self.cells, count, u64::from(class.number()))
    }

    /// The rays with limits of `t` about their hits: half of them end before it, half begin or end behind.
    pub fn limited(&self, rays: &[Ray]) -> Vec<Ray> {
        rays.par_iter()
            .enumerate()
            .map(|(index, ray)| {
                let Some(hit) = self.oracle.closest(&for_oracle(ray)) else {
                    return *ray;
                };
                let t = hit.t as f32;
                match index % 4 {
                    0 => Ray { t_max: t * 0.5, ..*ray },
                    1 => Ray {
                        t_max: t * 0.99,
                        ..*ray
                    },
                    2 => Ray {
                        t_max: t * 1.01,
                        ..*ray
                    },
                    _ => Ray {
                        t_min: t * 1.01,
                        ..*ray
                    },
                }
            })
            .collect()
    }

    /// What the oracle says of a traversal's closest hits, and of its any hits.
    pub fn judge<V: Traversal>(&self, scene: &Scene, rays: &[Ray]) -> [Tally; 2] {
        let view = scene.view();
        [
            self.judge_closest(rays, |index| view.identified(V::closest_hit(&view, &rays[index]))),
            self.judge_any(rays, |index| V::any_hit(&view, &rays[index])),
        ]
    }

    /// What the oracle says of the closest hits of rays, which are asked for by index.
    pub fn judge_closest(&self, rays: &[Ray], closest: impl Fn(usize) -> Hit + Sync + Send) -> Tally {
        tally(rays.len(), |index| {
            let hit = closest(index);
            let answer = hit.is_hit().then(|| Answer {
                triangle: hit.triangle,
                t: f64::from(hit.t),
            });
            judge_closest(&self.oracle, &for_oracle(&rays[index]), answer)
        })
    }

    /// What the oracle says of whether rays hit anything, which is asked for by index.
    pub fn judge_any(&self, rays: &[Ray], any: impl Fn(usize) -> bool + Sync + Send) -> Tally {
        tally(rays.len(), |index| {
            judge_any(&self.oracle, &for_oracle(&rays[index]), any(index))
        })
    }
}

fn tally(count: usize, judge: impl Fn(usize) -> Verdict + Sync + Send) -> Tally {
    (0..count)
        .into_par_iter()
        .map(judge)
        .collect::<Vec<_>>()
        .into_iter()
        .collect()
}
