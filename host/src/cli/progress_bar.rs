//! Progress on a terminal.

use indicatif::ProgressStyle;
use std::borrow::Cow;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::time::{Duration, Instant};

/// A bar on standard error that appears once the work has taken a while; nothing where standard error is no terminal.
pub struct ProgressBar {
    start: Instant,
    bar: Mutex<Option<indicatif::ProgressBar>>,
}

/// Work that takes less needs no bar.
const PATIENCE: Duration = Duration::from_millis(700);
/// Length of the bar in steps.
const STEPS: u64 = 1000;

impl ProgressBar {
    pub fn new() -> Self {
        ProgressBar {
            start: Instant::now(),
            bar: Mutex::new(None),
        }
    }

    /// Shows how far a stage is, 0 to 1.
    pub fn show(&self, stage: impl Into<Cow<'static, str>>, fraction: f32) {
        if self.start.elapsed() < PATIENCE {
            return;
        }
        let mut bar = self.bar.lock().unwrap_or_else(PoisonError::into_inner);
        let bar = bar.get_or_insert_with(|| {
            // Draws on standard error, and only where that is a terminal.
            let bar = indicatif::ProgressBar::new(STEPS);
            bar.set_style(
                ProgressStyle::with_template("{msg:>10} {wide_bar} {percent:>3} % {eta}")
                    .expect("the template is constant and tested"),
            );
            bar
        });
        bar.set_message(stage);
        bar.set_position((fraction * STEPS as f32) as u64);
    }
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.lock().unwrap_or_else(PoisonError::into_inner).take() {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_template_is_valid() {
        let bar = super::ProgressBar {
            start: std::time::Instant::now() - super::PATIENCE * 2,
            bar: std::sync::Mutex::new(None),
        };
        bar.show("testing", 0.5);
    }
}
