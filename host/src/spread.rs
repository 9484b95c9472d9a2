//! Numbers that were measured several times over.

use serde::Serialize;

/// The middle one of some numbers, and both ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// As many are above as below; of an even number of them the upper one of the middle.
    pub median: f64,
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub greatest: f64,
}

impl Spread {
    /// Of some numbers; none where there are none.
    pub fn new(mut numbers: Vec<f64>) -> Option<Self> {
        numbers.sort_by(f64::total_cmp);
        Some(Spread {
            median: *numbers.get(numbers.len() / 2)?,
            least: *numbers.first()?,
            greatest: *numbers.last()?,
        })
    }

    /// Of what so many things in so many milliseconds are, in millions a second.
    pub fn of_speeds(things: usize, milliseconds: &[f64]) -> Option<Self> {
        Self::new(milliseconds.iter().map(|time| things as f64 / time / 1e3).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_and_both_ends() {
        let spread = Spread::new(vec![3.0, 1.0, 2.0, 9.0, 8.0]).unwrap();
        assert_eq!((spread.median, spread.least, spread.greatest), (3.0, 1.0, 9.0));
        let one = Spread::new(vec![4.0]).unwrap();
        assert_eq!((one.median, one.least, one.greatest), (4.0, 4.0, 4.0));
        assert_eq!(Spread::new(Vec::new()), None);
    }

    #[test]
    fn speeds_turn_the_ends_round() {
        let spread = Spread::of_speeds(2_000_000, &[1e3, 4e3]).unwrap();
        assert_eq!((spread.least, spread.greatest), (0.5, 2.0));
    }
}
