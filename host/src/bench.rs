//! What is measured, and how: the thesis's pictures, and all parts on sets of rays that the oracle has answered.

mod counting;
mod judgement;
mod parts_bench;
mod report;
mod subject;
mod tables;
mod thesis;
mod tracer;
mod workload;

pub use counting::{Counts, count, count_each};
pub use judgement::{Disagreement, Judgement, Truth};
pub use parts_bench::{BRUTE_BUDGET, MeasureError, Plan, measure};
pub use report::{CombinationReport, PartNames, Report, SetReport, SpeedReport, SubjectReport, TruthReport};
pub use subject::{JudgedSet, Subject};
pub use tables::{Style, tables};
pub use thesis::{ThesisError, ThesisReport, ThesisRow, thesis};
pub use tracer::{Device, Tracer};
pub use workload::Workload;
