//! Progress on a terminal.

use indicatif::{HumanDuration, ProgressStyle};
use std::borrow::Cow;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::time::{Duration, Instant};

/// A bar on standard error that appears once the work has taken a while; nothing where standard error is no terminal.
pub struct ProgressBar {
    start: Instant,
    state: Mutex<State>,
}

/// What changes while work goes on.
struct State {
    stage: Stage,
    bar: Option<indicatif::ProgressBar>,
}

/// Work that takes less needs no bar.
const PATIENCE: Duration = Duration::from_millis(700);
/// Length of the bar in steps.
const STEPS: u64 = 1000;

impl ProgressBar {
    pub fn new() -> Self {
        Self::since(Instant::now())
    }

    /// Of work that began at a certain time.
    fn since(start: Instant) -> Self {
        ProgressBar {
            start,
            state: Mutex::new(State {
                stage: Stage::new(start),
                bar: None,
            }),
        }
    }

    /// Shows how far a stage is, 0 to 1.
    pub fn show(&self, stage: impl Into<Cow<'static, str>>, fraction: f32) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let rest = state.stage.rest(Instant::now(), fraction);
        if self.start.elapsed() < PATIENCE {
            return;
        }
        let bar = state.bar.get_or_insert_with(|| {
            // Draws on standard error, and only where that is a terminal. Its own estimate of the time left knows nothing of
            // the time before it was there.
            let bar = indicatif::ProgressBar::new(STEPS);
            bar.set_style(
                ProgressStyle::with_template("{msg:>10} {wide_bar} {percent:>3} % {prefix}")
                    .expect("the template is constant and tested"),
            );
            bar
        });
        bar.set_message(stage);
        bar.set_prefix(rest.map_or("?".to_owned(), |rest| format!("{:#}", HumanDuration(rest))));
        bar.set_position((fraction * STEPS as f32) as u64);
    }
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(bar) = state.bar.take() {
            bar.finish_and_clear();
        }
    }
}

/// A part of the work whose fraction goes from 0 to 1.
struct Stage {
    start: Instant,
    fraction: f32,
}

impl Stage {
    fn new(start: Instant) -> Self {
        Stage { start, fraction: 0.0 }
    }

    /// How much time is left, if the rest goes as what is done by `now`; none where nothing is done.
    fn rest(&mut self, now: Instant, fraction: f32) -> Option<Duration> {
        // Threads may overtake each other by a little; what falls by more is another stage.
        if fraction < 0.5 * self.fraction {
            self.start = now;
        }
        self.fraction = fraction;
        rest(now.saturating_duration_since(self.start), fraction)
    }
}

/// How much time is left of work of which a fraction took so long; none where that is nothing.
fn rest(elapsed: Duration, fraction: f32) -> Option<Duration> {
    let fraction = f64::from(fraction.min(1.0));
    if fraction <= 0.0 {
        return None;
    }
    Duration::try_from_secs_f64(elapsed.as_secs_f64() * (1.0 - fraction) / fraction).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_is_valid() {
        let bar = ProgressBar::since(Instant::now() - PATIENCE * 2);
        bar.show("testing", 0.5);
    }

    #[test]
    fn the_rest_takes_as_long_as_what_is_done() {
        let seconds = Duration::from_secs;
        assert_eq!(rest(seconds(10), 0.25), Some(seconds(30)));
        assert_eq!(rest(seconds(10), 0.5), Some(seconds(10)));
        for fraction in [1.0, 1.5] {
            assert_eq!(rest(seconds(10), fraction), Some(Duration::ZERO));
        }
        assert_eq!(rest(seconds(10), 0.0), None);
    }

    #[test]
    fn each_stage_has_a_time_of_its_own() {
        let start = Instant::now();
        let mut stage = Stage::new(start);
        let mut rest = |seconds, fraction| stage.rest(start + Duration::from_secs(seconds), fraction);
        assert_eq!(rest(10, 0.25), Some(Duration::from_secs(30)));
        assert_eq!(rest(40, 1.0), Some(Duration::ZERO));
        assert_eq!(rest(41, 0.0), None);
        assert_eq!(rest(43, 0.5), Some(Duration::from_secs(2)));
    }
}
