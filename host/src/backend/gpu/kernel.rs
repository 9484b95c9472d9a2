//! A compiled kernel: the one that is part of the program, or one from a file.

use super::companion::Companion;
use super::kernel_error::KernelError;
use super::kernel_module::{KernelEntryPoint, KernelManifest, compiled_kernel};
use super::layouts::{CHOOSE, workgroup};
use oktant_shared::bindings::BINDINGS;
use rspirv::dr::{Module, Operand, load_words};
use rspirv::spirv::{ExecutionMode, ExecutionModel, MAGIC_NUMBER};
use sha2::{Digest, Sha256};
use std::fs;
use std::path::{Path, PathBuf};

/// What a kernel may have been compiled for: the last one is what the builder compiles for, and takes the others in.
const TARGETS: [&str; 3] = [
    "spirv-unknown-vulkan1.0",
    "spirv-unknown-vulkan1.1",
    "spirv-unknown-vulkan1.2",
];

/// Name of the manifest that the builder writes beside a kernel.
const MANIFEST: &str = "manifest.toml";

/// What the host launches or draws with whatever is asked for. The rest may be missing until it is needed.
const ALWAYS_NEEDED: [&str; 7] = [
    "render_plain",
    "render_opaque",
    "render_mirrors",
    "render",
    "render_general",
    CHOOSE,
    "hits",
];
const DRAWS: [(&str, ExecutionModel); 2] = [
    ("present_vertex", ExecutionModel::Vertex),
    ("present_fragment", ExecutionModel::Fragment),
];

/// A module of a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct KernelModule {
    pub words: Vec<u32>,
    pub entry_points: Vec<KernelEntryPoint>,
}

impl KernelModule {
    fn has(&self, entry: &str) -> bool {
        self.entry_points.iter().any(|point| point.name == entry)
    }
}

/// A compiled kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// What renders, shows pictures, and casts rays with the default parts.
    pub(super) module: KernelModule,
    /// What else it has, in the order of [`Companion::ALL`].
    companions: [Option<KernelModule>; Companion::ALL.len()],
    path: Option<PathBuf>,
}

impl Kernel {
    /// The one that is part of the program.
    pub fn built_in() -> Self {
        let [module, lists, parts] = compiled_kernel().map(|module| KernelModule {
            words: module.words,
            entry_points: module.manifest.entry_points,
        });
        Kernel {
            module,
            companions: [Some(lists), Some(parts)],
            path: None,
        }
    }

    /// Reads the kernel in an `.spv` file and holds it against its manifest: the file of the same name that ends in
    /// `.toml`, else `manifest.toml` in the same folder. If beside it there are folders `lists` or `parts` with a file of that
    /// name, these belong to the kernel too: what renders lists of pixels, and what casts rays with other parts than the
    /// default ones.
    ///
    /// # Errors
    /// [`KernelError`], see there.
    pub fn read(path: &Path) -> Result<Self, KernelError> {
        let (module, parsed) = open(path)?;
        for (entry, model) in DRAWS {
            if !entries(&parsed).any(|(of, name, _)| name == entry && of == model) {
                return Err(KernelError::NoEntryPoint {
                    path: path.into(),
                    entry,
                });
            }
        }
        let mut companions = [const { None }; Companion::ALL.len()];
        for (place, companion) in companions.iter_mut().zip(Companion::ALL) {
            let file = companion.beside(path);
            if file.exists() {
                *place = Some(open(&file)?.0);
            }
        }
        let kernel = Kernel {
            module,
            companions,
            path: Some(path.into()),
        };
        ALWAYS_NEEDED.iter().try_for_each(|entry| kernel.check(entry))?;
        Ok(kernel)
    }

    /// The same of a module that neither renders nor shows anything: for [`super::Gpu::with_probes`].
    ///
    /// # Errors
    /// As [`Kernel::read`].
    pub fn read_probes(path: &Path) -> Result<Self, KernelError> {
        let (module, _) = open(path)?;
        Ok(Kernel {
            module,
            companions: [const { None }; Companion::ALL.len()],
            path: Some(path.into()),
        })
    }

    /// The file it was read from; none of the one that is part of the program.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The files that [`Kernel::read`] looks at, there or not.
    pub fn files(path: &Path) -> Vec<PathBuf> {
        let companions = Companion::ALL.map(|companion| companion.beside(path));
        let modules = companions.iter().map(PathBuf::as_path).chain([path]);
        let files = modules.map(|module| {
            let [own, common] = manifests(module);
            [module.into(), own, common]
        });
        files.flatten().collect()
    }

    /// The companion that has this entry point, where one has it.
    pub(super) fn companion_with(&self, entry: &str) -> Option<(Companion, &KernelModule)> {
        let mut companions = Companion::ALL.into_iter().zip(&self.companions);
        companions.find_map(|(companion, module)| {
            let module = module.as_ref().filter(|module| module.has(entry))?;
            Some((companion, module))
        })
    }

