//! Ctrl-C: what is complete stays, nothing else does.

use std::io;
use std::sync::{Mutex, PoisonError};

/// Says in one sentence what is there, and how to go on.
type Story = Box<dyn Fn() -> String + Send>;

/// What is told to whoever interrupts the work.
static STORY: Mutex<Option<Story>> = Mutex::new(None);

/// From now on Ctrl-C, and a polite kill, remove all temporary files and then end the process, with the code that shells
/// report of such a process: 130, or 143.
pub fn listen() {
    if let Err(error) = listen_to_signals() {
        tracing::warn!("whoever interrupts may have to remove temporary files ({error})");
    }
}

#[cfg(unix)]
fn listen_to_signals() -> io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use std::thread;

    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    thread::Builder::new().name("signals".into()).spawn(move || {
        if let Some(signal) = signals.forever().next() {
            end(128 + signal);
        }
    })?;
    Ok(())
}

/// Where there are no signals, the system ends the process itself.
#[cfg(not(unix))]
fn listen_to_signals() -> io::Result<()> {
    Ok(())
}

/// Ends the process with a code.
#[cfg(unix)]
fn end(code: i32) -> ! {
    use std::io::IsTerminal;

    oktant::output::abandon();
    let story = STORY.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(story) = story {
        if io::stderr().is_terminal() {
            // After the progress, and what the terminal shows of the key itself.
            eprintln!();
        }
        eprintln!("oktant: {}", story());
    }
    // At once: drivers that clean up at a process's usual end crash where others of its threads still use them.
    signal_hook::low_level::exit(code)
}

/// What is told from now on; when it is, no output gets its name any more.
pub fn tell(story: impl Fn() -> String + Send + 'static) {
    *STORY.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(story));
}
