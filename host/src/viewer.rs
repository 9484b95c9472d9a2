//! The window.
//!
//! Everything that happens to it becomes an `Event`, and that an `Input` where it asks for something; a
//! script makes events too. The `Session` is the state that inputs change. What follows is done by threads: one
//! renders, one loads a scene, one opens the GPU or swaps its kernel, two notice that a file was saved; they answer with a `Notice`. The window itself only draws.

mod adjustment;
mod application;
mod bearing;
mod caption;
mod compose;
mod depth_paces;
mod dialog;
mod draft;
mod draw;
mod event;
mod figures;
mod fluidity;
mod flying;
mod given;
mod gpu_memory;
mod gpu_screen;
mod grammar;
mod handler;
mod held;
mod input;
mod kernel_file;
mod layers;
mod load_queue;
mod loader;
mod loads;
mod look;
mod mentioned;
mod news;
mod notice;
mod opener;
mod oracle;
pub(crate) mod overlay;
mod pace;
mod panel;
mod passes;
mod pick;
mod pictures;
mod play;
mod player;
mod presenter;
mod pulse;
mod recent;
mod recovery;
mod remembered;
mod renderer;
mod report;
mod saved_views;
mod saving;
mod schedule;
mod screen;
mod script;
mod seeing;
mod session;
mod settings;
mod showing;
mod side;
mod sight;
mod software_screen;
mod state;
mod step;
mod task;
#[cfg(test)]
mod tasks;
mod throttle;
mod translation;
mod turns;
mod warnings;
mod watcher;
mod work;
mod worker;
mod written_camera;

pub use crate::accident::Accident;
pub use given::{GivenSetting, Unsettable};
pub use look::Look;
pub use notice::LoadError;
pub use screen::ScreenError;
pub use script::ScriptError;

use crate::accident;
use crate::backend::gpu::ModulePath;
use crate::backend::{BackendChoice, BackendError};
use crate::source::Source;
use crate::structure::StructureOptions;
use application::Application;
use kernel_file::KernelFile;
use notice::{Mailbox, Notice};
use player::Player;
use script::Script;
use std::panic;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use winit::event_loop::EventLoop;

/// What the window opens with.
#[derive(Clone, Debug)]
pub struct ViewerOptions {
    /// What to look at.
    pub source: Source,
    /// What rays are traced through.
    pub structure: StructureOptions,
    /// What is changed in the view that comes with it, or with whatever is looked at later.
    pub look: Look,
    /// What of its lights, materials and surroundings is set.
    pub set: Vec<GivenSetting>,
    /// Width and height of the window's inside, physical pixels; as the scene says, else 1280 times 968.
    pub size: Option<[u32; 2]>,
    /// What renders.
    pub backend: BackendChoice,
    /// How the kernel reaches the GPU's driver.
    pub module: ModulePath,
    /// The file of the kernel to run in the place of the one that is part of the program; it is read again when it is
    /// saved.
    pub kernel: Option<PathBuf>,
    /// How long a picture may take while something moves.
    pub target: Duration,
    /// A script to play; the window closes at its end.
    pub script: Option<PathBuf>,
    /// Whether the panel is open at first; as it was left, else closed.
    pub panel: Option<bool>,
    /// The file in which the panel's state is remembered, if it is.
    pub state: Option<PathBuf>,
    /// The folder for pictures that are saved by key.
    pub pictures: PathBuf,
}

/// Why the viewer ended without being asked to.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    /// There is nothing to open a window on.
    #[error("There is no display to open a window on ({0}); set DISPLAY or WAYLAND_DISPLAY, or use: oktant render.")]
    NoDisplay(String),
    /// The window system refused.
    #[error("The window could not be opened ({0}); restart the display, or use: oktant render.")]
    Window(String),
    /// The window cannot be drawn.
    #[error(transparent)]
    Screen(#[from] ScreenError),
    /// There is nothing to look at.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The GPU was asked for and cannot be had.
    #[error(transparent)]
    Backend(#[from] BackendError),
    /// The script makes no sense.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A step of the script failed.
    #[error("{file}, line {line}: {reason}.")]
    Step {
        /// The script.
        file: String,
        /// Its line, counted from 1.
        line: usize,
        /// What went wrong.
        reason: String,
    },
    /// The window itself panicked.
    #[error("The window was closed by a mistake in oktant ({0}); please report it, with what you did.")]
    Accident(Accident),
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`ViewerError`], see there.
pub fn run(options: ViewerOptions) -> Result<(), ViewerError> {
    let start = Instant::now();
    let script = options.script.as_deref().map(Script::read).transpose()?;
    let event_loop = event_loop()?;
    let mailbox = Mailbox::new(event_loop.create_proxy());
    let kernel = options.kernel.clone();
    let kernel = kernel.map(|path| KernelFile::open(path, &mailbox)).transpose()?;
    let player = script.map(|script| Player::new(script, start));
    let mut application = Application::new(options, kernel, start, mailbox, player);
    accident::silence_panics();
    accident::caught(|| event_loop.run_app(&mut application))
        .map_err(ViewerError::Accident)?
        .map_err(|error| ViewerError::Window(error.to_string()))?;
    application.finish()
}

/// The connection to the display.
fn event_loop() -> Result<EventLoop<Notice>, ViewerError> {
    let mut builder = EventLoop::with_user_event();
    #[cfg(target_os = "linux")]
    if wayland_is_dead() {
        use winit::platform::x11::EventLoopBuilderExtX11;
        builder.with_x11();
    }
    // winit panics where a display lacks an extension; for a person that is no display either.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let built = panic::catch_unwind(panic::AssertUnwindSafe(|| builder.build()));
    panic::set_hook(hook);
    match built {
        Ok(Ok(event_loop)) => Ok(event_loop),
        Ok(Err(error)) => Err(ViewerError::NoDisplay(reason(&error.to_string()))),
        Err(_) => Err(ViewerError::NoDisplay(
            "the display lacks an extension that windows need".into(),
        )),
    }
}

/// Whether the environment names a Wayland display that does not answer, and an X display: winit tries only the first.
#[cfg(target_os = "linux")]
fn wayland_is_dead() -> bool {
    use std::os::unix::net::UnixStream;
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let (Some(wayland), Some(_), None) = (
        variable("WAYLAND_DISPLAY"),
        variable("DISPLAY"),
        variable("WAYLAND_SOCKET"),
    ) else {
        return false;
    };
    let folder = variable("XDG_RUNTIME_DIR").unwrap_or_default();
    UnixStream::connect(PathBuf::from(folder).join(wayland)).is_err()
}

/// What winit says without the place in its source where it says so.
fn reason(message: &str) -> String {
    match message
        .strip_prefix("os error at ")
        .and_then(|rest| rest.split_once(": "))
    {
        Some((_, reason)) => reason.trim_end_matches('.').into(),
        None => message.trim_end_matches('.').into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_for_people() {
        let message = "os error at /home/a/winit/mod.rs:764: neither WAYLAND_DISPLAY nor DISPLAY is set.";
        assert_eq!(reason(message), "neither WAYLAND_DISPLAY nor DISPLAY is set");
        assert_eq!(reason("something else"), "something else");
    }
}
