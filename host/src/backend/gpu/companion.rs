//! The modules beside a kernel's first.

use oktant_shared::parts::Parts;
use std::path::{Path, PathBuf};

/// What the host launches for lists of pixels begins with this.
const OF_LISTS: &str = "render_listed";

/// A module that is read when it is needed, in a folder of its own beside a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Companion {
    /// What renders lists of pixels.
    Lists,
    /// What casts rays with other parts than the default ones.
    Parts,
}

impl Companion {
    /// All of them, in the order of their numbers.
    pub(super) const ALL: [Companion; 2] = [Companion::Lists, Companion::Parts];

    /// The one that should have an entry point; none where that is the first module.
    pub(super) fn meant_for(entry: &str) -> Option<Self> {
        if entry.starts_with(OF_LISTS) {
            return Some(Companion::Lists);
        }
        let others = Parts::OFFERED.iter().filter(|parts| **parts != Parts::default());
        let mut casts = others.filter_map(|parts| parts.entry_points());
        casts
            .any(|(closest, any)| [closest, any].contains(&entry))
            .then_some(Companion::Parts)
    }

    /// Where it is, for a kernel at `path`.
    pub(super) fn beside(self, path: &Path) -> PathBuf {
        let folder = match self {
            Companion::Lists => "lists",
            Companion::Parts => "parts",
        };
        let folder = path.parent().unwrap_or(Path::new("")).join(folder);
        folder.join(path.file_name().unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::super::compiled_kernel;
    use super::*;

    /// Oracle: the modules that are part of the program.
    #[test]
    fn each_entry_point_is_meant_for_the_module_that_has_it() {
        let places = [None].into_iter().chain(Companion::ALL.map(Some));
        for (place, module) in places.zip(compiled_kernel()) {
            assert!(!module.manifest.entry_points.is_empty());
            for entry in module.manifest.entry_points {
                assert_eq!(Companion::meant_for(&entry.name), place, "{}", entry.name);
            }
        }
    }
}
