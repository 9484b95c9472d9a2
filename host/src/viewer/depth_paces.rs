//! How fast a back end is, by the depth of the trees of rays.

use super::pace::Pace;
use std::collections::BTreeMap;
use std::time::Duration;

/// A pace for each depth that was rendered: what was measured of shallow trees says nothing of deep ones.
#[derive(Clone, Debug)]
pub struct DepthPaces {
    guess: Pace,
    measured: BTreeMap<u32, Pace>,
}

impl DepthPaces {
    /// Nothing is measured yet. In a plain scene a camera ray has no tree of rays.
    pub fn guessed(is_plain: bool) -> Self {
        DepthPaces {
            guess: Pace::guessed(is_plain),
            measured: BTreeMap::new(),
        }
    }

    /// Takes note of how long so many camera rays took with trees of that depth.
    pub fn measured(&mut self, depth: u32, rays: u64, milliseconds: f64) {
        let pace = self.measured.entry(depth).or_insert(self.guess);
        pace.measured(rays, milliseconds);
    }

    /// Time that so many camera rays take with trees of that depth.
    pub fn time(&self, depth: u32, rays: u64) -> Duration {
        self.measured.get(&depth).unwrap_or(&self.guess).time(rays)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_do_not_speak_for_each_other() {
        let mut paces = DepthPaces::guessed(false);
        let guess = paces.time(16, 1000);
        paces.measured(2, 1000, 0.001);
        assert_eq!(
            paces.time(16, 1000),
            guess,
            "a quick draft does not make the finished picture quick"
        );
        paces.measured(16, 1000, 7.0);
        assert_eq!(paces.time(2, 1000), Duration::from_micros(1));
        assert_eq!(paces.time(16, 1000), Duration::from_millis(7));
    }
}
