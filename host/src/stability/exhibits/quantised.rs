//! The octree of tight boxes with boxes that are rounded the wrong way.

use crate::scene::Scene;
use oktant_shared::hit::Hit;
use oktant_shared::octants::{NODE_VECTORS, Octants};
use oktant_shared::ray::Ray;
use oktant_shared::traversal::Traversal;
use oktant_shared::triangle_test::Watertight;
use rayon::prelude::*;

/// The closest hits where every face of every box is moved inwards by a step, as if corners had been
/// rounded to the nearest one or towards the box's middle; with ids.
///
/// The scene is one of [`oktant_shared::parts::TraversalKind::Octants`].
pub fn closest_hits(scene: &Scene, rays: &[Ray]) -> Vec<Hit> {
    let mut nodes = scene.nodes.to_vec();
    for node in nodes.chunks_exact_mut(NODE_VECTORS as usize) {
        // Low faces and high ones in turn.
        for (at, faces) in node[2..].iter_mut().enumerate() {
            let inwards = if at % 2 == 0 { 1 } else { -1 };
            *faces = faces.to_array().map(|word| moved(word, inwards)).into();
        }
    }
    let view = oktant_shared::scene::Scene {
        nodes: &nodes,
        ..scene.view()
    };
    let closest = |ray| view.identified(Octants::<Watertight>::closest_hit(&view, ray));
    rays.par_iter().map(closest).collect()
}

/// Two faces, each the upper half of an f32 that is not negative: the next number has the next bits.
fn moved(word: u32, by: i16) -> u32 {
    let half = |bits: u32| u32::from((bits as u16).saturating_add_signed(by));
    half(word) | half(word >> 16) << 16
}
