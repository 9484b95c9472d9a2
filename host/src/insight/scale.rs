//! From numbers to places between two ends.

use super::aspect::Aspect;
use super::figures::Figures;
use serde::Serialize;

/// What lies between two numbers, linear or logarithmic.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Scale {
    /// The number at place 0.
    pub low: f64,
    /// The number at place 1, not below `low`.
    pub high: f64,
    /// Whether equal steps are equal ratios.
    pub is_logarithmic: bool,
    /// Added to numbers before their logarithm is taken: 1 for what is counted, so that 0 has a place.
    offset: f64,
}

/// Ends that are so many times apart ask for logarithms.
const FAR_APART: f64 = 100.0;

impl Scale {
    /// The scale of an aspect's numbers: between two ends that are given, else over all that there are. Whether it is
    /// logarithmic follows from the ends alone, so that pictures with the same ends can be compared.
    pub fn new(aspect: Aspect, figures: &Figures, range: Option<[f64; 2]>) -> Self {
        let [low, high] = range.unwrap_or([figures.least, figures.greatest]);
        let offset = if aspect == Aspect::Depth { 0.0 } else { 1.0 };
        Scale {
            low,
            high,
            is_logarithmic: low + offset > 0.0 && high + offset > FAR_APART * (low + offset),
            offset,
        }
    }

    /// Where a number lies, 0 to 1; what is beyond an end lies there.
    pub fn place(&self, number: f64) -> f64 {
        let [number, low, high] =
            [number.clamp(self.low, self.high), self.low, self.high].map(|number| self.bent(number));
        if high > low { (number - low) / (high - low) } else { 0.0 }
    }

    /// The number at a place, 0 to 1.
    pub fn number(&self, place: f64) -> f64 {
        let [low, high] = [self.low, self.high].map(|number| self.bent(number));
        let bent = low + place * (high - low);
        if self.is_logarithmic {
            bent.exp() - self.offset
        } else {
            bent
        }
    }

    /// As people call it.
    pub fn name(&self) -> &'static str {
        if self.is_logarithmic { "logarithmic" } else { "linear" }
    }

    fn bent(&self, number: f64) -> f64 {
        if self.is_logarithmic {
            (number + self.offset).ln()
        } else {
            number
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(aspect: Aspect, low: f64, high: f64) -> Scale {
        let figures = Figures::new(&[3.0]).unwrap();
        Scale::new(aspect, &figures, Some([low, high]))
    }

    #[test]
    fn ends_decide_what_lies_between() {
        let linear = scale(Aspect::Steps, 0.0, 80.0);
        assert_eq!(
            (linear.name(), linear.place(20.0), linear.number(0.25)),
            ("linear", 0.25, 20.0)
        );
        let logarithmic = scale(Aspect::Tests, 0.0, 9_999.0);
        assert_eq!(logarithmic.name(), "logarithmic");
        assert!((logarithmic.place(99.0) - 0.5).abs() < 1e-12);
        assert!((logarithmic.number(0.25) - 9.0).abs() < 1e-9);
        let depth = scale(Aspect::Depth, 0.01, 100.0);
        assert!((depth.number(0.5) - 1.0).abs() < 1e-12, "{depth:?}");
        assert_eq!(scale(Aspect::Depth, 0.0, 1e6).name(), "linear", "0 has no logarithm");
    }

    #[test]
    fn what_is_beyond_lies_at_the_end() {
        let scale = scale(Aspect::Steps, 10.0, 20.0);
        assert_eq!(
            [5.0, 10.0, 20.0, 99.0].map(|number| scale.place(number)),
            [0.0, 0.0, 1.0, 1.0]
        );
    }

    #[test]
    fn without_ends_all_numbers_are_within() {
        let figures = Figures::new(&[7.0, 3.0, f32::NAN, 5.0]).unwrap();
        let scale = Scale::new(Aspect::LeafDepth, &figures, None);
        assert_eq!((scale.low, scale.high), (3.0, 7.0));
        let same = Scale::new(Aspect::LeafDepth, &Figures::new(&[4.0, 4.0]).unwrap(), None);
        assert_eq!((same.place(4.0), same.number(0.5)), (0.0, 4.0));
    }
}
