//! What a person prefers where neither the command line nor a scene says it.

use crate::picture::DEFAULT_SIZE;
use crate::view::View;
use std::sync::OnceLock;

/// How pictures are made where nobody says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preferences {
    /// The view that scenes change.
    pub view: View,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

/// Those of this process, once they are known.
static PREFERENCES: OnceLock<Preferences> = OnceLock::new();

impl Default for Preferences {
    fn default() -> Self {
        Preferences {
            view: View::default(),
            size: DEFAULT_SIZE,
        }
    }
}

impl Preferences {
    /// Makes these the process's, for everything that is loaded from now on. Only the first ones count.
    pub fn establish(self) {
        PREFERENCES.get_or_init(|| self);
    }

    /// Those of the process, or the defaults.
    pub fn of_process() -> Self {
        PREFERENCES.get().copied().unwrap_or_default()
    }
}
