//! Choosing and opening the device.

use super::kernel_module::{ModulePath, create_module};
use super::layouts::Layouts;
use super::resources::PLAIN;
use crate::backend::BackendError;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Which device to take and how to hand it the kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Take a software adapter (lavapipe, WARP) where there is nothing better.
    pub software: bool,
    /// How the kernel reaches the driver.
    pub module: ModulePath,
}

/// An open device with the kernel.
pub struct Gpu {
    /// Adapter, driver and graphics interface, for people.
    pub name: String,
    /// What the adapter was found by; surfaces must come from it.
    pub instance: wgpu::Instance,
    /// The adapter.
    pub adapter: wgpu::Adapter,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Whether the kernel is passed through to the driver unchanged.
    pub passthrough: bool,
    pub(super) layouts: Layouts,
    module: wgpu::ShaderModule,
    pipelines: Mutex<HashMap<&'static str, Arc<wgpu::ComputePipeline>>>,
    failure: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// The instance that all devices of oktant come from: Vulkan where there is it, else Metal or Direct3D 12.
    pub fn instance() -> wgpu::Instance {
        wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::PRIMARY,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        })
    }

    /// All adapters, best first: discrete, integrated, virtual, software.
    pub fn adapters(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        });
        adapters
    }

    /// Opens the best adapter and makes the pipeline that renders.
    ///
    /// # Errors
    /// [`BackendError::NoAdapter`] where there is none that the options admit, [`BackendError::NoDevice`] where the
    /// driver refuses, [`BackendError::Failed`] where it cannot compile the kernel.
    pub fn open(options: &GpuOptions) -> Result<Self, BackendError> {
        let instance = Self::instance();
        let adapters = Self::adapters(&instance);
        let found = adapters.len();
        let adapter = adapters
            .into_iter()
            .find(|adapter| options.software || adapter.get_info().device_type != wgpu::DeviceType::Cpu)
            .ok_or_else(|| {
                BackendError::NoAdapter(if found == 0 {
                    "no Vulkan, Metal or Direct3D 12 driver answers".into()
                } else {
                    "only a software adapter".into()
                })
            })?;
        let info = adapter.get_info();
        let name = format!("{} ({})", info.name, info.backend);
        let supported = adapter.features();
        let optional = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::PASSTHROUGH_SHADERS;
        // The adapter's own limits: the default ones bind no more than 128 MiB.
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("oktant"),
            required_features: supported & optional,
            required_limits: adapter.limits(),
            // SAFETY: the one experimental feature asked for hands over a module that our own tests have run; the
            // kernel's indices are checked by the host before they are uploaded.
            experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
            ..Default::default()
        }))
        .map_err(|error| BackendError::NoDevice {
            adapter: name.clone(),
            reason: error.to_string(),
        })?;

        let failure = Arc::new(Mutex::new(None));
        let remember = {
            let failure = failure.clone();
            move |reason: String| {
                let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
                failure.get_or_insert(reason);
            }
        };
        let on_error = remember.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            on_error(one_line(&error.to_string()))
        }));
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                remember(format!("device lost: {}", one_line(&message)));
            }
        });

        let layouts = Layouts::new(&device);
        let (module, passthrough) =
            create_module(&device, info.backend, options.module).map_err(|reason| BackendError::Failed {
                adapter: name.clone(),
                reason,
            })?;
        let gpu = Gpu {
            name,
            instance,
            adapter,
            device,
            queue,
            passthrough,
            layouts,
            module,
            pipelines: Mutex::default(),
            failure,
        };
        // The one that most need, so that a driver that cannot is found out now.
        gpu.pipeline(PLAIN)?;
        Ok(gpu)
    }

    /// The compiled kernel, for pipelines of one's own; its entry points `present_vertex` and `present_fragment` show a
    /// picture.
    pub fn module(&self) -> &wgpu::ShaderModule {
        &self.module
    }

    /// Whether the device is a program that runs on the CPU.
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }

    /// The largest number of bytes that a kernel can see through one binding.
    pub fn binding_limit(&self) -> u64 {
        let limits = self.device.limits();
        limits.max_storage_buffer_binding_size.min(limits.max_buffer_size)
    }

    /// Whether anything has gone wrong since the device was opened.
    ///
    /// # Errors
    /// [`BackendError::Failed`] with what went wrong first.
    pub fn check(&self) -> Result<(), BackendError> {
        match &*self.failure.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(reason) => Err(self.failed(reason)),
            None => Ok(()),
        }
    }

    /// Waits until the device has done all that was queued.
    ///
    /// # Errors
    /// [`BackendError::Failed`] where it cannot.
    pub fn wait(&self) -> Result<(), BackendError> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        polled.map(|_| ()).map_err(|error| self.failed(&error.to_string()))
    }

    pub(super) fn failed(&self, reason: &str) -> BackendError {
        BackendError::Failed {
            adapter: self.name.clone(),
            reason: reason.into(),
        }
    }

    pub(super) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// The pipeline of an entry point, made on first use.
    pub(super) fn pipeline(&self, entry: &'static str) -> Result<Arc<wgpu::ComputePipeline>, BackendError> {
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        let pipeline = pipelines
            .entry(entry)
            .or_insert_with(|| Arc::new(create_pipeline(&self.device, &self.module, &self.layouts, entry)))
            .clone();
        self.check()?;
        Ok(pipeline)
    }
}

fn create_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layouts: &Layouts,
    entry: &str,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(layouts.pipeline(entry)),
        module,
        entry_point: Some(entry),
        compilation_options: wgpu::PipelineCompilationOptions {
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

fn one_line(message: &str) -> String {
    message
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}
