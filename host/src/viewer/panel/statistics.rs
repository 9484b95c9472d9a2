//! What was measured, and what there is in memory.

use super::Facts;
use super::fields::Fields;
use super::graph::graph;
use crate::scene::Memory;
use crate::structure::Figures;
use crate::viewer::caption::{digits, grouped};

/// Rows for all of it.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let caption = &facts.caption;
    let number =
        |value: Option<f64>, unit: &str| value.map_or_else(|| "-".into(), |value| format!("{} {unit}", digits(value)));
    let last = facts.figures.history.back();
    fields.table("speed", |fields| {
        fields.text("back end", &caption.backend);
        fields.text("frames", number(caption.frames_a_second, "/s"));
        fields.text("frame", number(last.and_then(|last| last.frame), "ms"));
        fields.text("kernel", number(caption.kernel, "ms"));
        fields.text("camera rays", number(caption.megarays_a_second, "M/s"));
        let kinds = facts.figures.megarays_by_kind();
        fields.text("closest hits", number(kinds.map(|kinds| kinds[0]), "M/s"));
        fields.text("shadow rays", number(kinds.map(|kinds| kinds[1]), "M/s"));
    });
    graph(fields.ui(), &facts.figures.history);
    if let Some(inventory) = facts.inventory {
        structure(fields, &inventory.structure);
        memory(fields, &inventory.memory);
    }
}

fn structure(fields: &mut Fields<'_>, figures: &Figures) {
    fields.heading("structure");
    fields.table("structure", |fields| {
        for (name, count) in [
            ("inner nodes", figures.inner),
            ("leaves", figures.filled),
            ("triangles in leaves", figures.references),
            ("depth", figures.depth as usize),
            ("fullest leaf", figures.fullest as usize),
        ] {
            fields.text(name, grouped(count));
        }
    });
}

fn memory(fields: &mut Fields<'_>, memory: &Memory) {
    fields.heading("memory");
    fields.table("memory", |fields| {
        for (name, bytes) in memory.arrays().into_iter().chain([("all", memory.total())]) {
            fields.text(name, format!("{} B", grouped(bytes)));
        }
    });
}
