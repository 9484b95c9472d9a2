//! Compiles oktant's kernel to SPIR-V with rust-gpu and keeps the compiled module honest.
//!
//! The module is committed beside a [`Manifest`], so that the host builds and runs on stable Rust without rust-gpu.
//! [`source_hash`] says whether the module still belongs to the sources; the binary of this crate makes a new one.

mod error;
mod manifest;
mod module;
mod sources;
mod workspace;

pub use error::Error;
pub use manifest::{MANIFEST_FILE, MODULE_FILE, Manifest};
pub use module::{EntryPoint, disassemble, entry_points, sha256};
pub use sources::source_hash;
pub use workspace::rust_gpu_version;
