//! What the colours of pixels mean, in figures.

use super::aspect::Aspect;
use super::figures::Figures;
use super::scale::Scale;
use super::{Insight, Values};
use crate::viewer::overlay::{Line, Tone, wrap};
use oktant_shared::parts::TraversalKind;
use serde::Serialize;

/// What a picture of an aspect shows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Legend {
    /// The aspect's name.
    #[serde(rename = "show", serialize_with = "named")]
    pub aspect: Aspect,
    /// What it tells.
    pub meaning: &'static str,
    /// The scale of its colours, if it has numbers.
    pub scale: Option<Scale>,
    /// How its numbers are spread, if it has some.
    pub figures: Option<Figures>,
    /// Different triangles and planes that are seen, if they are told apart.
    pub seen: Option<usize>,
}

fn named<S: serde::Serializer>(aspect: &Aspect, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(aspect.name())
}

/// Most characters in a line.
const COLUMNS: usize = 48;

impl Legend {
    /// The legend of what was told with a traversal; the ends of the scale may be given.
    pub fn new(insight: &Insight, traversal: TraversalKind, range: Option<[f64; 2]>) -> Self {
        let figures = insight.numbers().and_then(Figures::new);
        let seen = match &insight.values {
            Values::Seen(seen) if insight.aspect == Aspect::Ids => {
                let mut ids: Vec<u32> = seen
                    .hits
                    .iter()
                    .filter(|hit| hit.is_hit())
                    .map(|hit| hit.triangle)
                    .collect();
                ids.sort_unstable();
                ids.dedup();
                Some(ids.len())
            }
            _ => None,
        };
        Legend {
            aspect: insight.aspect,
            meaning: insight.aspect.meaning(traversal),
            scale: figures.map(|figures| Scale::new(insight.aspect, &figures, range)),
            figures,
            seen,
        }
    }

    /// In a sentence.
    pub fn sentence(&self) -> String {
        let mut text = format!("{} ({})", self.aspect, self.meaning);
        if let Some(seen) = self.seen {
            text += &format!(": {seen} are seen");
        }
        match (&self.figures, &self.scale) {
            (Some(_), Some(scale)) => {
                text += &format!(
                    ": {}; colours from {} to {}, {}",
                    self.entries().join(", "),
                    number(scale.low),
                    number(scale.high),
                    scale.name()
                );
            }
            _ if self.aspect.is_number() => text += ": no pixel has one",
            _ => {}
        }
        text
    }

    /// As lines of so many characters at most, with a bar of the colours.
    pub(crate) fn lines(&self, columns: usize) -> Vec<Line> {
        let columns = columns.min(COLUMNS);
        let lines = |text: &str, tone| wrap(text, columns).into_iter().map(move |text| Line { text, tone });
        let mut panel: Vec<Line> = lines(&format!("{}: {}", self.aspect, self.meaning), Tone::Strong).collect();
        if let Some(seen) = self.seen {
            panel.extend(lines(&format!("{seen} are seen"), Tone::Plain));
        }
        if let Some(scale) = &self.scale {
            panel.push(Line {
                text: " ".repeat(columns),
                tone: Tone::Gradient(self.aspect.palette()),
            });
            let [low, middle, high] = [0.0, 0.5, 1.0].map(|place| number(scale.number(place)));
            let (side, between) = (columns / 3, columns - 2 * (columns / 3));
            panel.push(Line {
                text: format!("{low:<side$}{middle:^between$}{high:>side$}"),
                tone: Tone::Plain,
            });
            panel.extend(lines(
                &format!("{}; {}", self.entries().join(", "), scale.name()),
                Tone::Plain,
            ));
        } else if self.aspect.is_number() {
            panel.extend(lines("no pixel has a number", Tone::Plain));
        }
        panel
    }

    fn entries(&self) -> Vec<String> {
        let Some(figures) = &self.figures else {
            return Vec::new();
        };
        [
            ("least", figures.least),
            ("median", figures.median),
            ("mean", figures.mean),
            ("99 % up to", figures.percentile_99),
            ("greatest", figures.greatest),
        ]
        .map(|(name, value)| format!("{name} {}", number(value)))
        .into()
    }
}

/// A whole number as it is, another one with four digits.
fn number(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e7 {
        return format!("{value:.0}");
    }
    let magnitude = value.abs().log10().floor();
    if (-3.0..5.0).contains(&magnitude) {
        let decimals = (3.0 - magnitude).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn insight(aspect: Aspect, numbers: Vec<f32>) -> Insight {
        Insight {
            aspect,
            size: [numbers.len() as u32, 1],
            values: Values::Numbers(numbers),
        }
    }

    fn legend(aspect: Aspect, numbers: Vec<f32>, range: Option<[f64; 2]>) -> Legend {
        Legend::new(&insight(aspect, numbers), TraversalKind::Octree, range)
    }

    #[test]
    fn figures_are_told() {
        let told = legend(Aspect::Steps, vec![1.0, 4.0, 3.0, f32::NAN, 2.0, 8.0], None);
        assert_eq!(
            told.sentence(),
            "steps (leaves that the camera ray visits): least 1, median 3, mean 3.600, 99 % up to 8, greatest 8; colours \
             from 1 to 8, linear"
        );
        let texts: Vec<String> = told.lines(40).into_iter().map(|line| line.text).collect();
        assert_eq!(
            texts,
            [
                "steps: leaves that the camera ray visits",
                &" ".repeat(40),
                "1                4.500                 8",
                "least 1, median 3, mean 3.600, 99 % up",
                "to 8, greatest 8; linear",
            ]
        );
        let fixed = legend(Aspect::Tests, vec![7.0], Some([0.0, 500.0]));
        assert!(
            fixed
                .sentence()
                .ends_with("greatest 7; colours from 0 to 500, logarithmic")
        );
    }

    #[test]
    fn where_there_is_nothing_it_says_so() {
        let told = legend(Aspect::Depth, vec![f32::NAN], None);
        assert!(told.sentence().ends_with(": no pixel has one"), "{}", told.sentence());
        assert!(told.lines(30).iter().any(|line| line.text == "no pixel has a number"));
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (69_451.0, "69451"),
            (0.012_345_6, "0.01235"),
            (2.0 / 3.0, "0.6667"),
            (12.345_6, "12.35"),
            (98_765.4, "98765"),
            (1e-7, "1.000e-7"),
            (2.5e9, "2.500e9"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
