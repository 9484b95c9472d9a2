//! The builds of the presets.

use super::BuildPreset;
use super::binary::BinaryNode;
use super::items::Items;
use super::octants;
use super::pages::Pages;
use super::place::Place;
use super::reinsertion;
use super::sah::{Effort, Heuristic};
use super::split::centres;
use crate::progress::Progress;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Most reports of progress.
const REPORTS: usize = 200;

/// The nodes over all items and the items' ids by slot.
pub(super) fn build(preset: BuildPreset, mut items: Items, progress: Progress<'_>) -> (Pages<BinaryNode>, Vec<u32>) {
    let total = items.items.len();
    let mut nodes = Pages::<BinaryNode>::zeroed(2 * total - 1);
    let mut order = vec![0; total];
    let finished = AtomicUsize::new(0);
    let report = |triangles: usize| {
        let before = finished.fetch_add(triangles, Ordering::Relaxed);
        let after = before + triangles;
        if before * REPORTS / total < after * REPORTS / total {
            progress("building", after as f32 / total as f32);
        }
    };
    let (root, below) = nodes.split_at_mut(1);
    let place = Place::new(below, &mut order);
    let effort = match preset {
        BuildPreset::Fast => None,
        BuildPreset::Balanced => Some(Effort {
            many: 1 << 13,
            some: 32,
        }),
        BuildPreset::Quality => Some(Effort { many: 64, some: 5 }),
    };
    root[0] = match effort {
        None => octants::build(items, &report, place),
        Some(effort) => {
            let bounds = centres(&items.items);
            let heuristic = Heuristic {
                effort,
                report: &report,
            };
            heuristic.subtree(&mut items.items, bounds, place)
        }
    };
    if preset == BuildPreset::Quality
        && let Some(improved) = reinsertion::improve(&nodes, &order, progress)
    {
        return improved;
    }
    (nodes, order)
}
