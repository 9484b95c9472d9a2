//! What renders, and what rays are traced through.

use super::Facts;
use super::fields::Fields;
use crate::backend::BackendChoice;
use crate::tree::BuildPreset;
use crate::viewer::adjustment::{Adjustment, KernelAdjustment, box_tests, triangle_tests};
use oktant_shared::parts::{Parts, TraversalKind};

/// Rows for all of it; what is not offered with the rest is not there.
pub fn show(fields: &mut Fields<'_>, facts: &Facts<'_>) {
    let options = facts.session.structure;
    let Parts {
        traversal,
        triangle,
        box_test,
    } = options.parts;
    let of = Adjustment::Kernel;
    fields.table("kernel", |fields| {
        fields.choice(
            "traversal",
            traversal,
            TraversalKind::ALL,
            |kind| kind.to_string(),
            |kind| of(KernelAdjustment::Traversal(kind)),
        );
        fields.choice(
            "triangle",
            triangle,
            &triangle_tests(traversal),
            |kind| kind.to_string(),
            |kind| of(KernelAdjustment::Triangle(kind)),
        );
        if traversal.takes_box_test() {
            fields.choice(
                "box",
                box_test,
                &box_tests(traversal),
                |kind| kind.to_string(),
                |kind| of(KernelAdjustment::Box(kind)),
            );
        }
        if matches!(
            traversal,
            TraversalKind::Octants | TraversalKind::Compact | TraversalKind::Bvh2
        ) {
            fields.choice(
                "build",
                options.preset,
                &BuildPreset::ALL,
                |preset| preset.name().into(),
                |preset| of(KernelAdjustment::Build(preset)),
            );
        }
        let backend = if facts.wants_gpu {
            BackendChoice::Gpu
        } else {
            BackendChoice::Cpu
        };
        fields.choice(
            "backend",
            backend,
            &[BackendChoice::Cpu, BackendChoice::Gpu],
            |choice| if choice == BackendChoice::Gpu { "gpu" } else { "cpu" }.into(),
            |choice| of(KernelAdjustment::Backend(choice)),
        );
    });
}
