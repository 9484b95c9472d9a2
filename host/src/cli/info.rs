//! `oktant info`.

use super::Failure;
use super::arguments::InfoArguments;
use glam::DVec3;
use oktant::backend::gpu::{Gpu, GpuOptions, compiled_kernel};
use oktant::costs::Costs;
use oktant::scene::{Features, Memory, Scene};
use oktant::structure::{Figures, StructureOptions};
use oktant::tree::BuildPreset;
use oktant_shared::parts::TraversalKind;
use std::fmt::Write;

pub fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let loaded = arguments.mesh.load(&[])?;
    let scene = &loaded.scene;
    let triangles = loaded.triangles.max(1) as f64;
    let statistics = Figures::new(scene.parts.traversal, &scene.nodes);
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        writeln!(text, "{name:<12} {value}").expect("a string can be written to");
    };
    line("mesh", arguments.mesh.source()?.to_string());
    line(
        "triangles",
        format!(
            "{} ({} without area and {} duplicates are left out)",
            loaded.triangles, scene.degenerate, scene.duplicates
        ),
    );
    let colors = if scene.has_colors { "colours" } else { "no colours" };
    line("vertices", format!("{}, {colors}", loaded.vertices));
    line("box", format!("{} to {}", scene.low, scene.high));
    if loaded.shift != DVec3::ZERO {
        line("shift", format!("{} was subtracted from all vertices", loaded.shift));
    }
    let root = &scene.root;
    line(
        "structure",
        format!(
            "{}, {} levels below the root, in a cube of {} at {}",
            scene.parts.traversal,
            statistics.depth,
            root.size(),
            root.low
        ),
    );
    line(
        "nodes",
        format!(
            "{} ({} inner, {} leaves with and {} without references)",
            statistics.inner + statistics.filled + statistics.empty,
            statistics.inner,
            statistics.filled,
            statistics.empty
        ),
    );
    line(
        "references",
        format!(
            "{}, {:.2} per triangle, {} in the fullest leaf",
            statistics.references,
            statistics.references as f64 / triangles,
            statistics.fullest
        ),
    );
    line("leaves", histogram(&statistics));
    if let Some(costs) = cost_model(&arguments.mesh.structure.options()?, &statistics) {
        line("costs", costs);
    }
    let memory = Memory::of(scene);
    let each = |bytes: usize| bytes as f64 / triangles;
    line(
        "bytes",
        format!(
            "{}, {:.1} per triangle, {:.1} of these to trace rays",
            memory.total(),
            each(memory.total()),
            each(memory.traced())
        ),
    );
    line("needs", Features::new(scene, &loaded.view).to_string());
    line("variant", variant(scene));
    let arrays = memory
        .arrays()
        .map(|(name, bytes)| format!("{name} {:.1}", each(bytes)));
    line("arrays", format!("bytes per triangle: {}", arrays.join(", ")));
    line(
        "time",
        format!(
            "{:.1} ms to read, {:.1} ms to build",
            loaded.reading.as_secs_f64() * 1e3,
            loaded.building.as_secs_f64() * 1e3
        ),
    );
    let modules = compiled_kernel();
    let [standard, lists, others] = modules.each_ref().map(|module| {
        format!(
            "{} bytes, {} entry points",
            module.words.len() * 4,
            module.manifest.entry_points.len()
        )
    });
    line(
        "kernel",
        format!(
            "{standard}; for lists of pixels {lists}; for other parts {others}; rust-gpu {}",
            modules[0].manifest.rust_gpu
        ),
    );
    let adapters = Gpu::adapters(&Gpu::instance());
    if adapters.is_empty() {
        line("adapter", "none; the CPU renders".into());
    }
    for adapter in adapters {
        let info = adapter.get_info();
        let kind = match info.device_type {
            wgpu::DeviceType::Cpu => "software, taken only with --backend gpu",
            wgpu::DeviceType::DiscreteGpu => "discrete",
            wgpu::DeviceType::IntegratedGpu => "integrated",
            wgpu::DeviceType::VirtualGpu => "virtual",
            wgpu::DeviceType::Other => "of unknown kind",
        };
        line(
            "adapter",
            format!(
                "{} ({}, {kind}), binds up to {} MiB at once",
                info.name,
                info.backend,
                adapter.limits().max_storage_buffer_binding_size >> 20
            ),
        );
    }
    let opened = Gpu::open(&GpuOptions {
        software: true,
        ..GpuOptions::default()
    });
    if let Ok(gpu) = opened {
        line("arithmetic", format!("{}: {}", gpu.name, gpu.fused_multiply_add()));
    }
    super::print(&text)
}

/// What of the kernel's body renders it.
fn variant(scene: &Scene) -> String {
    let all = "of plain, opaque, mirrors and everything";
    let general = "everything, in the general kernel that other parts than the default ones have";
    match (scene.cpu_variant(), scene.gpu_variant()) {
        (Some(_), Some(variant)) => format!("{variant}, {all}"),
        (Some(variant), None) => format!("on the CPU {variant}, {all}; on a GPU {general}"),
        _ => general.into(),
    }
}

/// What decided where splitting ends, and what it expects.
fn cost_model(options: &StructureOptions, statistics: &Figures) -> Option<String> {
    let counted = |costs: &Costs, shipped: &Costs| {
        let origin = if costs == shipped { "" } else { ", by the profile" };
        format!("a triangle test as {:.2} steps{origin}", costs.triangle / costs.node)
    };
    match options.parts.traversal {
        TraversalKind::Octree => {
            let (steps, tests) = (statistics.expected_steps, statistics.expected_tests);
            let costs = &options.octree.costs;
            let decided = match options.octree.leaf {
                None => format!("split where that pays, counting {}", counted(costs, &Costs::OCTREE)),
                Some(leaf) => format!("split down to {leaf} references, whatever it costs"),
            };
            Some(format!(
                "{decided}; a ray through the cube that nothing ends is expected to take {steps:.1} steps and {tests:.1} \
                 triangle tests, {:.1} steps in all",
                costs.of(steps, tests) / f64::from(costs.node)
            ))
        }
        TraversalKind::Octants if options.preset != BuildPreset::Fast => Some(format!(
            "leaves of as many triangles as pays, counting {}",
            counted(&options.boxes, &Costs::OCTANTS)
        )),
        _ => None,
    }
}

/// Leaves by number of references.
fn histogram(statistics: &Figures) -> String {
    statistics
        .histogram
        .iter()
        .enumerate()
        .map(|(class, leaves)| match class {
            0 => format!("{leaves} with 1 reference"),
            1 => format!("{leaves} with 2"),
            _ => format!("{leaves} with {} to {}", (1 << (class - 1)) + 1, 1 << class),
        })
        .collect::<Vec<_>>()
        .join(", ")
}
