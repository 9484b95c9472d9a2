//! How coarse a picture may be so that it is there in time.

use std::time::Duration;

/// A picture that takes no longer than this keeps up with a hand that drags.
const FLUID: Duration = Duration::from_millis(60);
/// A pixel of the coarsest draft covers a square with this edge, pixels of the window.
const COARSEST: u32 = 4;
/// Nanoseconds that a ray is taken to need while nothing is known: a slow computer's, so that the first picture comes
/// soon.
const FIRST_GUESS: f64 = 150.0;
/// Part of a new measurement in the estimate.
const WEIGHT: f64 = 0.5;

/// Time that a camera ray takes, with all that follows from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    nanoseconds: f64,
}

impl Default for Pace {
    fn default() -> Self {
        Pace {
            nanoseconds: FIRST_GUESS,
        }
    }
}

impl Pace {
    /// Takes note of how long so many camera rays took.
    pub fn measured(&mut self, rays: u64, milliseconds: f64) {
        if rays > 0 && milliseconds.is_finite() {
            let now = milliseconds * 1e6 / rays as f64;
            self.nanoseconds += (now - self.nanoseconds) * WEIGHT;
        }
    }

    /// Edge of the square of the window's pixels that a draft's pixel covers.
    pub fn coarseness(&self, size: [u32; 2]) -> u32 {
        (1..COARSEST)
            .find(|&edge| {
                let [width, height] = draft_size(size, edge);
                let rays = f64::from(width) * f64::from(height);
                rays * self.nanoseconds <= FLUID.as_nanos() as f64
            })
            .unwrap_or(COARSEST)
    }

    /// Samples a pixel that a pass over so many pixels may take if it is not to hold up what comes next.
    pub fn samples(&self, pixels: u64, most: u32, limit: Duration) -> u32 {
        let one = (pixels as f64 * self.nanoseconds).max(1.0);
        ((limit.as_nanos() as f64 / one) as u32).clamp(1, most)
    }
}

/// Size of a draft whose pixels cover squares with this edge.
pub fn draft_size(size: [u32; 2], edge: u32) -> [u32; 2] {
    size.map(|side| side.div_ceil(edge))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slower_is_coarser() {
        let mut pace = Pace::default();
        let size = [1280, 968];
        for _ in 0..20 {
            pace.measured(1_000_000, 1.0);
        }
        assert_eq!(pace.coarseness(size), 1, "a GPU");
        let mut last = 1;
        for nanoseconds in [40, 100, 200, 400, 4000, 400_000] {
            for _ in 0..40 {
                pace.measured(1_000_000, f64::from(nanoseconds));
            }
            let edge = pace.coarseness(size);
            assert!(edge >= last && edge <= COARSEST, "{nanoseconds} ns a ray");
            if edge < COARSEST {
                let [width, height] = draft_size(size, edge);
                assert!(width * height * nanoseconds <= 61_000_000);
            }
            last = edge;
        }
        assert_eq!(last, COARSEST);
        assert_eq!(draft_size([1280, 969], 2), [640, 485]);
    }

    #[test]
    fn passes_are_limited() {
        let mut pace = Pace::default();
        for _ in 0..60 {
            pace.measured(1000, 0.1);
        }
        let limit = Duration::from_millis(10);
        assert_eq!(pace.samples(25_000, 16, limit), 4);
        assert_eq!(pace.samples(1, 16, limit), 16);
        assert_eq!(pace.samples(u64::MAX, 16, limit), 1);
    }

    #[test]
    fn nonsense_is_no_measurement() {
        let mut pace = Pace::default();
        pace.measured(0, 5.0);
        pace.measured(10, f64::NAN);
        assert_eq!(pace, Pace::default());
    }
}
