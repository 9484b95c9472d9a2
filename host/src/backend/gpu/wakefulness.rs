//! Whether a device is at its full clock.

use super::Gpu;
use crate::backend::BackendError;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A device that has been idle takes so long to reach its clock again.
const WARM_UP: Duration = Duration::from_millis(300);
/// So long after its last work it still has it: an array of rays is sent to it in less.
const STAYS: Duration = Duration::from_millis(100);

/// When a device has been measured last.
#[derive(Debug, Default)]
pub(super) struct Wakefulness(Mutex<Option<Instant>>);

impl Wakefulness {
    /// The device ends work just now.
    pub fn was_busy(&self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(Instant::now());
    }

    fn is_awake(&self) -> bool {
        let last = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        last.is_some_and(|last| last.elapsed() < STAYS)
    }
}

impl Gpu {
    /// Does something once or, where the device has been idle, again and again until it has its clock. Returns what came last.
    pub(super) fn awake<T>(&self, once: impl Fn() -> Result<T, BackendError>) -> Result<T, BackendError> {
        let is_awake = self.wakefulness.is_awake();
        let start = Instant::now();
        let mut last = once()?;
        while !is_awake && start.elapsed() < WARM_UP {
            last = once()?;
        }
        self.wakefulness.was_busy();
        Ok(last)
    }
}
