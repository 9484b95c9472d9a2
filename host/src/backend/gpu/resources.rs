//! Buffers in the device's memory.

use super::Gpu;
use crate::backend::BackendError;
use crate::scene::Scene;
use bytemuck::NoUninit;
use glam::UVec4;
use oktant_shared::adaptive::Mark;
use oktant_shared::frame::Frame;
use oktant_shared::octree::Root;
use oktant_shared::parts::Parts;
use oktant_shared::plane::Plane;
use std::sync::{Arc, Weak};

/// Bytes that are copied to the device at once.
const PIECE: usize = 64 << 20;

/// A scene in the device's memory.
pub struct GpuScene {
    pub(super) group: wgpu::BindGroup,
    pub(super) appearance: wgpu::BindGroup,
    pub(super) parts: Parts,
    /// The planes once more, for rays that the host casts.
    pub(super) planes: Vec<Plane>,
    pub(super) root: Root,
    /// The entry point that renders it.
    entry: &'static str,
    /// The one that renders the pixels of a list.
    entry_of_lists: &'static str,
    /// Whether it needs one light and one plain material at most.
    pub(super) is_plain: bool,
    /// What a scene in another staging shares with it.
    kept: Box<Kept>,
    /// Bytes of all its buffers.
    pub bytes: u64,
}

/// Buffers that hold what scenes share, and where that lies in the computer's memory.
struct Kept {
    nodes: Weak<Vec<UVec4>>,
    material_ids: Weak<Vec<u32>>,
    vertices: wgpu::Buffer,
    coordinates: wgpu::Buffer,
    ids_of_materials: wgpu::Buffer,
    planes: wgpu::Buffer,
    textures: wgpu::Buffer,
    texels: wgpu::Buffer,
    /// Bytes of the structure's.
    geometry: u64,
}

impl GpuScene {
    /// Whether a scene has the same triangles, in this or another staging.
    pub fn shares(&self, scene: &Scene) -> bool {
        std::ptr::eq(self.kept.nodes.as_ptr(), Arc::as_ptr(&scene.nodes))
    }

    /// The entry point of a pass.
    pub(super) fn entry_for(&self, pass: &Frame) -> &'static str {
        if pass.is_listed == 0 {
            self.entry
        } else {
            self.entry_of_lists
        }
    }
}

/// A picture in the device's memory: for each pixel the weighted sum of its samples' linear RGB, and of the weights.
pub struct GpuPicture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The sums, row by row from the upper left: a storage buffer.
    pub sums: wgpu::Buffer,
    /// What they cost, in the same order; a single one where that is not counted.
    pub(super) work: wgpu::Buffer,
    /// What adaptive sampling knows of them, in the same order; a single one where it is not used.
    pub(super) marks: wgpu::Buffer,
    /// How many pixels its list has.
    pub(super) count: wgpu::Buffer,
    pub(super) group: wgpu::BindGroup,
    /// For the entry point that makes the list.
    pub(super) choice: wgpu::BindGroup,
}

impl GpuPicture {
    /// Whether it can be sampled adaptively.
    pub fn is_adaptive(&self) -> bool {
        self.marks.size() >= u64::from(self.width) * u64::from(self.height) * size_of::<Mark>() as u64
    }
}

