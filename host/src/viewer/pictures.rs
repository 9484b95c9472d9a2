//! Names of saved pictures.

use std::path::{Path, PathBuf};

/// The first of `oktant-0001.png`, `oktant-0002.png` and so on that does not exist in a folder.
pub fn next_free(folder: &Path) -> PathBuf {
    (1_u64..)
        .map(|number| folder.join(format!("oktant-{number:04}.png")))
        .find(|path| path.symlink_metadata().is_err())
        .expect("a folder has fewer files than there are numbers")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_never_used_twice() {
        let folder = tempfile::tempdir().unwrap();
        let name = |name: &str| folder.path().join(name);
        assert_eq!(next_free(folder.path()), name("oktant-0001.png"));
        std::fs::write(name("oktant-0001.png"), "").unwrap();
        std::fs::create_dir(name("oktant-0002.png")).unwrap();
        std::fs::write(name("oktant-0004.png"), "").unwrap();
        assert_eq!(next_free(folder.path()), name("oktant-0003.png"));
    }
}
