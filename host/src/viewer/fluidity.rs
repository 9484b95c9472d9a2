//! How fluid what moves is.

use std::fmt;

/// Times of frames, or from an input to its frame, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluidity {
    /// The middle one.
    pub median: f64,
    /// What 99 of 100 do not exceed.
    pub percentile_99: f64,
    /// The greatest.
    pub greatest: f64,
    /// How many there are.
    pub count: usize,
}

impl Fluidity {
    /// Of some times; none where there are none.
    pub fn of(times: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = times.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        Some(Fluidity {
            median: *sorted.get(count / 2)?,
            percentile_99: sorted[(count * 99).div_ceil(100) - 1],
            greatest: sorted[count - 1],
            count,
        })
    }
}

impl fmt::Display for Fluidity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fluidity {
            median,
            percentile_99,
            greatest,
            count,
        } = self;
        write!(f, "{median:.1} {percentile_99:.1} {greatest:.1} {count}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_of_a_hundred_is_beyond() {
        let of = |count: u32| Fluidity::of((1..=count).rev().map(f64::from)).unwrap();
        assert_eq!(of(100).to_string(), "51.0 99.0 100.0 100");
        assert_eq!(of(200).percentile_99, 198.0);
        assert_eq!(of(50).percentile_99, 50.0, "of few none is left out");
        assert_eq!(of(1).to_string(), "1.0 1.0 1.0 1");
        assert_eq!(Fluidity::of([]), None);
    }
}
