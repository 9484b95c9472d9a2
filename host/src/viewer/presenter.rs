//! Drawing a picture from the GPU's memory onto a surface, without a trip over the CPU.

use super::layers::Layers;
use super::panel::GpuPainter;
use crate::backend::gpu::{Gpu, READ, group_of_buffers};

/// The pipeline of the entry points `present_vertex` and `present_fragment`, for surfaces of one format.
pub struct Presenter {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl Presenter {
    /// Makes the pipeline.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let kinds = [READ, READ, wgpu::BufferBindingType::Uniform];
        let layout = group_of_buffers(&gpu.device, "present", wgpu::ShaderStages::FRAGMENT, &kinds);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("present"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("present"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: gpu.module(),
                entry_point: Some("present_vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: gpu.module(),
                entry_point: Some("present_fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Presenter { pipeline, layout }
    }

    /// Draws a picture, given by its sums and size, and what lies over it onto all of a texture, given with its size, and
    /// submits that. The panel is drawn where there is a painter for it.
    pub fn draw(
        &self,
        gpu: &Gpu,
        (target, target_size): (&wgpu::TextureView, [u32; 2]),
        (sums, picture_size): (&wgpu::Buffer, [u32; 2]),
        layers: &Layers<'_>,
        painter: Option<&mut GpuPainter>,
    ) {
        let overlay = layers.overlay;
        // A buffer must not be empty, even where nobody reads it.
        let texels: &[u32] = if overlay.texels.is_empty() {
            &[0]
        } else {
            &overlay.texels
        };
        let texels = gpu.filled("overlay", bytemuck::cast_slice(texels), wgpu::BufferUsages::STORAGE);
        let uniform = layers.showing.present(picture_size, overlay, target_size);
        let uniform = gpu.filled("present", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let entries: Vec<_> = [sums, &texels, &uniform]
            .into_iter()
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("present"),
            layout: &self.layout,
            entries: &entries,
        });
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut panel = painter.zip(layers.panel);
        if let Some((painter, painting)) = &mut panel {
            painter.prepare(gpu, painting, target_size, &mut encoder);
        }
        {
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("present"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            // The encoder is used again only after the pass.
            let mut pass = pass.forget_lifetime();
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..3, 0..1);
            if let Some((painter, painting)) = panel {
                painter.draw(painting, target_size, &mut pass);
            }
        }
        gpu.queue.submit([encoder.finish()]);
    }
}
