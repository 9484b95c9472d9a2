//! The compiled kernel and the two ways it can go to a driver.

use super::kernel::Kernel;
use crate::accident::caught_silently;
use serde::Deserialize;
use std::borrow::Cow;

/// How the kernel reaches the driver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ModulePath {
    /// Passed through where that is possible, which measurement has found faster; else through naga.
    #[default]
    Auto,
    /// Unchanged; Vulkan only.
    Passthrough,
    /// Translated by naga into whatever the driver takes, without checks of its own.
    Naga,
}

/// What the builder wrote about the compiled kernel.
#[derive(Clone, Debug, Deserialize)]
pub struct KernelManifest {
    /// SHA-256 of the module, in hexadecimal digits.
    pub sha256: String,
    /// The target triple the module was compiled for.
    pub target: String,
    /// `BINDINGS` of the module's sources; none where they are older than that.
    pub bindings: Option<u32>,
    /// Version of rust-gpu.
    pub rust_gpu: String,
    /// `rustc --version` of the compiler.
    pub rustc: String,
    /// The entry points.
    #[serde(rename = "entry_point")]
    pub entry_points: Vec<KernelEntryPoint>,
}

/// An entry point of the compiled kernel.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq)]
pub struct KernelEntryPoint {
    /// Its name.
    pub name: String,
    /// Invocations in a workgroup along x, y and z, for a compute shader.
    pub workgroup: Option<[u32; 3]>,
}

/// The compiled kernel as words of SPIR-V, and its manifest; both are part of the program.
pub fn compiled_kernel() -> (Vec<u32>, KernelManifest) {
    let words = wgpu::util::make_spirv_raw(include_bytes!("../../../../kernel/compiled/oktant.spv")).into_owned();
    let manifest = toml::from_str(include_str!("../../../../kernel/compiled/manifest.toml"))
        .expect("the manifest was written by the builder and is tested");
    (words, manifest)
}

/// Hands the kernel to a device; returns also whether it was passed through.
pub(super) fn create_module(
    device: &wgpu::Device,
    backend: wgpu::Backend,
    path: ModulePath,
    kernel: &Kernel,
) -> Result<(wgpu::ShaderModule, bool), String> {
    let possible = backend == wgpu::Backend::Vulkan && device.features().contains(wgpu::Features::PASSTHROUGH_SHADERS);
    let passthrough = match path {
        ModulePath::Auto => possible,
        ModulePath::Naga => false,
        ModulePath::Passthrough if possible => true,
        ModulePath::Passthrough => return Err("it cannot take the kernel unchanged; leave out --spirv".into()),
    };
    let words = kernel.words.clone();
    let module = if passthrough {
        let entry_points = kernel
            .entry_points
            .iter()
            .map(|entry| wgpu::PassthroughShaderEntryPoint {
                name: Cow::Borrowed(&entry.name),
                workgroup_size: entry.workgroup.unwrap_or([1; 3]).into(),
            })
            .collect();
        // SAFETY: the module is the one that was compiled from `kernel` and that the tests run, and the host validates all
        // indices it relies on; or it is one that the person has compiled and asked for, whose parts are theirs.
        unsafe {
            device.create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
                label: Some("oktant"),
                entry_points,
                spirv: Some(Cow::Owned(words)),
                ..Default::default()
            })
        }
    } else {
        // SAFETY: as above; loops end and indices are in range by construction, or that is the person's business.
        let translated = || unsafe {
            device.create_shader_module_trusted(
                wgpu::ShaderModuleDescriptor {
                    label: Some("oktant"),
                    source: wgpu::ShaderSource::SpirV(Cow::Owned(words)),
                },
                wgpu::ShaderRuntimeChecks::unchecked(),
            )
        };
        match kernel.path() {
            None => translated(),
            // naga panics where a module makes no sense in some ways.
            Some(_) => {
                caught_silently(translated).map_err(|accident| format!("naga does not understand it: {accident}"))?
            }
        }
    };
    Ok((module, passthrough))
}