impl Gpu {
    /// Copies a scene to the device.
    ///
    /// # Errors
    /// [`BackendError::TooLarge`] where an array exceeds what the device can bind, [`BackendError::OutOfMemory`] where its
    /// memory is full, [`BackendError::Lost`], [`BackendError::Failed`].
    pub fn upload(&self, scene: &Scene) -> Result<GpuScene, BackendError> {
        let nodes = self.input("nodes", &scene.nodes)?;
        let references = self.input("references", &scene.references)?;
        let triangles = self.input("triangles", scene.rows())?;
        let ids = self.input("triangle ids", &scene.ids)?;
        let geometry = [&nodes, &references, &triangles, &ids];
        let kept = Box::new(Kept {
            nodes: Arc::downgrade(&scene.nodes),
            material_ids: Arc::downgrade(&scene.material_ids),
            vertices: self.input("vertices", &scene.vertices)?,
            coordinates: self.input("texture coordinates", &scene.coordinates)?,
            ids_of_materials: self.material_ids(scene)?,
            planes: self.input("planes", &scene.planes)?,
            textures: self.input("textures", &scene.textures)?,
            texels: self.input("texels", &scene.texels)?,
            geometry: geometry.iter().map(|buffer| buffer.size()).sum(),
        });
        let group = self.group(&self.layouts.scene, &geometry);
        self.with_appearance(scene, group, kept)
    }

    /// Copies to the device what a scene has for itself: all else is there, for [`GpuScene::shares`].
    ///
    /// # Errors
    /// As [`Gpu::upload`].
    pub fn restage(&self, scene: &Scene, there: GpuScene) -> Result<GpuScene, BackendError> {
        let GpuScene { group, mut kept, .. } = there;
        if !std::ptr::eq(kept.material_ids.as_ptr(), Arc::as_ptr(&scene.material_ids)) {
            kept.material_ids = Arc::downgrade(&scene.material_ids);
            kept.ids_of_materials = self.material_ids(scene)?;
        }
        self.with_appearance(scene, group, kept)
    }

    fn material_ids(&self, scene: &Scene) -> Result<wgpu::Buffer, BackendError> {
        if scene.parts != Parts::STANDARD && scene.material_ids.len() < scene.ids.len() {
            // The CPU has a body of its own for such a scene.
            return self.input("material ids", &vec![0_u32; scene.ids.len()]);
        }
        self.input("material ids", &scene.material_ids)
    }

    /// A scene of whose buffers all but those for materials and lights are there.
    fn with_appearance(
        &self,
        scene: &Scene,
        group: wgpu::BindGroup,
        kept: Box<Kept>,
    ) -> Result<GpuScene, BackendError> {
        let materials = self.input("materials", &scene.materials)?;
        let lights = self.input("lights", &scene.lights)?;
        let appearance = [
            &kept.vertices,
            &kept.coordinates,
            &kept.ids_of_materials,
            &materials,
            &lights,
            &kept.planes,
            &kept.textures,
            &kept.texels,
        ];
        self.check()?;
        let bytes = kept.geometry + appearance.iter().map(|buffer| buffer.size()).sum::<u64>();
        if bytes > self.hardship.memory {
            return Err(self.out_of_memory("triangles", bytes));
        }
        let (entry, entry_of_lists) = match scene.gpu_variant() {
            Some(variant) => (variant.entry_point(), variant.entry_point_of_lists()),
            None => ("render_general", "render_listed_general"),
        };
        Ok(GpuScene {
            group,
            appearance: self.group(&self.layouts.appearance, &appearance),
            parts: scene.parts,
            planes: scene.planes.clone(),
            root: scene.root,
            entry,
            entry_of_lists,
            is_plain: scene.is_plain(),
            bytes,
            kept,
        })
    }

    /// A picture in which nothing is written yet, to be looked at; `is_adaptive` if it is to be sampled adaptively.
    ///
    /// # Errors
    /// As [`Gpu::upload`].
    pub fn picture(&self, width: u32, height: u32, is_adaptive: bool) -> Result<GpuPicture, BackendError> {
        self.picture_and_work(width, height, 1, is_adaptive)
    }

