//! How many leaves refer to a triangle.

use crate::scene::Scene;
use oktant_shared::grid::{FIRST_CELL, Raster};
use oktant_shared::octree::Node;
use oktant_shared::parts::TraversalKind;

/// The leaves or cells that refer to each triangle, by its slot. In trees of boxes, and without a structure, that is one.
pub(super) fn references(scene: &Scene) -> Vec<u32> {
    let nodes = match scene.parts.traversal {
        TraversalKind::Octree => 0..2 * scene.nodes.len() as u32,
        TraversalKind::Grid => FIRST_CELL..FIRST_CELL + Raster::of(&scene.nodes).total() as u32,
        TraversalKind::Octants | TraversalKind::Compact | TraversalKind::Bvh2 | TraversalKind::Brute => {
            return vec![1; scene.ids.len()];
        }
    };
    let mut counts = vec![0; scene.ids.len()];
    for node in nodes
        .map(|index| Node::at(&scene.nodes, index))
        .filter(|node| !node.is_inner())
    {
        for slot in &scene.references[node.first as usize..][..node.count as usize] {
            counts[*slot as usize] += 1;
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls;
    use crate::progress::silent;
    use crate::structure::{Figures, StructureOptions};

    #[test]
    fn all_references_of_all_leaves_are_counted() {
        for traversal in TraversalKind::ALL {
            let scene = Scene::new(&balls::balls(), &StructureOptions::of(*traversal), &silent).unwrap();
            let counts = references(&scene);
            let sum: usize = counts.iter().map(|count| *count as usize).sum();
            assert_eq!(sum, Figures::new(*traversal, &scene.nodes).references, "{traversal}");
            let most = counts.iter().max().unwrap();
            let has_duplicates = matches!(traversal, TraversalKind::Octree | TraversalKind::Grid);
            assert_eq!(*most > 1, has_duplicates, "{traversal}: {most}");
        }
    }
}
