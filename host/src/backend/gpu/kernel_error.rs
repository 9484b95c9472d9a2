//! Why a kernel from a file cannot be run.

use super::companion::Companion;
use oktant_shared::bindings::BINDINGS;
use std::path::PathBuf;

/// What is wrong with a compiled kernel, in one sentence for whoever compiled it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KernelError {
    /// The module or its manifest cannot be read.
    #[error("{}: this file cannot be read ({reason}); give the .spv file of a compiled kernel.", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// The file does not begin as SPIR-V does.
    #[error(
        "{}: this is not a SPIR-V module; give the .spv file that `cargo run --release -p oktant-kernel-builder` writes.",
        path.display()
    )]
    NotSpirv {
        /// The file.
        path: PathBuf,
    },
    /// It begins as SPIR-V does and goes on otherwise.
    #[error("{}: this SPIR-V module is truncated or damaged ({reason}); compile it again.", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What the parser says.
        reason: String,
    },
    /// Nothing says what the module is.
    #[error(
        "{}: there is no manifest of this kernel; copy the manifest.toml that the builder wrote beside it to {} or {}.",
        path.display(), own.display(), common.display()
    )]
    NoManifest {
        /// The module.
        path: PathBuf,
        /// Where a manifest of its own would be.
        own: PathBuf,
        /// Where the builder writes it.
        common: PathBuf,
    },
    /// The manifest makes no sense.
    #[error("{}: this is not the manifest of a kernel ({reason}); compile the kernel again.", path.display())]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The manifest is about another module.
    #[error(
        "{}: this is not the module that {} describes (its SHA-256 begins with {is}, not with {described}); compile the \
         kernel again, or copy both files.",
        path.display(), manifest.display()
    )]
    Hash {
        /// The module.
        path: PathBuf,
        /// The manifest.
        manifest: PathBuf,
        /// First digits of the module's hash.
        is: String,
        /// First digits of what the manifest has.
        described: String,
    },
    /// It was compiled for something else than Vulkan.
    #[error("{}: this kernel was compiled for {target}; compile it for {wanted}.", path.display())]
    Target {
        /// The module.
        path: PathBuf,
        /// What it was compiled for.
        target: String,
        /// What it should be compiled for.
        wanted: &'static str,
    },
    /// It expects other buffers.
    #[error(
        "{}: this kernel has {}, and this oktant has bindings {BINDINGS}; compile it from sources of this version.",
        path.display(), numbered(*bindings)
    )]
    Bindings {
        /// The module.
        path: PathBuf,
        /// Its number; none where it is older than the numbers.
        bindings: Option<u32>,
    },
    /// Something that is to be launched is not there.
    #[error("{}: this kernel has no entry point `{entry}`; add it to the kernel's sources, or leave --kernel out.", path.display())]
    NoEntryPoint {
        /// The module.
        path: PathBuf,
        /// What is missing.
        entry: &'static str,
    },
    /// Something that is to be launched is not there, and neither is the module that should have it.
    #[error(
        "{}: this kernel has no entry point `{entry}`, and there is no {}; copy that module there, with its manifest, from where \
         the builder wrote it.",
        path.display(), companion.display()
    )]
    NoCompanion {
        /// The module.
        path: PathBuf,
        /// Where the module that has it would be.
        companion: PathBuf,
        /// What is missing.
        entry: &'static str,
    },
    /// It is launched in workgroups of another size.
    #[error(
        "{}: workgroups of the entry point `{entry}` have {} invocations here, and oktant launches {}; change its threads.",
        path.display(), size(*is), size(*wanted)
    )]
    Workgroup {
        /// The module.
        path: PathBuf,
        /// The entry point.
        entry: &'static str,
        /// What it has.
        is: [u32; 3],
        /// What it should have.
        wanted: [u32; 3],
    },
    /// The driver or naga does not take it, or it went wrong.
    #[error("{}: this kernel does not run on {adapter} ({reason}); correct it, or leave --kernel out.", path.display())]
    Refused {
        /// The module.
        path: PathBuf,
        /// Name of the adapter.
        adapter: String,
        /// What went wrong.
        reason: String,
    },
}

impl KernelError {
    /// Whether all can be rendered but lists of pixels, which only adaptive pictures have.
    pub fn is_about_lists(&self) -> bool {
        match self {
            KernelError::NoEntryPoint { entry, .. }
            | KernelError::NoCompanion { entry, .. }
            | KernelError::Workgroup { entry, .. } => Companion::meant_for(entry) == Some(Companion::Lists),
            _ => false,
        }
    }
}

fn numbered(bindings: Option<u32>) -> String {
    match bindings {
        Some(number) => format!("bindings {number}"),
        None => "bindings without a number".into(),
    }
}

fn size([x, y, z]: [u32; 3]) -> String {
    format!("{x} x {y} x {z}")
}
