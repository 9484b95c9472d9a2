//! The compiled kernel and the two ways it can go to a driver.

use super::kernel::KernelModule;
use crate::accident::caught_quietly;
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

/// A module of the compiled kernel as words of SPIR-V, and its manifest.
#[derive(Clone, Debug)]
pub struct CompiledModule {
    /// The module.
    pub words: Vec<u32>,
    /// What the builder wrote about it.
    pub manifest: KernelManifest,
}

/// The modules of the compiled kernel, all of them part of the program: what renders and casts with the default parts, then
/// what renders lists of pixels, then what casts with other parts.
pub fn compiled_kernel() -> [CompiledModule; 3] {
    let files: [(&[u8], &str); 3] = [
        (
            include_bytes!("../../../../kernel/compiled/oktant.spv"),
            include_str!("../../../../kernel/compiled/manifest.toml"),
        ),
        (
            include_bytes!("../../../../kernel/compiled/lists/oktant.spv"),
            include_str!("../../../../kernel/compiled/lists/manifest.toml"),
        ),
        (
            include_bytes!("../../../../kernel/compiled/parts/oktant.spv"),
            include_str!("../../../../kernel/compiled/parts/manifest.toml"),
        ),
    ];
    files.map(|(module, manifest)| CompiledModule {
        words: wgpu::util::make_spirv_raw(module).into_owned(),
        manifest: toml::from_str(manifest).expect("the manifest was written by the builder and is tested"),
    })
}

/// Whether modules can be passed through, and are to be.
pub(super) fn is_passed_through(
    device: &wgpu::Device,
    backend: wgpu::Backend,
    path: ModulePath,
) -> Result<bool, String> {
    let possible = backend == wgpu::Backend::Vulkan && device.features().contains(wgpu::Features::PASSTHROUGH_SHADERS);
    match path {
        ModulePath::Auto => Ok(possible),
        ModulePath::Naga => Ok(false),
        ModulePath::Passthrough if possible => Ok(true),
        ModulePath::Passthrough => Err("it cannot take the kernel unchanged; leave out --spirv".into()),
    }
}

/// Hands a module to a device, `is_own` if it is part of the program.
pub(super) fn create_module(
    device: &wgpu::Device,
    passthrough: bool,
    module: &KernelModule,
    is_own: bool,
) -> Result<wgpu::ShaderModule, String> {
    let words = module.words.clone();
    let module = if passthrough {
        let entry_points = module
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
        if is_own {
            translated()
        } else {
            // naga panics where a module makes no sense in some ways.
            caught_quietly(translated).map_err(|accident| format!("naga does not understand it: {accident}"))?
        }
    };
    Ok(module)
}
