//! Rows whose cases are no rays at a mesh that a traversal answers.

use super::clock::quickest;
use super::report::{MethodReport, Role, RowReport};
use super::tally::{Counts, Failure};
use super::{LabError, Plan};

/// A row with a way of its own to run.
pub struct Row {
    /// What a command line calls it.
    pub id: &'static str,
    /// Runs it.
    pub run: fn(&Plan) -> Result<RowReport, LabError>,
}

/// What a row says of itself.
pub struct About {
    /// See [`RowReport`].
    pub id: &'static str,
    /// See [`RowReport`].
    pub family: &'static str,
    /// See [`RowReport`].
    pub title: &'static str,
    /// See [`RowReport`].
    pub input: &'static str,
    /// See [`RowReport`].
    pub remedy: &'static str,
    /// See [`RowReport`].
    pub fails: &'static [&'static str],
}

impl About {
    /// The row's report.
    pub fn report(&self, methods: Vec<MethodReport>) -> RowReport {
        RowReport {
            id: self.id,
            family: self.family,
            title: self.title,
            input: self.input,
            remedy: self.remedy,
            must_fail: self.fails.into(),
            methods,
        }
    }
}

/// A method by name: what is wrong with its answer to a case, one of the kinds of [`Failure`].
pub type Test<C> = (&'static str, Role, fn(&C) -> Option<&'static str>);

/// What all methods make of the cases, on the CPU.
pub fn judged<C>(cases: &[C], tests: &[Test<C>], failure: impl Fn(&C) -> Failure) -> Vec<MethodReport> {
    let mut base = None;
    let report = |(name, role, test): &Test<C>| {
        let (kinds, time) = quickest(|| cases.iter().map(test).collect::<Vec<_>>());
        let seconds = time.as_secs_f64();
        let ratio = seconds / *base.get_or_insert(seconds);
        let of = |wanted| kinds.iter().filter(|kind| **kind == Some(wanted)).count();
        let wrong = cases
            .iter()
            .zip(&kinds)
            .filter_map(|(case, kind)| Some((case, (*kind)?)));
        MethodReport {
            name: (*name).into(),
            role: *role,
            device: "CPU".into(),
            counts: Counts {
                rays: cases.len(),
                missed: of("missed"),
                phantom: of("false"),
                not_finite: of("not finite"),
                ..Counts::default()
            },
            time_ratio: (cases.len() >= 1000).then_some(ratio),
            failures: wrong
                .take(super::subject::KEPT)
                .map(|(case, kind)| Failure { kind, ..failure(case) })
                .collect(),
        }
    };
    tests.iter().map(report).collect()
}
