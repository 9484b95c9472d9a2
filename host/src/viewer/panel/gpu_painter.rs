//! Drawing the panel on a GPU.

use super::painting::Painting;
use crate::backend::gpu::Gpu;
use egui::TextureId;
use egui::epaint::ImageDelta;
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use std::collections::HashMap;

/// Pipeline and textures, for surfaces of one format.
pub struct GpuPainter {
    renderer: Renderer,
    /// Which state of each texture is there.
    versions: HashMap<TextureId, u64>,
}

impl GpuPainter {
    /// Makes the pipeline.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let options = RendererOptions {
            dithering: false,
            ..RendererOptions::default()
        };
        GpuPainter {
            renderer: Renderer::new(&gpu.device, format, options),
            versions: HashMap::new(),
        }
    }

    /// Copies to the GPU what is new, before the pass in which it is drawn on a surface of that size.
    pub fn prepare(&mut self, gpu: &Gpu, painting: &Painting, size: [u32; 2], encoder: &mut wgpu::CommandEncoder) {
        let renderer = &mut self.renderer;
        self.versions.retain(|id, _| {
            let is_there = painting.textures.contains_key(id);
            if !is_there {
                renderer.free_texture(id);
            }
            is_there
        });
        for (id, texture) in &painting.textures {
            if self.versions.insert(*id, texture.version) != Some(texture.version) {
                let whole = ImageDelta::full(texture.image.clone(), texture.options);
                renderer.update_texture(&gpu.device, &gpu.queue, *id, &whole);
            }
        }
        let screen = screen(painting, size);
        // Only callbacks have commands of their own, and there are none.
        renderer.update_buffers(&gpu.device, &gpu.queue, encoder, &painting.primitives, &screen);
    }

    /// Draws what was prepared.
    pub fn draw(&self, painting: &Painting, size: [u32; 2], pass: &mut wgpu::RenderPass<'static>) {
        self.renderer
            .render(pass, &painting.primitives, &screen(painting, size));
    }
}

fn screen(painting: &Painting, size: [u32; 2]) -> ScreenDescriptor {
    ScreenDescriptor {
        size_in_pixels: size,
        pixels_per_point: painting.scale,
    }
}
