//! The builds of the presets.

use super::BuildPreset;
use super::binary::BinaryNode;
use super::morton::MortonOrder;
use super::octants;
use super::pages::zeroed;
use super::place::Place;
use super::reinsertion;
use super::sah::{Effort, Heuristic};
use super::split::centres;
use crate::mesh::Mesh;
use crate::progress::Progress;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Most reports of progress.
const REPORTS: usize = 200;

/// Most triangles of a cell that stay together at first.
const CLUSTER: usize = 32;

/// The nodes over all items and the items' ids by slot.
pub(super) fn build(
    preset: BuildPreset,
    sorted: &MortonOrder,
    mesh: &Mesh,
    progress: Progress<'_>,
) -> (Vec<BinaryNode>, Vec<u32>) {
    let mut items = sorted.items(mesh);
    let total = sorted.len();
    let mut nodes: Vec<BinaryNode> = zeroed(2 * total - 1);
    let mut order = zeroed(total);
    let report = reporter(total, progress);
    let (root, below) = nodes.split_at_mut(1);
    let place = Place::new(below, &mut order);
    let effort = match preset {
        BuildPreset::Fast | BuildPreset::Balanced => Effort {
            many: 1 << 13,
            some: 32,
        },
        BuildPreset::Quality => Effort { many: 64, some: 5 },
    };
    let heuristic = |within| Heuristic {
        effort,
        within,
        report: &report,
    };
    root[0] = match preset {
        BuildPreset::Fast => octants::build(sorted, &items, &report, place),
        BuildPreset::Balanced => {
            let mut clusters = sorted.clusters(&mut items, CLUSTER);
            let bounds = centres(&clusters);
            heuristic(Some(&items)).subtree(&mut clusters, bounds, place)
        }
        BuildPreset::Quality => {
            let bounds = centres(&items);
            heuristic(None).subtree(&mut items, bounds, place)
        }
    };
    if preset == BuildPreset::Quality
        && let Some(improved) = reinsertion::improve(&nodes, &order, progress)
    {
        return improved;
    }
    (nodes, order)
}

/// Takes how many more of so many triangles are finished.
pub(super) fn reporter(total: usize, progress: Progress<'_>) -> impl Fn(usize) + Sync {
    let finished = AtomicUsize::new(0);
    move |triangles: usize| {
        let before = finished.fetch_add(triangles, Ordering::Relaxed);
        let after = before + triangles;
        if before * REPORTS / total < after * REPORTS / total {
            progress("building", after as f32 / total as f32);
        }
    }
}
