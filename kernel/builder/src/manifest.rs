//! The manifest: what the committed module is, and what it was made of.

use std::fs;
use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::{EntryPoint, Error, entry_points, sha256, source_hash};

/// Name of the compiled module in its folder.
pub const MODULE_FILE: &str = "oktant.spv";

/// Name of the manifest in the folder of the module.
pub const MANIFEST_FILE: &str = "manifest.toml";

const HEADER: &str = "# Written by `cargo run --release -p oktant-kernel-builder`: do not edit.\n";

/// Describes a compiled module.
#[derive(Clone, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Name of the module, beside the manifest.
    pub file: String,
    /// SHA-256 of the module, in hexadecimal digits.
    pub sha256: String,
    /// What [`source_hash`] gave for the sources of the module.
    pub sources: String,
    /// The target triple the module was compiled for.
    pub target: String,
    /// [`oktant_shared::bindings::BINDINGS`] of the sources: what the module expects of the host.
    pub bindings: u32,
    /// Version of rust-gpu.
    pub rust_gpu: String,
    /// `rustc --version` of the compiler.
    pub rustc: String,
    /// What the host can launch, sorted by name.
    #[serde(rename = "entry_point")]
    pub entry_points: Vec<EntryPoint>,
}

impl Manifest {
    /// Reads the manifest at `path`.
    ///
    /// # Errors
    /// [`Error::Stale`] where there is none yet, [`Error::Read`] or [`Error::Malformed`] where it cannot be read.
    pub fn read(path: &Path) -> Result<Self, Error> {
        if !path.exists() {
            return Err(Error::Stale(format!("there is no {}", path.display())));
        }
        let text = fs::read_to_string(path).map_err(|source| Error::Read {
            path: path.to_path_buf(),
            source,
        })?;
        toml::from_str(&text).map_err(|error| Error::Malformed {
            path: path.to_path_buf(),
            reason: error.message().to_owned(),
        })
    }

    /// Holds the manifest against the sources of the crate in `crate_dir`.
    ///
    /// # Errors
    /// [`Error::Stale`] where they have changed since the module was compiled, and what [`source_hash`] returns.
    pub fn check_sources(&self, crate_dir: &Path) -> Result<(), Error> {
        let now = source_hash(crate_dir)?;
        if now == self.sources {
            Ok(())
        } else {
            Err(Error::Stale(format!(
                "its sources hash to {} where the manifest has {}",
                short(&now),
                short(&self.sources)
            )))
        }
    }

    /// Holds the manifest against a module: its hash and its entry points.
    ///
    /// # Errors
    /// [`Error::Stale`] where they differ, [`Error::Module`] where `module` is not SPIR-V.
    pub fn check_module(&self, module: &[u8]) -> Result<(), Error> {
        let hash = sha256(module);
        if hash != self.sha256 {
            return Err(Error::Stale(format!(
                "the module's SHA-256 is {} where the manifest has {}",
                short(&hash),
                short(&self.sha256)
            )));
        }
        if entry_points(module)? != self.entry_points {
            return Err(Error::Stale(
                "the manifest does not list the module's entry points".into(),
            ));
        }
        Ok(())
    }

    /// Writes the module and the manifest into the folder `dir`, which is made if needed.
    ///
    /// Each file is written under another name and renamed, so that nobody sees half of one; a file that has the same
    /// content already is left alone, so that Cargo does not compile the host again.
    ///
    /// # Errors
    /// [`Error::Write`] where the folder or a file cannot be written.
    pub fn write(&self, module: &[u8], dir: &Path) -> Result<(), Error> {
        let text = toml::to_string(self).map_err(|error| Error::Malformed {
            path: dir.join(MANIFEST_FILE),
            reason: error.to_string(),
        })?;
        fs::create_dir_all(dir).map_err(|source| Error::Write {
            path: dir.to_path_buf(),
            source,
        })?;
        replace(&dir.join(&self.file), module)?;
        replace(&dir.join(MANIFEST_FILE), format!("{HEADER}{text}").as_bytes())
    }
}

/// The first digits of a hash: enough to tell two apart in a sentence.
fn short(hash: &str) -> &str {
    hash.get(..12).unwrap_or(hash)
}

fn replace(path: &Path, content: &[u8]) -> Result<(), Error> {
    if fs::read(path).is_ok_and(|old| old == content) {
        return Ok(());
    }
    let unwritable = |source| Error::Write {
        path: path.to_path_buf(),
        source,
    };
    let mut builder = tempfile::Builder::new();
    // Temporary files are private by default; these two are for everybody whom the umask lets.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder
        .suffix(".tmp")
        .tempfile_in(path.parent().unwrap_or(Path::new(".")))
        .map_err(unwritable)?;
    file.write_all(content).map_err(unwritable)?;
    file.as_file().sync_all().map_err(unwritable)?;
    file.persist(path).map_err(|error| unwritable(error.error))?;
    Ok(())
}
