//! Which buffers the entry points take.

use super::{LINE, TILE, TILE_HEIGHT};
use wgpu::BindGroupLayout;

/// What the entry points that render begin with.
const RENDER: &str = "render";
/// The entry point that makes the list of a round of adaptive sampling.
pub(super) const CHOOSE: &str = "choose_pixels";

/// The layouts of all bind groups and pipelines; the doc comment of `kernel/src/lib.rs` says what is where.
pub(super) struct Layouts {
    /// Set 0 of the entry points that trace: nodes, references, triangles, ids.
    pub scene: BindGroupLayout,
    /// Set 1 of those: the frame.
    pub frame: BindGroupLayout,
    /// Set 2 of `render` and its like: the picture, the work, the marks, the list and its length.
    pub picture: BindGroupLayout,
    /// Set 2 of `choose_pixels`: the picture, the marks, the list and its length.
    pub choice: BindGroupLayout,
    /// Set 2 of `hits`.
    pub hits: BindGroupLayout,
    /// Set 3 of the entry points that look at pixels: what surfaces look like.
    pub appearance: BindGroupLayout,
    /// Set 2 of the entry points that cast: hits, then rays. Set 0 of the probes with one input.
    pub cast: BindGroupLayout,
    /// Set 0 of the probes with two inputs: results, then the inputs.
    pub probe: BindGroupLayout,
    pixels: wgpu::PipelineLayout,
    choices: wgpu::PipelineLayout,
    pixel_hits: wgpu::PipelineLayout,
    rays: wgpu::PipelineLayout,
    probes_of_one: wgpu::PipelineLayout,
    probes_of_two: wgpu::PipelineLayout,
}

/// A buffer that an entry point reads.
pub const READ: wgpu::BufferBindingType = wgpu::BufferBindingType::Storage { read_only: true };
/// A buffer that an entry point writes.
pub const WRITE: wgpu::BufferBindingType = wgpu::BufferBindingType::Storage { read_only: false };

/// The layout of a bind group of buffers of these kinds, in the order of their bindings.
pub fn group_of_buffers(
    device: &wgpu::Device,
    label: &str,
    visibility: wgpu::ShaderStages,
    kinds: &[wgpu::BufferBindingType],
) -> BindGroupLayout {
    let entries: Vec<_> = kinds
        .iter()
        .zip(0..)
        .map(|(ty, binding)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: wgpu::BindingType::Buffer {
                ty: *ty,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// The pipeline of an entry point that computes. Memory of workgroups is not made zero first: what is read was written before.
pub fn compute_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    entry: &str,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(layout),
        module,
        entry_point: Some(entry),
        compilation_options: wgpu::PipelineCompilationOptions {
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

/// Invocations in a workgroup of an entry point, as the host launches it.
pub fn workgroup(entry: &str) -> [u32; 3] {
    match entry {
        CHOOSE => [TILE, TILE, 1],
        _ if entry == "hits" || entry.starts_with(RENDER) => [TILE, TILE_HEIGHT, 1],
        _ => [LINE, 1, 1],
    }
}

impl Layouts {
    pub fn new(device: &wgpu::Device) -> Self {
        let group = |label, kinds: &[wgpu::BufferBindingType]| {
            group_of_buffers(device, label, wgpu::ShaderStages::COMPUTE, kinds)
        };
        let pipeline = |groups: &[Option<&BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let scene = group("scene", &[READ; 4]);
        let frame = group("frame", &[wgpu::BufferBindingType::Uniform]);
        let picture = group("picture", &[WRITE, WRITE, WRITE, READ, READ]);
        let choice = group("choice", &[WRITE; 4]);
        let hits = group("hits", &[WRITE]);
        let appearance = group("appearance", &[READ; 8]);
        let cast = group("cast", &[WRITE, READ]);
        let probe = group("probe", &[WRITE, READ, READ]);
        Layouts {
            pixels: pipeline(&[Some(&scene), Some(&frame), Some(&picture), Some(&appearance)]),
            choices: pipeline(&[None, Some(&frame), Some(&choice)]),
            pixel_hits: pipeline(&[Some(&scene), Some(&frame), Some(&hits), Some(&appearance)]),
            rays: pipeline(&[Some(&scene), Some(&frame), Some(&cast)]),
            probes_of_one: pipeline(&[Some(&cast)]),
            probes_of_two: pipeline(&[Some(&probe)]),
            scene,
            frame,
            picture,
            choice,
            hits,
            appearance,
            cast,
            probe,
        }
    }

    /// The layout of an entry point's pipeline.
    pub fn pipeline(&self, entry: &str) -> &wgpu::PipelineLayout {
        match entry {
            CHOOSE => &self.choices,
            _ if entry.starts_with(RENDER) => &self.pixels,
            "hits" => &self.pixel_hits,
            "probe_arithmetic" | "probe_color" => &self.probes_of_one,
            _ if entry.starts_with("probe_") => &self.probes_of_two,
            _ => &self.rays,
        }
    }
}