    /// Whether it has this entry point, in workgroups of the size that the host launches.
    ///
    /// # Errors
    /// [`KernelError::NoEntryPoint`], [`KernelError::NoCompanion`] and [`KernelError::Workgroup`].
    pub(super) fn check(&self, entry: &'static str) -> Result<(), KernelError> {
        let path = self.path.clone().unwrap_or_default();
        let (path, module) = match (self.companion_with(entry), Companion::meant_for(entry)) {
            (Some((companion, module)), _) => (companion.beside(&path), module),
            (None, Some(meant)) if !self.module.has(entry) => {
                let companion = meant.beside(&path);
                match &self.companions[meant as usize] {
                    Some(module) => (companion, module),
                    None => return Err(KernelError::NoCompanion { path, companion, entry }),
                }
            }
            (None, _) => (path, &self.module),
        };
        let found = module.entry_points.iter().find(|found| found.name == entry);
        let wanted = workgroup(entry);
        match found.and_then(|found| found.workgroup) {
            None => Err(KernelError::NoEntryPoint { path, entry }),
            Some(is) if is != wanted => Err(KernelError::Workgroup {
                path,
                entry,
                is,
                wanted,
            }),
            Some(_) => Ok(()),
        }
    }
}

/// Reads a module, whatever is in it.
fn open(path: &Path) -> Result<(KernelModule, Module), KernelError> {
    let bytes = read(path)?;
    let words: Vec<u32> = bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect();
    if words.first() != Some(&MAGIC_NUMBER) {
        return Err(KernelError::NotSpirv { path: path.into() });
    }
    let damaged = |reason: String| KernelError::Damaged {
        path: path.into(),
        reason,
    };
    if bytes.len() % 4 != 0 {
        return Err(damaged(format!("{} bytes are no whole words", bytes.len())));
    }
    let module = load_words(&words).map_err(|error| damaged(error.to_string()))?;
    check_manifest(path, &bytes)?;
    let entry_points = entries(&module)
        .map(|(model, name, function)| KernelEntryPoint {
            name: name.into(),
            workgroup: (model == ExecutionModel::GLCompute)
                .then(|| local_size(&module, function))
                .flatten(),
        })
        .collect();
    Ok((KernelModule { words, entry_points }, module))
}

fn read(path: &Path) -> Result<Vec<u8>, KernelError> {
    fs::read(path).map_err(|error| KernelError::Read {
        path: path.into(),
        reason: error.to_string(),
    })
}

/// Where the manifest of a kernel may be, in this order.
fn manifests(path: &Path) -> [PathBuf; 2] {
    [path.with_extension("toml"), path.with_file_name(MANIFEST)]
}

/// Holds a kernel against its manifest.
fn check_manifest(path: &Path, bytes: &[u8]) -> Result<(), KernelError> {
    let [own, common] = manifests(path);
    let Some(place) = [&own, &common].into_iter().find(|place| place.exists()) else {
        return Err(KernelError::NoManifest {
            path: path.into(),
            own,
            common,
        });
    };
    let malformed = |reason: String| KernelError::Manifest {
        path: place.clone(),
        reason,
    };
    let text = String::from_utf8(read(place)?).map_err(|_| malformed("it is not text".into()))?;
    let manifest: KernelManifest =
        toml::from_str(&text).map_err(|error| malformed(error.message().lines().collect::<Vec<_>>().join(" ")))?;
    let hash: String = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    if manifest.sha256 != hash {
        let first = |hash: &str| hash.chars().take(12).collect();
        return Err(KernelError::Hash {
            path: path.into(),
            manifest: place.clone(),
            is: first(&hash),
            described: first(&manifest.sha256),
        });
    }
    if !TARGETS.contains(&manifest.target.as_str()) {
        return Err(KernelError::Target {
            path: path.into(),
            target: manifest.target,
            wanted: TARGETS[TARGETS.len() - 1],
        });
    }
    if manifest.bindings != Some(BINDINGS) {
        return Err(KernelError::Bindings {
            path: path.into(),
            bindings: manifest.bindings,
        });
    }
    Ok(())
}

/// The entry points of a module: execution model, name and function.
fn entries(module: &Module) -> impl Iterator<Item = (ExecutionModel, &str, u32)> {
    module
        .entry_points
        .iter()
        .filter_map(|entry| match entry.operands.as_slice() {
            [
                Operand::ExecutionModel(model),
                Operand::IdRef(function),
                Operand::LiteralString(name),
                ..,
            ] => Some((*model, name.as_str(), *function)),
            _ => None,
        })
}

/// Invocations in a workgroup of an entry point, if it says so.
fn local_size(module: &Module, function: u32) -> Option<[u32; 3]> {
    module
        .execution_modes
        .iter()
        .find_map(|mode| match mode.operands.as_slice() {
            [
                Operand::IdRef(of),
                Operand::ExecutionMode(ExecutionMode::LocalSize),
                Operand::LiteralBit32(x),
                Operand::LiteralBit32(y),
                Operand::LiteralBit32(z),
            ] if *of == function => Some([*x, *y, *z]),
            _ => None,
        })
}
