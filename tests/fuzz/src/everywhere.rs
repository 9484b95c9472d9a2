//! Rays through all structures of a mesh, with all parts that are offered.

use oktant::backend::cpu::Cpu;
use oktant::backend::{Backend, Query};
use oktant::mesh::Mesh;
use oktant::progress::silent;
use oktant::scene::{Scene, SceneError};
use oktant::structure::StructureOptions;
use oktant_shared::hit::Hit;
use oktant_shared::parts::{Parts, TraversalKind};
use oktant_shared::ray::Ray;
use std::sync::Arc;

/// A structure has at most so many references, in parts of the triangles: the largest of the default budgets.
const BUDGET: usize = 32;

/// Builds the structures of a mesh and hands `judge` what each combination of parts finds: the closest hits, and whether
/// there are any.
///
/// # Errors
/// [`SceneError`] where the mesh cannot be built from.
///
/// # Panics
/// Where a structure is larger than its budget.
pub fn cast_everywhere(
    mesh: &Mesh,
    options: &StructureOptions,
    rays: &[Ray],
    mut judge: impl FnMut(Parts, &[Hit], &[bool]),
) -> Result<(), SceneError> {
    for traversal in TraversalKind::ALL.iter().copied() {
        let options = StructureOptions {
            parts: Parts {
                traversal,
                ..Parts::default()
            },
            ..*options
        };
        let scene = Scene::new(mesh, &options, &silent)?;
        assert!(scene.references.len() <= BUDGET * mesh.triangles.len(), "{traversal}");
        let mut cpu = Cpu::new(Arc::new(scene));
        for parts in Parts::OFFERED
            .iter()
            .copied()
            .filter(|parts| parts.traversal == traversal)
        {
            let mut cast = |query| {
                let hits = cpu.cast(parts, query, rays);
                hits.unwrap_or_else(|error| panic!("{parts}: {error}"))
            };
            let closest = cast(Query::Closest);
            let any: Vec<bool> = cast(Query::Any).iter().map(Hit::is_hit).collect();
            judge(parts, &closest, &any);
        }
    }
    Ok(())
}
