//! Panics, as something to be told in a sentence.

use std::any::Any;
use std::cell::Cell;
use std::fmt;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::path::Path;
use std::sync::{Mutex, Once, PoisonError};

/// Where the last panic began: whoever catches one gets its message, but not its place.
static PLACE: Mutex<Option<String>> = Mutex::new(None);

/// A mistake of the program's own, or of a library: what the panic says, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Accident(String);

impl fmt::Display for Accident {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Accident {
    fn new(payload: &(dyn Any + Send)) -> Self {
        let message = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
            (Some(message), _) => message,
            (_, Some(message)) => message.as_str(),
            _ => "no message",
        };
        // A sentence has one line.
        let message: Vec<&str> = message.split_whitespace().collect();
        let message = message.join(" ");
        let place = PLACE.lock().unwrap_or_else(PoisonError::into_inner).take();
        Accident(match place {
            Some(place) => format!("{message}, {place}"),
            None => message,
        })
    }
}

/// Lets no panic print anything from now on: whoever catches it tells of it.
pub fn silence_panics() {
    panic::set_hook(Box::new(|info: &PanicHookInfo<'_>| {
        // The name alone: folders are those of the computer that compiled it.
        let place = info.location().map(|location| {
            let file = Path::new(location.file()).file_name().unwrap_or_default();
            format!("{} line {}", file.to_string_lossy(), location.line())
        });
        *PLACE.lock().unwrap_or_else(PoisonError::into_inner) = place;
    }));
}

/// Does something that may panic. What it changes must not be used afterwards, or must be fit for that.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, Accident> {
    panic::catch_unwind(AssertUnwindSafe(work)).map_err(|payload| Accident::new(payload.as_ref()))
}

thread_local! {
    /// Whether panics of this thread are expected.
    static IS_QUIET: Cell<bool> = const { Cell::new(false) };
}

/// As [`caught`], for calls of libraries that panic on this very thread where they should return an error: that prints nothing.
/// It may be called often, and by many threads at once.
pub fn caught_quietly<T>(work: impl FnOnce() -> T) -> Result<T, Accident> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let hook = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !IS_QUIET.get() {
                hook(info);
            }
        }));
    });
    let was_quiet = IS_QUIET.replace(true);
    let result = caught(work);
    IS_QUIET.set(was_quiet);
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    fn message(work: impl FnOnce()) -> String {
        caught(work).unwrap_err().to_string()
    }

    #[test]
    fn panics_become_words() {
        assert_eq!(caught(|| 3), Ok(3));
        assert!(message(|| panic!("just words")).starts_with("just words"));
        let empty = Vec::<String>::new();
        assert!(message(|| drop(empty[4].clone())).contains("the len is 0 but the index is 4"));
        assert!(message(|| panic!("two\n  lines")).starts_with("two lines"));
        assert!(message(|| panic::panic_any(7)).starts_with("no message"));
    }

    #[test]
    fn helpers_of_a_thread_count() {
        let work = || (0..100).into_par_iter().for_each(|i| assert!(i != 57, "not {i}"));
        assert!(message(work).starts_with("not 57"));
    }
}
