//! What can go wrong, each in one sentence for whoever runs the builder.

use std::io;
use std::path::PathBuf;

/// Everything that the builder reports; the text says what to do.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file or folder that has to be there cannot be read.
    #[error("Cannot read {}: {source}.", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The module or its manifest cannot be written.
    #[error("Cannot write {}: {source}.", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A `Cargo.toml`, a `Cargo.lock` or a manifest is not what it should be.
    #[error("Cannot understand {}: {reason}.", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, without a full stop.
        reason: String,
    },
    /// The bytes are not a SPIR-V module.
    #[error("The compiled module is not SPIR-V that can be read: {0}.")]
    Module(String),
    /// The committed module does not belong to the sources, the manifest or the compiler's output.
    #[error(
        "The compiled kernel is out of date: {0}; run `cargo run --release -p oktant-kernel-builder` and commit what it writes."
    )]
    Stale(String),
    /// There is no compiler for SPIR-V on this machine.
    #[error(
        "rust-gpu's compiler is not installed: run `cargo run --release -p oktant-kernel-builder --features rustup`, which \
         lets rustup download it, or register a toolchain that has it with `rustup toolchain link rust-gpu DIR`."
    )]
    NoCompiler,
    /// The toolchain is registered, but is not what this builder knows how to call.
    #[error("The toolchain `{toolchain}` cannot be used: {reason}.")]
    Toolchain {
        /// Its name in rustup.
        toolchain: String,
        /// What is wrong with it, without a full stop.
        reason: String,
    },
    /// rust-gpu's own installer failed.
    #[error("rust-gpu's compiler could not be installed: {0}.")]
    Install(String),
    /// rust-gpu did not accept the kernel; Cargo has printed why.
    #[error("rust-gpu could not compile the kernel: {0}.")]
    Compile(String),
}
