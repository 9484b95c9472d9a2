//! What pixels are to tell of the work behind them.

use clap::{Args, ValueEnum};
use oktant::insight::Aspect;

/// What to show instead of the scene.
#[derive(Clone, Debug, Default, Args)]
pub struct InsightArguments {
    /// Show what pixels tell of the work behind them instead of the scene, counted on the CPU; an EXR file holds the numbers
    /// themselves. docs/insight.md says more.
    #[arg(
        long,
        value_enum,
        value_name = "ASPECT",
        conflicts_with_all = ["bits", "aov", "exposure", "tone", "repeat", "variant", "reference", "kernel", "spirv", "frames"],
    )]
    pub show: Option<Aspect>,
    /// The numbers at the ends of the colours, so that two pictures can be compared [default: the least and the greatest].
    #[arg(long, value_name = "LOW..HIGH", allow_hyphen_values = true, value_parser = range, requires = "show")]
    pub range: Option<[f64; 2]>,
    /// Whether the legend is drawn below a PNG picture [default: on].
    #[arg(long, value_enum, requires = "show")]
    pub legend: Option<Switch>,
}

/// On or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    On,
    Off,
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let wanted = "give the least and the greatest number, for example 0..60";
    let (low, high) = text.split_once("..").ok_or(wanted)?;
    match [low, high].map(|end| end.trim().parse::<f64>()) {
        [Ok(low), Ok(high)] if low < high && low.is_finite() && high.is_finite() => Ok([low, high]),
        _ => Err(wanted.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges() {
        assert_eq!(range("0..60"), Ok([0.0, 60.0]));
        assert_eq!(range("-1.5 .. 2e3"), Ok([-1.5, 2000.0]));
        for bad in ["", "5", "5..", "..5", "5..5", "6..5", "0..inf", "NaN..1", "0-5"] {
            assert!(range(bad).is_err(), "{bad}");
        }
    }
}
