//! Rows whose cases are no rays at a mesh that a traversal answers.

use super::clock::quickest;
use super::report::{MethodReport, Role, RowReport};
use super::tally::{Counts, Failure};
use super::{LabError, Plan};
use crate::mesh::Mesh;
use oktant_shared::ray::Ray;

/// A row with a way of its own to run.
pub struct Row {
    /// What a command line calls it.
    pub id: &'static str,
    /// The mesh at which its rays can be traced again; none where what fails is no ray.
    pub mesh: Option<fn() -> Mesh>,
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

/// What is wrong with a method's answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrong {
    /// One of the kinds of [`Failure`].
    pub kind: &'static str,
    /// The ray that goes wrong, where that is not the case's own.
    pub ray: Option<Ray>,
}

impl Wrong {
    /// If `is_wrong`, in that way.
    pub fn when(is_wrong: bool, kind: &'static str) -> Option<Self> {
        is_wrong.then_some(Wrong { kind, ray: None })
    }

    /// If `is_wrong`: the ray meets something that it should not.
    pub fn ray(is_wrong: bool, ray: Ray) -> Option<Self> {
        is_wrong.then_some(Wrong {
            kind: "false",
            ray: Some(ray),
        })
    }
}

/// A method by name: what is wrong with its answer to a case.
pub type Test<C> = (&'static str, Role, fn(&C) -> Option<Wrong>);

/// What all methods make of the cases, on the CPU.
pub fn judged<C>(cases: &[C], tests: &[Test<C>], failure: impl Fn(&C, &Wrong) -> Failure) -> Vec<MethodReport> {
    let mut base = None;
    let report = |(name, role, test): &Test<C>| {
        let (answers, time) = quickest(|| cases.iter().map(test).collect::<Vec<_>>());
        let seconds = time.as_secs_f64();
        let ratio = seconds / *base.get_or_insert(seconds);
        let of = |kind| answers.iter().flatten().filter(|wrong| wrong.kind == kind).count();
        let wrong = cases
            .iter()
            .zip(&answers)
            .filter_map(|(case, wrong)| Some((case, wrong.as_ref()?)));
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
                .map(|(case, wrong)| Failure {
                    kind: wrong.kind,
                    ..failure(case, wrong)
                })
                .collect(),
        }
    };
    tests.iter().map(report).collect()
}
