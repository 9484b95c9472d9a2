//! The octree of tight boxes with boxes that are rounded the wrong way.

use crate::scene::Scene;
use oktant_shared::hit::Hit;
use oktant_shared::octants::{NODE_VECTORS, Octants};
use oktant_shared::ray::Ray;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle_test::Watertight;
use rayon::prelude::*;

/// The closest hits where every face of every box is moved inwards by a step of its node's raster, as if corners had been
/// rounded to the nearest step or towards the box's middle; with ids.
///
/// The scene is one of [`oktant_shared::parts::TraversalKind::Octants`].
pub fn closest_hits(scene: &Scene, rays: &[Ray]) -> Vec<Hit> {
    let mut nodes = scene.nodes.clone();
    for node in nodes.chunks_exact_mut(NODE_VECTORS as usize) {
        for faces in &mut node[2..] {
            let mut words = faces.to_array();
            for (word, inwards) in words.iter_mut().zip([1, 1, -1, -1]) {
                *word = moved(*word, inwards);
            }
            *faces = words.into();
        }
    }
    let view = oktant_shared::scene::Scene {
        nodes: &nodes,
        ..scene.view()
    };
    let closest = |ray| view.identified(Octants::<Watertight>::closest_hit(&view, ray));
    rays.par_iter().map(closest).collect()
}

/// Four faces, a byte each.
fn moved(word: u32, by: i8) -> u32 {
    u32::from_le_bytes(word.to_le_bytes().map(|face| face.saturating_add_signed(by)))
}
