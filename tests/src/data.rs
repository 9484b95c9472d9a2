//! Meshes that are not part of the project.

use std::path::{Path, PathBuf};

/// A file of the reference data: in the folder that the environment variable `OKTANT_DATA` names, else in
/// `shared/data` beside the project. Tests that need one are ignored unless asked for.
///
/// # Panics
/// Where there is none, with a sentence that says what to do.
pub fn reference(name: &str) -> PathBuf {
    let folder = std::env::var_os("OKTANT_DATA").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
        PathBuf::from,
    );
    let path = folder.join(name);
    assert!(
        path.is_file(),
        "{} is missing; set OKTANT_DATA to the folder of the reference data",
        path.display()
    );
    path
}
