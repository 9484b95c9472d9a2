//! Choosing and opening the device.

use super::companion::Companion;
use super::failure::{Failure, Record};
use super::hardship::Hardship;
use super::kernel::Kernel;
use super::kernel_error::KernelError;
use super::kernel_module::{ModulePath, create_module, is_passed_through};
use super::layouts::{Layouts, compute_pipeline};
use super::wakefulness::Wakefulness;
use crate::accident::{Accident, caught_quietly};
use crate::backend::BackendError;
use oktant_shared::variant::Variant;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// A device that went wrong is waited for no longer.
const PATIENCE: Duration = Duration::from_secs(1);

/// Which device to take and how to hand it the kernel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Take a software adapter (lavapipe, WARP) where there is nothing better.
    pub software: bool,
    /// How the kernel reaches the driver.
    pub module: ModulePath,
    /// The kernel to run in the place of the one that is part of the program.
    pub kernel: Option<Arc<Kernel>>,
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
    pub(super) layouts: Arc<Layouts>,
    options: GpuOptions,
    kernel: Arc<Kernel>,
    module: wgpu::ShaderModule,
    companions: [OnceLock<wgpu::ShaderModule>; Companion::ALL.len()],
    pipelines: Mutex<HashMap<&'static str, Arc<wgpu::ComputePipeline>>>,
    pub(super) wakefulness: Wakefulness,
    pub(super) hardship: Arc<Hardship>,
    record: Record,
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
    /// driver refuses, [`BackendError::Failed`] where it cannot compile the kernel; [`BackendError::KernelWithoutGpu`] and
    /// [`BackendError::Kernel`] in the place of the first and the last where the options name a kernel.
    pub fn open(options: &GpuOptions) -> Result<Self, BackendError> {
        let hardship = Arc::new(Hardship::of_environment().map_err(BackendError::NoAdapter)?);
        let instance = Self::instance();
        let adapters = Self::adapters(&instance);
        let found = adapters.len();
        let adapter = adapters
            .into_iter()
            .find(|adapter| {
                options.software || hardship.software || adapter.get_info().device_type != wgpu::DeviceType::Cpu
            })
            .ok_or_else(|| {
                let reason = if found == 0 {
                    "no Vulkan, Metal or Direct3D 12 driver answers".into()
                } else {
                    "only a software adapter".into()
                };
                match options.kernel {
                    Some(_) => BackendError::KernelWithoutGpu(reason),
                    None => BackendError::NoAdapter(reason),
                }
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

        let record = Record::default();
        let mistakes = record.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            mistakes.take(Failure::Mistake(one_line(&error.to_string())));
        }));
        let losses = record.clone();
        device.set_device_lost_callback(move |reason, message| {
            losses.take(Failure::Lost(match reason {
                wgpu::DeviceLostReason::Destroyed => "it was closed".into(),
                wgpu::DeviceLostReason::Unknown => one_line(&message),
            }));
        });

        let passthrough = is_passed_through(&device, info.backend, options.module)
            .map_err(|reason| failed(&name, options, &reason))?;
        let kernel = options.kernel.clone().unwrap_or_else(|| Arc::new(Kernel::built_in()));
        let module = scoped(&device, || {
            create_module(&device, passthrough, &kernel.module, options.kernel.is_none())
        })
        .flatten()
        .map_err(|reason| failed(&name, options, &reason))?;
        let gpu = Gpu {
            name,
            instance,
            adapter,
            passthrough,
            layouts: Arc::new(Layouts::new(&device)),
            device,
            queue,
            options: options.clone(),
            module,
            companions: Default::default(),
            kernel,
            pipelines: Mutex::default(),
            wakefulness: Wakefulness::default(),
            hardship,
            record,
        };
        // The one that most need, so that a driver that cannot is found out now.
        gpu.pipeline(Variant::Plain.entry_point())?;
        Ok(gpu)
    }

    /// The same device with another kernel, and with the pipelines that this one has made so far. This one goes on as
    /// before, whatever comes of it.
    ///
    /// # Errors
    /// [`BackendError::Kernel`] where the driver or naga does not take the kernel or one of the pipelines.
    pub fn with_kernel(&self, kernel: Arc<Kernel>) -> Result<Self, BackendError> {
        let gpu = self.with_probes(kernel)?;
        let entries: Vec<_> = {
            let pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
            pipelines.keys().copied().collect()
        };
        for entry in entries {
            gpu.pipeline(entry)?;
        }
        Ok(gpu)
    }

    /// The same device with a module that may have nothing but probes, and with no pipelines yet.
    ///
    /// # Errors
    /// [`BackendError::Kernel`] where the driver or naga does not take the module.
    pub fn with_probes(&self, kernel: Arc<Kernel>) -> Result<Self, BackendError> {
        let options = GpuOptions {
            kernel: Some(kernel.clone()),
            ..self.options.clone()
        };
        let module = scoped(&self.device, || {
            create_module(&self.device, self.passthrough, &kernel.module, false)
        })
        .flatten()
        .map_err(|reason| failed(&self.name, &options, &reason))?;
        Ok(Gpu {
            name: self.name.clone(),
            instance: self.instance.clone(),
            adapter: self.adapter.clone(),
            device: self.device.clone(),
            queue: self.queue.clone(),
            passthrough: self.passthrough,
            layouts: self.layouts.clone(),
            options,
            module,
            companions: Default::default(),
            kernel,
            pipelines: Mutex::default(),
            wakefulness: Wakefulness::default(),
            hardship: self.hardship.clone(),
            record: self.record.clone(),
        })
    }

    /// Makes something of the kernel on the device.
    ///
    /// # Errors
    /// [`BackendError::Failed`] or [`BackendError::Kernel`] where the device finds something wrong with it.
    pub(crate) fn attempt<T>(&self, work: impl FnOnce() -> T) -> Result<T, BackendError> {
        scoped(&self.device, work).map_err(|reason| self.failed(&reason))
    }

    /// The compiled kernel, for pipelines of one's own; its entry points `present_vertex` and `present_fragment` show a
    /// picture.
    pub fn module(&self) -> &wgpu::ShaderModule {
        &self.module
    }

    /// The module that has an entry point: one beside the kernel's first is handed to the device on first use.
    ///
    /// # Errors
    /// [`BackendError::Failed`] or [`BackendError::Kernel`] where the driver or naga does not take it.
    pub fn module_with(&self, entry: &str) -> Result<&wgpu::ShaderModule, BackendError> {
        let Some((companion, words)) = self.kernel.companion_with(entry) else {
            return Ok(&self.module);
        };
        let place = &self.companions[companion as usize];
        if let Some(module) = place.get() {
            return Ok(module);
        }
        let is_own = self.kernel.path().is_none();
        let module = self.attempt(|| create_module(&self.device, self.passthrough, words, is_own))?;
        let module = module.map_err(|reason| self.failed(&reason))?;
        Ok(place.get_or_init(|| module))
    }

    /// Whether the device is a program that runs on the CPU.
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }

    /// The largest number of bytes that a kernel can see through one binding.
    pub fn binding_limit(&self) -> u64 {
        let limits = self.device.limits();
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        limit.min(self.hardship.binding)
    }

    /// Whether anything has gone wrong since the device was opened.
    ///
    /// # Errors
    /// [`BackendError::Lost`] where the device is lost, else [`BackendError::Failed`] with what went wrong first.
    pub fn check(&self) -> Result<(), BackendError> {
        if matches!(self.record.failure(), Some(Failure::Mistake(_))) {
            self.find_out();
        }
        match self.record.failure() {
            Some(Failure::Mistake(reason)) => Err(self.failed(&reason)),
            Some(Failure::Lost(reason)) => Err(BackendError::Lost {
                adapter: self.name.clone(),
                reason,
            }),
            None => Ok(()),
        }
    }

    /// Waits until the device has done all that was queued.
    ///
    /// # Errors
    /// As [`Gpu::check`].
    pub fn wait(&self) -> Result<(), BackendError> {
        if self.hardship.ends_here() {
            self.lose();
        }
        let polled = self.polled(wgpu::PollType::wait_indefinitely());
        self.check()?;
        polled.map_err(|reason| self.failed(&reason))
    }

    /// As [`Gpu::check`], where the device may have been lost without telling it yet.
    pub(crate) fn check_again(&self) -> Result<(), BackendError> {
        self.find_out();
        self.check()
    }

    /// Lets the device tell that it is lost, if it is: it does so only once all that it was given is over.
    fn find_out(&self) {
        drop(self.polled(wgpu::PollType::Wait {
            submission_index: None,
            timeout: Some(PATIENCE),
        }));
    }

    /// Lets the device tell what it has done. Where that goes wrong, wgpu panics.
    fn polled(&self, how: wgpu::PollType) -> Result<(), String> {
        match caught_quietly(|| self.device.poll(how)) {
            Ok(Ok(_)) => Ok(()),
            Ok(Err(error)) => Err(error.to_string()),
            Err(accident) => Err(accident.to_string()),
        }
    }

    /// Closes the device while others use it, as if it was lost: for tests.
    pub fn lose(&self) {
        self.device.destroy();
    }

    /// That something panicked while it worked, unless that was because the device is lost.
    pub(crate) fn failed_by(&self, accident: &Accident) -> BackendError {
        match self.check_again() {
            Err(error @ BackendError::Lost { .. }) => error,
            _ => self.failed(&format!(
                "by a mistake in oktant or its driver: {accident}; please report it"
            )),
        }
    }

    pub(super) fn failed(&self, reason: &str) -> BackendError {
        failed(&self.name, &self.options, reason)
    }

    pub(super) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// The pipeline of an entry point, made on first use.
    pub(super) fn pipeline(&self, entry: &'static str) -> Result<Arc<wgpu::ComputePipeline>, BackendError> {
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        let pipeline = match pipelines.get(entry) {
            Some(pipeline) => pipeline.clone(),
            None => {
                if self.options.kernel.is_some() {
                    self.kernel.check(entry)?;
                }
                let module = self.module_with(entry)?;
                let made =
                    self.attempt(|| compute_pipeline(&self.device, module, self.layouts.pipeline(entry), entry))?;
                pipelines.entry(entry).or_insert(Arc::new(made)).clone()
            }
        };
        self.check()?;
        Ok(pipeline)
    }
}

/// Does something on a device. What goes wrong meanwhile is returned, and is not held against the device from then on.
fn scoped<T>(device: &wgpu::Device, work: impl FnOnce() -> T) -> Result<T, String> {
    let filters = [
        wgpu::ErrorFilter::OutOfMemory,
        wgpu::ErrorFilter::Internal,
        wgpu::ErrorFilter::Validation,
    ];
    let scopes = filters.map(|filter| device.push_error_scope(filter));
    let result = work();
    // The innermost first.
    let mut error = None;
    for scope in scopes.into_iter().rev() {
        error = error.or(pollster::block_on(scope.pop()));
    }
    match error {
        Some(error) => Err(one_line(&error.to_string())),
        None => Ok(result),
    }
}

/// What went wrong on a device with these options.
fn failed(adapter: &str, options: &GpuOptions, reason: &str) -> BackendError {
    let (adapter, reason) = (adapter.into(), reason.into());
    match options.kernel.as_ref().and_then(|kernel| kernel.path()) {
        Some(path) => BackendError::Kernel(KernelError::Refused {
            path: path.into(),
            adapter,
            reason,
        }),
        None => BackendError::Failed { adapter, reason },
    }
}

fn one_line(message: &str) -> String {
    message
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}
