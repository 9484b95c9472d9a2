//! How soon the event loop answers.

use std::time::{Duration, Instant};
use winit::event::StartCause;

/// The longest time since it was asked that an event, or a time to wake up at, was not done with.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pulse {
    since: Option<Instant>,
    longest: Duration,
}

impl Pulse {
    /// The loop wakes up.
    pub fn wakes(&mut self, cause: StartCause, now: Instant) {
        self.since = Some(match cause {
            // It may come late, because others have the processor.
            StartCause::ResumeTimeReached { requested_resume, .. } => requested_resume.min(now),
            _ => now,
        });
    }

    /// The loop has done what there was to do.
    pub fn rests(&mut self, now: Instant) {
        if let Some(since) = self.since.take() {
            self.longest = self.longest.max(now.saturating_duration_since(since));
        }
    }

    /// The longest time so far; from now on it is counted anew.
    pub fn take_longest(&mut self) -> Duration {
        std::mem::take(&mut self.longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_late_counts_from_when_it_was_due() {
        let start = Instant::now();
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        let mut pulse = Pulse::default();
        pulse.wakes(StartCause::Poll, at(10));
        pulse.rests(at(13));
        let due = StartCause::ResumeTimeReached {
            start: at(13),
            requested_resume: at(20),
        };
        pulse.wakes(due, at(24));
        pulse.rests(at(26));
        pulse.wakes(StartCause::Poll, at(30));
        pulse.rests(at(31));
        assert_eq!(pulse.take_longest(), Duration::from_millis(6));
        assert_eq!(pulse.take_longest(), Duration::ZERO);
    }
}
