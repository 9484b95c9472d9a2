//! Axes: where values are, and what stands at their ticks.

use serde::{Deserialize, Serialize};

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithm, which only positive values have; others are not drawn.
    Log,
}

/// What an axis shows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// What stands along it, with the unit.
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
}

impl Axis {
    /// An axis of logarithms.
    pub fn log(label: impl Into<String>) -> Self {
        Axis {
            label: label.into(),
            scale: Scale::Log,
        }
    }

    /// An even axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Axis {
            label: label.into(),
            scale: Scale::Linear,
        }
    }
}

/// A tick.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub value: f64,
    /// Empty for those between.
    pub label: String,
}

/// An axis with its limits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range {
    scale: Scale,
    low: f64,
    high: f64,
}

impl Range {
    /// Around all of the values, with some room.
    pub fn around(scale: Scale, values: impl IntoIterator<Item = f64>) -> Self {
        let values = values.into_iter().filter(|value| is_drawable(scale, *value));
        let (mut low, mut high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        if low > high {
            (low, high) = (1.0, 10.0);
        }
        match scale {
            Scale::Log => {
                let (from, to) = (low.log10(), high.log10());
                let room = 0.06 * (to - from).max(1.0);
                let (mut from, mut to) = (from - room, to + room);
                if to - from < 1.0 {
                    let missing = 0.5 * (1.0 - (to - from));
                    (from, to) = (from - missing, to + missing);
                }
                (low, high) = (10.0_f64.powf(from), 10.0_f64.powf(to));
            }
            Scale::Linear => {
                let room = if high > low {
                    0.06 * (high - low)
                } else {
                    0.5 * high.abs().max(1.0)
                };
                (low, high) = (low - room, high + room);
            }
        }
        Range { scale, low, high }
    }

    /// From 0 to 1 along the axis; none of what cannot be drawn.
    pub fn place(&self, value: f64) -> Option<f64> {
        is_drawable(self.scale, value).then(|| match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => (value / self.low).log10() / (self.high / self.low).log10(),
        })
    }

    /// The ticks, at most so many with labels.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => self.even_ticks(most),
            Scale::Log => self.decades(most),
        }
    }

    fn even_ticks(&self, most: usize) -> Vec<Tick> {
        let rough = (self.high - self.low) / most.max(2) as f64;
        let power = 10.0_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(|step| *step >= rough)
            .unwrap_or(10.0 * power);
        let digits = (-step.log10().floor()).max(0.0) as usize;
        let (first, last) = ((self.low / step).ceil() as i64, (self.high / step).floor() as i64);
        (first..=last)
            .map(|index| Tick {
                value: index as f64 * step,
                label: format!("{:.digits$}", index as f64 * step),
            })
            .collect()
    }

    fn decades(&self, most: usize) -> Vec<Tick> {
        let (first, last) = (self.low.log10().floor() as i32, self.high.log10().ceil() as i32);
        let within = |value: &f64| (self.low..=self.high).contains(value);
        let powers = (first..=last)
            .filter(|&exponent| within(&10.0_f64.powi(exponent)))
            .count();
        let stride = powers.div_ceil(most.max(1)).max(1) as i32;
        // Where there are few powers of ten, others are named too.
        let named: &[u32] = match powers {
            0 | 1 => &[1, 2, 3, 5, 7],
            2 => &[1, 2, 5],
            _ => &[1],
        };
        let has_steps = powers <= 6;
        let is_plain = first >= -3 && last <= 4;
        let mut ticks = Vec::new();
        for exponent in first..=last {
            for digit in 1..10 {
                let value = f64::from(digit) * 10.0_f64.powi(exponent);
                if !within(&value) || digit > 1 && !has_steps {
                    continue;
                }
                let has_label = named.contains(&digit) && exponent.rem_euclid(stride) == 0;
                ticks.push(Tick {
                    value,
                    label: match (has_label, is_plain, digit) {
                        (false, ..) => String::new(),
                        (_, true, _) => plain(value),
                        (_, false, 1) => format!("10{}", superscript(exponent)),
                        (_, false, _) => format!("{digit}·10{}", superscript(exponent)),
                    },
                });
            }
        }
        ticks
    }
}

fn is_drawable(scale: Scale, value: f64) -> bool {
    value.is_finite() && (scale == Scale::Linear || value > 0.0)
}

/// With commas between thousands, and no digits that say nothing.
fn plain(value: f64) -> String {
    if value >= 1000.0 {
        let whole = value.round() as u64;
        return format!("{},{:03}", whole / 1000, whole % 1000);
    }
    let digits = (-value.log10().floor()).max(0.0) as usize;
    format!("{value:.digits$}")
}

/// A whole number in raised digits.
pub(super) fn superscript(exponent: i32) -> String {
    let raised = |character| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        other => char::from_u32(other as u32 - '4' as u32 + '⁴' as u32).unwrap_or(other),
    };
    exponent.to_string().chars().map(raised).collect()
}

/// Two digits and a power of ten where that is shorter.
pub(super) fn scientific(value: f64) -> String {
    let exponent = value.log10().floor();
    if (-2.0..4.0).contains(&exponent) {
        return plain(value);
    }
    let mantissa = format!("{:.1}", value / 10.0_f64.powf(exponent));
    let mantissa = mantissa.strip_suffix(".0").unwrap_or(&mantissa);
    match mantissa {
        "1" => format!("10{}", superscript(exponent as i32)),
        "10" => format!("10{}", superscript(exponent as i32 + 1)),
        _ => format!("{mantissa}·10{}", superscript(exponent as i32)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_powers_of_ten() {
        let labels = |range: &Range| -> Vec<String> {
            let ticks = range.ticks(10).into_iter();
            ticks.map(|tick| tick.label).filter(|label| !label.is_empty()).collect()
        };
        let wide = Range::around(Scale::Log, [3e-7, 0.4]);
        assert_eq!(labels(&wide), ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹"]);
        let narrow = Range::around(Scale::Log, [0.9, 20.0]);
        assert_eq!(labels(&narrow), ["1", "2", "5", "10", "20"]);
        let even = Range::around(Scale::Linear, [4.0, 10.0]);
        assert_eq!(labels(&even), ["4", "5", "6", "7", "8", "9", "10"]);
    }

    #[test]
    fn what_has_no_logarithm_has_no_place() {
        let range = Range::around(Scale::Log, [0.0, -1.0, f64::NAN, 1.0, 100.0]);
        assert_eq!((range.place(0.0), range.place(f64::NAN)), (None, None));
        let middle = range.place(10.0).unwrap();
        assert!((middle - 0.5).abs() < 1e-9, "{middle}");
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(scientific(3e-7), "3·10⁻⁷");
        assert_eq!(scientific(0.003), "3·10⁻³");
        assert_eq!(scientific(0.03), "0.03");
        assert_eq!(scientific(1e-6), "10⁻⁶");
        assert_eq!(scientific(9.99e-6), "10⁻⁵");
    }
}
