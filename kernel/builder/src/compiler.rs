//! rust-gpu's compiler: where it is and how it is called.

use std::env;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::error::Error as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use oktant_kernel_builder::{Error, MODULE_FILE, Manifest, entry_points, rust_gpu_version, sha256, source_hash};
use oktant_shared::bindings::BINDINGS;
use spirv_builder::{ShaderPanicStrategy, SpirvBuilder, SpirvMetadata};

/// What the kernel is compiled for.
const TARGET: &str = "spirv-unknown-vulkan1.2";

/// Name under which a toolchain with rust-gpu built in is registered with rustup.
const TOOLCHAIN: &str = "rust-gpu";

/// What else Cargo is told, so that the sources alone determine the module.
///
/// The optimisation level changes the code and debug information brings absolute paths into it, so neither is left to
/// the workspace's profile or to `CARGO_PROFILE_*`. By time stamps, Cargo takes a file that was replaced by an older one
/// for unchanged and would leave a stale module to be described as a fresh one; checksums notice.
const CARGO_FLAGS: &str = "--locked -Zchecksum-freshness \
    --config profile.release.opt-level=3 --config profile.release.debug=false";

/// Gives spirv-builder [`CARGO_FLAGS`] and, unless `keep_flags`, takes from it the other variables that change the module.
///
/// spirv-builder itself clears what an outer Cargo sets: `RUSTFLAGS`, `RUSTUP_TOOLCHAIN`, `CARGO_TARGET_DIR` and so on.
///
/// # Safety
/// No other thread may run: this changes the environment of the process.
pub unsafe fn pin_environment(keep_flags: bool) {
    // SAFETY: the caller sees to it that no other thread reads the environment.
    unsafe {
        env::set_var("RUSTGPU_CARGOFLAGS", CARGO_FLAGS);
        // Incremental compilation cuts the code into other pieces; no profile overrides this variable.
        env::set_var("CARGO_INCREMENTAL", "0");
        if !keep_flags {
            env::remove_var("RUSTGPU_CODEGEN_ARGS");
            env::remove_var("RUSTGPU_RUSTFLAGS");
        }
    }
}

/// A compiler that rust-gpu can work in.
#[derive(Clone, Debug)]
pub struct Compiler {
    toolchain: String,
    codegen: PathBuf,
    version: String,
}

impl Compiler {
    /// The toolchain `rust-gpu` if rustup knows it; else, with the feature `rustup`, the one that rust-gpu's installer
    /// downloads and builds for the crate in `crate_dir`.
    ///
    /// # Errors
    /// [`Error::NoCompiler`] where there is none, [`Error::Toolchain`] where it lacks rust-gpu, [`Error::Install`].
    pub fn find(crate_dir: &Path) -> Result<Self, Error> {
        let Some(sysroot) = rustc(TOOLCHAIN, &["--print", "sysroot"]) else {
            return Self::install(crate_dir);
        };
        let codegen = Path::new(&sysroot)
            .join("lib")
            .join(format!("{DLL_PREFIX}rustc_codegen_spirv{DLL_SUFFIX}"));
        if !codegen.is_file() {
            return Err(Error::Toolchain {
                toolchain: TOOLCHAIN.into(),
                reason: format!("there is no {}", codegen.display()),
            });
        }
        Self::new(TOOLCHAIN.into(), codegen)
    }

    #[cfg(feature = "rustup")]
    fn install(crate_dir: &Path) -> Result<Self, Error> {
        let backend = cargo_gpu_install::install::Install::from_shader_crate(crate_dir.to_path_buf())
            .run()
            .map_err(|error| {
                // rustup has already printed what follows the first line.
                let text = format!("{error:#}");
                let first = text.lines().next().unwrap_or_default();
                Error::Install(first.trim_end_matches(':').to_owned())
            })?;
        Self::new(backend.toolchain_channel, backend.rustc_codegen_spirv_location)
    }

    #[cfg(not(feature = "rustup"))]
    fn install(_crate_dir: &Path) -> Result<Self, Error> {
        Err(Error::NoCompiler)
    }

    fn new(toolchain: String, codegen: PathBuf) -> Result<Self, Error> {
        match rustc(&toolchain, &["--version"]) {
            Some(version) => Ok(Compiler {
                toolchain,
                codegen,
                version,
            }),
            None => Err(Error::Toolchain {
                toolchain,
                reason: "its rustc does not tell its version".into(),
            }),
        }
    }

    /// `rustc --version` of this compiler.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Compiles the crate in `crate_dir` and describes the result. Cargo's messages go to standard error.
    ///
    /// # Errors
    /// [`Error::Compile`] where rust-gpu refuses the crate, and what [`source_hash`] and [`entry_points`] return.
    pub fn compile(&self, crate_dir: &Path) -> Result<(Vec<u8>, Manifest), Error> {
        let sources = source_hash(crate_dir)?;
        let mut builder = SpirvBuilder::new(crate_dir, TARGET);
        builder.toolchain_overwrite = Some(self.toolchain.clone());
        builder.rustc_codegen_spirv_location = Some(self.codegen.clone());
        builder.release = true;
        builder.shader_panic_strategy = ShaderPanicStrategy::SilentExit;
        builder.spirv_metadata = SpirvMetadata::None;
        let built = builder.build().map_err(|error| {
            Error::Compile(match error.source() {
                Some(cause) => format!("{error}: {cause}"),
                None => error.to_string(),
            })
        })?;
        let path = built.module.unwrap_single();
        let module = fs::read(path).map_err(|source| Error::Read {
            path: path.to_path_buf(),
            source,
        })?;
        let manifest = Manifest {
            file: MODULE_FILE.into(),
            sha256: sha256(&module),
            sources,
            target: TARGET.into(),
            bindings: BINDINGS,
            rust_gpu: rust_gpu_version(crate_dir)?,
            rustc: self.version.clone(),
            entry_points: entry_points(&module)?,
        };
        Ok((module, manifest))
    }
}

/// What the toolchain's `rustc` prints, or nothing where there is no such toolchain.
fn rustc(toolchain: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new("rustc")
        .arg(format!("+{toolchain}"))
        .args(arguments)
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success()).then(|| text.trim().to_owned())
}
