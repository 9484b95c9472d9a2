//! What a chart shows.

/// A point of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The panel that it is in, see [`super::Panel::name`].
    pub panel: String,
    /// What it belongs to; all records of a series look alike and are named in the legend.
    pub series: String,
    /// What stands beside it; nothing where it is empty.
    pub label: String,
    /// Where it is, in the unit of the panel's axis.
    pub x: f64,
    /// How high it is.
    pub y: Value,
    /// Whether it is to stand out, with a ring around it.
    pub is_marked: bool,
}

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// In the unit of the panel's axis.
    Number(f64),
    /// How often something happened in so many trials, at least one.
    Rate {
        /// How often.
        count: u64,
        /// In so many.
        of: u64,
    },
}

impl Value {
    /// What stands for it on a logarithmic axis. Of what never happened in N trials that is 3 / N: were it more frequent, it had happened with a
    /// probability of 95 % (the "rule of three", Hanley and Lippman-Hand 1983).
    pub fn drawn(self) -> f64 {
        match self {
            Value::Number(number) => number,
            Value::Rate { count: 0, of } => 3.0 / of.max(1) as f64,
            Value::Rate { count, of } => count as f64 / of.max(1) as f64,
        }
    }

    /// What was measured: 0 of what never happened.
    pub fn measured(self) -> f64 {
        match self {
            Value::Rate { count: 0, .. } => 0.0,
            _ => self.drawn(),
        }
    }

    /// Whether only a limit is known.
    pub fn is_limit(self) -> bool {
        matches!(self, Value::Rate { count: 0, .. })
    }
}
