//! Buffers in the device's memory.

use super::Gpu;
use crate::backend::BackendError;
use crate::scene::Scene;
use bytemuck::NoUninit;
use oktant_shared::frame::Frame;
use oktant_shared::octree::Root;
use wgpu::util::DeviceExt;

/// A scene in the device's memory.
pub struct GpuScene {
    pub(super) group: wgpu::BindGroup,
    pub(super) root: Root,
    /// Bytes of all its buffers.
    pub bytes: u64,
}

/// A picture in the device's memory: for each pixel the sum of its samples' linear RGB, and their number.
pub struct GpuPicture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The sums, row by row from the upper left: a storage buffer.
    pub sums: wgpu::Buffer,
    pub(super) group: wgpu::BindGroup,
}

impl Gpu {
    /// Copies a scene to the device.
    ///
    /// # Errors
    /// [`BackendError::TooLarge`] where an array exceeds what the device can bind, [`BackendError::Failed`] where its
    /// memory is full.
    pub fn upload(&self, scene: &Scene) -> Result<GpuScene, BackendError> {
        let nodes = self.input("nodes", &scene.nodes)?;
        let references = self.input("references", &scene.references)?;
        let triangles = self.input("triangles", &scene.triangles)?;
        let vertices = self.input("vertices", &scene.vertices)?;
        let buffers = [&nodes, &references, &triangles, &vertices];
        self.check()?;
        Ok(GpuScene {
            group: self.group(&self.layouts.scene, &buffers),
            root: scene.root,
            bytes: buffers.iter().map(|buffer| buffer.size()).sum(),
        })
    }

    /// A picture in which nothing is written yet.
    ///
    /// # Errors
    /// As [`Gpu::upload`].
    pub fn picture(&self, width: u32, height: u32) -> Result<GpuPicture, BackendError> {
        let sums = self.output("pixels", u64::from(width) * u64::from(height) * 16)?;
        let group = self.group(&self.layouts.picture, &[&sums]);
        Ok(GpuPicture {
            width,
            height,
            sums,
            group,
        })
    }

    /// A buffer that kernels read.
    pub(super) fn input<T: NoUninit>(&self, what: &'static str, data: &[T]) -> Result<wgpu::Buffer, BackendError> {
        self.fits(what, size_of_val(data) as u64)?;
        Ok(self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(what),
            contents: bytemuck::cast_slice(data),
            usage: wgpu::BufferUsages::STORAGE,
        }))
    }

    /// A buffer that kernels write, filled with zeros.
    pub(super) fn output(&self, what: &'static str, bytes: u64) -> Result<wgpu::Buffer, BackendError> {
        self.fits(what, bytes)?;
        Ok(self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        }))
    }

    fn fits(&self, what: &'static str, bytes: u64) -> Result<(), BackendError> {
        let limit = self.binding_limit();
        if bytes > limit {
            return Err(BackendError::TooLarge {
                what,
                bytes,
                limit,
                adapter: self.name.clone(),
            });
        }
        Ok(())
    }

    /// A bind group of whole buffers.
    pub(super) fn group(&self, layout: &wgpu::BindGroupLayout, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries: Vec<_> = buffers
            .iter()
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    pub(super) fn frame_group(&self, frame: &Frame) -> wgpu::BindGroup {
        let uniform = self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("frame"),
            contents: bytemuck::bytes_of(frame),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        self.group(&self.layouts.frame, &[&uniform])
    }
}
