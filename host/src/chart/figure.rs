//! A figure: panels with the same look, and what is drawn in them.

use super::axis::Axis;
use super::origin::Origin;
use super::pareto::Better;
use super::record::Record;
use serde::{Deserialize, Serialize};

/// A figure of one or more panels, to be saved as SVG, PNG and CSV.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name of its files, without an ending: letters, digits, `-` and `_`.
    pub stem: String,
    /// What is seen, as a sentence.
    pub title: String,
    /// How it was measured and how to read it; wrapped as needed.
    pub explanation: String,
    /// What it shows, from left to right and from above to below.
    pub panels: Vec<Panel>,
    /// The points of all panels. Series are named in the legend, and take their looks, in the order in which they first
    /// appear here.
    pub records: Vec<Record>,
    /// Where the records come from.
    pub origin: Origin,
}

/// A part of a figure with axes of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// What its records call it; also its title.
    pub name: String,
    /// What is to the right.
    pub x: Axis,
    /// What is up.
    pub y: Axis,
    /// Where given: the Pareto front is drawn, and points that are dominated are greyed.
    pub better: Option<[Better; 2]>,
    /// Whether the points of a series are joined, in the order of x.
    pub is_joined: bool,
}

impl Figure {
    /// The names of all series, in the order of the legend.
    pub fn series(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for record in &self.records {
            if !names.contains(&record.series.as_str()) {
                names.push(&record.series);
            }
        }
        names
    }

    /// Takes over what another figure of the same kind has and this one has not: records, panels, and where they come from.
    pub fn merge(&mut self, other: Figure) {
        for panel in other.panels {
            if !self.panels.iter().any(|own| own.name == panel.name) {
                self.panels.push(panel);
            }
        }
        for record in other.records {
            if !self.records.contains(&record) {
                self.records.push(record);
            }
        }
        self.origin.merge(&other.origin);
    }

    /// The records of a panel.
    pub(super) fn records_of<'a>(&'a self, panel: &'a Panel) -> impl Iterator<Item = &'a Record> {
        self.records.iter().filter(|record| record.panel == panel.name)
    }
}
