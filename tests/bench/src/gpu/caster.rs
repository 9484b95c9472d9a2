//! Kernels that cast rays, in the bindings of oktant's.

use super::arrays::Arrays;
use super::entries::Kernel;
use super::for_naga::for_naga;
use bytemuck::{NoUninit, Zeroable, cast_slice};
use oktant::backend::BackendError;
use oktant::backend::gpu::{Gpu, READ, WRITE, compute_pipeline, group_of_buffers};
use oktant_shared::frame::Frame;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use std::borrow::Cow;
use std::mem::offset_of;
use wgpu::util::DeviceExt;

/// Invocations in a workgroup, and workgroups in a row of a dispatch.
const LINE: u32 = 64;
const LINES_PER_ROW: u32 = 32_768;

/// The shaders count on it.
const _: () = assert!(offset_of!(Frame, root) == 80);

/// Makes what it takes to cast rays on a device.
pub struct Caster<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    scene: wgpu::BindGroupLayout,
    frame: wgpu::BindGroupLayout,
    cast: wgpu::BindGroupLayout,
    pipeline: wgpu::PipelineLayout,
}

/// A structure in the device's memory: what rays meet, and the box around it.
pub struct Uploaded([wgpu::BindGroup; 2]);

/// Rays in the device's memory, and the place for their hits.
pub struct GpuRays {
    group: wgpu::BindGroup,
    hits: wgpu::Buffer,
    workgroups: u32,
}

impl<'a> Caster<'a> {
    /// On that device.
    pub fn new(gpu: &'a Gpu) -> Self {
        let layout = |kinds: &[wgpu::BufferBindingType]| {
            group_of_buffers(&gpu.device, "race", wgpu::ShaderStages::COMPUTE, kinds)
        };
        let scene = layout(&[READ; 4]);
        let frame = layout(&[wgpu::BufferBindingType::Uniform]);
        let cast = layout(&[WRITE, READ]);
        let pipeline = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&scene), Some(&frame), Some(&cast)],
            immediate_size: 0,
        });
        Caster {
            gpu,
            scene,
            frame,
            cast,
            pipeline,
        }
    }

    /// The pipelines of a kernel for closest and any hits. Modules go to the driver the way oktant's kernel goes.
    ///
    /// # Errors
    /// Where the device does not take it.
    pub fn pipelines(&self, kernel: Kernel) -> Result<[wgpu::ComputePipeline; 2], BackendError> {
        let pipelines = match kernel {
            Kernel::Oktant([closest, any]) => [
                self.pipeline(self.gpu.module_with(closest)?, closest),
                self.pipeline(self.gpu.module_with(any)?, any),
            ],
            Kernel::Modules([closest, any]) => [
                self.pipeline(&self.module(closest)?, "main"),
                self.pipeline(&self.module(any)?, "main"),
            ],
        };
        self.gpu.check()?;
        Ok(pipelines)
    }

    fn module(&self, spirv: &[u8]) -> Result<wgpu::ShaderModule, BackendError> {
        let words = wgpu::util::make_spirv_raw(spirv);
        Ok(if self.gpu.passthrough {
            let entry_point = wgpu::PassthroughShaderEntryPoint {
                name: Cow::Borrowed("main"),
                workgroup_size: (LINE, 1, 1),
            };
            // SAFETY: the module is one of ours, and its indices come from structures that were built for it.
            unsafe {
                self.gpu
                    .device
                    .create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
                        label: None,
                        entry_points: Cow::Owned(vec![entry_point]),
                        spirv: Some(words),
                        ..Default::default()
                    })
            }
        } else {
            let words = for_naga(&words).map_err(|reason| BackendError::Failed {
                adapter: self.gpu.name.clone(),
                reason,
            })?;
            let descriptor = wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::SpirV(Cow::Owned(words)),
            };
            // SAFETY: as above; its loops end.
            unsafe {
                self.gpu
                    .device
                    .create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked())
            }
        })
    }

    fn pipeline(&self, module: &wgpu::ShaderModule, entry: &str) -> wgpu::ComputePipeline {
        compute_pipeline(&self.gpu.device, module, &self.pipeline, entry)
    }

    /// Copies a structure to the device.
    ///
    /// # Errors
    /// Where an array is too large for it.
    pub fn upload(&self, arrays: &Arrays) -> Result<Uploaded, BackendError> {
        let frame = Frame {
            root: arrays.root,
            ..Frame::zeroed()
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let buffers = [
            self.buffer(&arrays.nodes, storage),
            // References: none of these structures has any, and a buffer is never empty.
            self.buffer(&[0_u32], storage),
            self.buffer(&arrays.triangles, storage),
            self.buffer(&arrays.ids, storage),
        ];
        let frame = self.buffer(&[frame], wgpu::BufferUsages::UNIFORM);
        let groups = [
            self.group(&self.scene, &buffers.each_ref()),
            self.group(&self.frame, &[&frame]),
        ];
        self.gpu.check()?;
        Ok(Uploaded(groups))
    }

    /// Copies rays to the device.
    ///
    /// # Errors
    /// Where they are too many for it.
    pub fn rays(&self, rays: &[Ray]) -> Result<GpuRays, BackendError> {
        let hits = self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: (rays.len() * size_of::<Hit>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let input = self.buffer(rays, wgpu::BufferUsages::STORAGE);
        let group = self.group(&self.cast, &[&hits, &input]);
        self.gpu.check()?;
        Ok(GpuRays {
            group,
            hits,
            workgroups: (rays.len() as u32).div_ceil(LINE),
        })
    }

    fn buffer<T: NoUninit>(&self, data: &[T], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: cast_slice(data),
            usage,
        })
    }

    fn group(&self, layout: &wgpu::BindGroupLayout, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }
}

impl GpuRays {
    /// Casts them so many times over, one after the other.
    pub fn cast(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: &wgpu::ComputePipeline,
        Uploaded([scene, frame]): &Uploaded,
        times: u32,
    ) {
        pass.set_pipeline(pipeline);
        for (index, group) in (0..).zip([scene, frame, &self.group]) {
            pass.set_bind_group(index, group, &[]);
        }
        for _ in 0..times {
            pass.dispatch_workgroups(
                self.workgroups.min(LINES_PER_ROW),
                self.workgroups.div_ceil(LINES_PER_ROW),
                1,
            );
        }
    }

    /// What came of it.
    pub fn hits(&self) -> &wgpu::Buffer {
        &self.hits
    }
}
