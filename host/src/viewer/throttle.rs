//! Not telling everything.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Progress is not told more often than this.
const INTERVAL: Duration = Duration::from_millis(50);

/// Says when progress should be told again, to any number of threads.
pub struct Throttle(Mutex<Instant>);

impl Throttle {
    /// The first time comes after an interval.
    pub fn new() -> Self {
        Throttle(Mutex::new(Instant::now()))
    }

    /// True once an interval.
    pub fn is_due(&self) -> bool {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_due = last.elapsed() >= INTERVAL;
        if is_due {
            *last = Instant::now();
        }
        is_due
    }
}
