//! What the lab found.

use super::tally::{Counts, Failure};
use serde::Serialize;

/// All rows.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Of oktant.
    pub version: &'static str,
    /// Rays of each row, where there are not fewer.
    pub rays: usize,
    /// Where methods ran.
    pub devices: Vec<String>,
    /// How GPUs round a fused multiply-add.
    pub arithmetic: Vec<String>,
    /// One for each failure mode.
    pub rows: Vec<RowReport>,
}

/// A failure mode.
#[derive(Clone, Debug, Serialize)]
pub struct RowReport {
    /// What a command line calls it.
    pub id: &'static str,
    /// What it is about.
    pub family: &'static str,
    /// What fails.
    pub title: &'static str,
    /// The mesh or box, and the rays.
    pub input: &'static str,
    /// What is done about it.
    pub remedy: &'static str,
    /// Names of the methods that must fail, so that the row shows something.
    pub must_fail: Vec<&'static str>,
    /// What each method made of it, the default first.
    pub methods: Vec<MethodReport>,
}

/// What one method made of a failure mode.
#[derive(Clone, Debug, Serialize)]
pub struct MethodReport {
    /// Its name: the parts, or what it does.
    pub name: String,
    /// What it is.
    pub role: Role,
    /// Where it ran.
    pub device: String,
    /// How many answers are wrong.
    pub counts: Counts,
    /// Its time in parts of that of the first method there; none where there are too few rays to tell.
    pub time_ratio: Option<f64>,
    /// The first wrong answers.
    pub failures: Vec<Failure>,
}

/// What a method is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// What oktant does unless told otherwise.
    Default,
    /// The default as a GPU that contracts products and sums computes it.
    Twin,
    /// What can be chosen.
    Offered,
    /// What is only shown.
    Exhibit,
}

impl Role {
    /// Whether it must not fail.
    pub fn must_be_right(self) -> bool {
        matches!(self, Role::Default | Role::Twin)
    }
}

impl RowReport {
    /// Wrong answers of the default, wherever it ran.
    pub fn wrong_of_the_default(&self) -> usize {
        let default = self.methods.iter().filter(|method| method.role.must_be_right());
        default.map(|method| method.counts.wrong()).sum()
    }

    /// Methods that must fail on the CPU and did not: with more rays they do.
    pub fn idle(&self) -> Vec<&'static str> {
        let fails = |name: &&'static str| {
            let mut same = self
                .methods
                .iter()
                .filter(|method| method.triangle_test_or_name() == *name);
            same.any(|method| method.counts.wrong() > 0)
        };
        self.must_fail.iter().copied().filter(|name| !fails(name)).collect()
    }
}

impl MethodReport {
    /// Of parts that differ from the default in the triangle test alone, that test's name.
    fn triangle_test_or_name(&self) -> &str {
        self.name.strip_prefix("octants, ").unwrap_or(&self.name)
    }
}

impl Report {
    /// Wrong answers of the default in all rows.
    pub fn wrong_of_the_default(&self) -> usize {
        self.rows.iter().map(RowReport::wrong_of_the_default).sum()
    }
}
