//! How fast a back end is.

use std::time::Duration;

/// Nanoseconds that a camera ray is taken to need while nothing is known: a slow computer's, so that the first picture
/// comes soon.
const FIRST_GUESS: f64 = 150.0;
/// The same for one that has a tree of rays.
const FIRST_GUESS_OF_TREES: f64 = 2500.0;
/// Part of a new measurement in the estimate.
const WEIGHT: f64 = 0.5;

/// Time that a camera ray takes, with all that follows from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    nanoseconds: f64,
    is_measured: bool,
}

impl Pace {
    /// A guess, to be replaced by the first measurement. In a plain scene a camera ray has no tree of rays.
    pub fn guessed(is_plain: bool) -> Self {
        Pace {
            nanoseconds: if is_plain { FIRST_GUESS } else { FIRST_GUESS_OF_TREES },
            is_measured: false,
        }
    }

    /// Takes note of how long so many camera rays took.
    pub fn measured(&mut self, rays: u64, milliseconds: f64) {
        if rays == 0 || !milliseconds.is_finite() {
            return;
        }
        let now = milliseconds * 1e6 / rays as f64;
        self.nanoseconds += (now - self.nanoseconds) * if self.is_measured { WEIGHT } else { 1.0 };
        self.is_measured = true;
    }

    /// Time that so many camera rays take.
    pub fn time(&self, rays: u64) -> Duration {
        Duration::try_from_secs_f64(rays as f64 * self.nanoseconds / 1e9).unwrap_or(Duration::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measurements_replace_the_guess_and_then_each_other() {
        let mut pace = Pace::guessed(true);
        assert_eq!(pace.time(1000), Duration::from_micros(150));
        pace.measured(1000, 0.1);
        assert_eq!(pace.time(1000), Duration::from_micros(100));
        pace.measured(1000, 0.3);
        assert_eq!(pace.time(1000), Duration::from_micros(200));
        for _ in 0..50 {
            pace.measured(1000, 4.0);
        }
        assert!(pace.time(1000) > Duration::from_micros(3999));
        assert_eq!(pace.time(0), Duration::ZERO);
    }

    #[test]
    fn nonsense_is_no_measurement() {
        let mut nonsense = Pace::guessed(true);
        nonsense.measured(0, 5.0);
        nonsense.measured(10, f64::NAN);
        assert_eq!(nonsense, Pace::guessed(true));
        nonsense.measured(1, 1e300);
        assert_eq!(nonsense.time(u64::MAX), Duration::MAX);
    }
}