    /// As [`Gpu::picture`], where also is counted what so many pixels cost.
    ///
    /// # Errors
    /// As [`Gpu::upload`].
    pub(super) fn picture_and_work(
        &self,
        width: u32,
        height: u32,
        counted: u64,
        is_adaptive: bool,
    ) -> Result<GpuPicture, BackendError> {
        let pixels = u64::from(width) * u64::from(height);
        let sums = self.output("pixels", pixels * 16)?;
        let work = self.output("pixels", counted * 16)?;
        let marked = if is_adaptive { pixels } else { 1 };
        let marks = self.output("marks", marked * size_of::<Mark>() as u64)?;
        let list = self.output("listed pixels", marked * 4)?;
        let count = self.output("listed pixels", 4)?;
        let group = self.group(&self.layouts.picture, &[&sums, &work, &marks, &list, &count]);
        let choice = self.group(&self.layouts.choice, &[&sums, &marks, &list, &count]);
        Ok(GpuPicture {
            width,
            height,
            sums,
            work,
            marks,
            count,
            group,
            choice,
        })
    }

    /// Forgets what is known of a picture's pixels, so that it can be sampled adaptively anew.
    pub fn forget(&self, picture: &GpuPicture) {
        let mut encoder = self.encoder();
        encoder.clear_buffer(&picture.marks, 0, None);
        self.queue.submit([encoder.finish()]);
    }

    /// A buffer that kernels read.
    pub(super) fn input<T: NoUninit>(&self, what: &'static str, data: &[T]) -> Result<wgpu::Buffer, BackendError> {
        let bytes = bytemuck::cast_slice(data);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let buffer = self.buffer(what, bytes.len() as u64, usage)?;
        self.fill(&buffer, bytes);
        Ok(buffer)
    }

    /// A buffer that kernels write, filled with zeros.
    pub(super) fn output(&self, what: &'static str, bytes: u64) -> Result<wgpu::Buffer, BackendError> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        self.buffer(what, bytes, usage)
    }

    /// A buffer, if there is room for it.
    fn buffer(&self, what: &'static str, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, BackendError> {
        self.fits(what, bytes)?;
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes,
            usage,
            mapped_at_creation: false,
        });
        match pollster::block_on(scope.pop()) {
            None => Ok(buffer),
            Some(_) => Err(self.out_of_memory(what, bytes)),
        }
    }

    /// That there is no room for so many bytes of something.
    fn out_of_memory(&self, what: &'static str, bytes: u64) -> BackendError {
        BackendError::OutOfMemory {
            what,
            bytes,
            limit: self.binding_limit(),
            adapter: self.name.clone(),
        }
    }

    /// A small buffer with something in it. Where the device is lost it is of no use, which [`Gpu::check`] says later: wgpu's
    /// own function for that panics.
    pub fn filled(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: contents.len() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.fill(&buffer, contents);
        buffer
    }

    /// Copies bytes, a multiple of four, into a buffer, a piece at a time: each takes as much memory once more until it is
    /// there.
    fn fill(&self, buffer: &wgpu::Buffer, bytes: &[u8]) {
        for (piece, number) in bytes.chunks(PIECE).zip(0..) {
            if number > 0 {
                self.queue.submit([]);
            }
            self.queue.write_buffer(buffer, number * PIECE as u64, piece);
        }
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
        let ranges: Vec<_> = buffers
            .iter()
            .map(|buffer| (*buffer, 0, buffer.size() as usize))
            .collect();
        self.group_of_ranges(layout, &ranges)
    }

    /// The same with parts of buffers, from an offset on, of a size, both in bytes.
    pub(super) fn group_of_ranges(
        &self,
        layout: &wgpu::BindGroupLayout,
        ranges: &[(&wgpu::Buffer, usize, usize)],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = ranges
            .iter()
            .zip(0..)
            .map(|((buffer, offset, size), binding)| wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: *offset as u64,
                    size: wgpu::BufferSize::new(*size as u64),
                }),
            })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    pub(super) fn frame_group(&self, frame: &Frame) -> wgpu::BindGroup {
        let uniform = self.filled("frame", bytemuck::bytes_of(frame), wgpu::BufferUsages::UNIFORM);
        self.group(&self.layouts.frame, &[&uniform])
    }
}
