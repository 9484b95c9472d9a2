//! Counts of verdicts.

use std::fmt;

use oktant::oracle::judge::{Excuse, Outcome, Verdict};

const OUTCOMES: [(Outcome, &str); 5] = [
    (Outcome::Agrees, "agrees"),
    (Outcome::Missed, "missed"),
    (Outcome::Farther, "farther"),
    (Outcome::Nearer, "nearer"),
    (Outcome::False, "false"),
];

/// How many verdicts there were of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    counts: [[usize; 3]; 5],
}

impl Tally {
    /// How many with this outcome and excuse.
    pub fn count(&self, outcome: Outcome, excuse: Excuse) -> usize {
        self.counts[outcome as usize][excuse as usize]
    }

    /// How many in all.
    pub fn total(&self) -> usize {
        self.counts.iter().flatten().sum()
    }

    /// How many are wrong without an excuse.
    pub fn wrong(&self) -> usize {
        self.total() - self.count(Outcome::Agrees, Excuse::None) - self.excused()
    }

    /// How many disagree with an excuse.
    pub fn excused(&self) -> usize {
        OUTCOMES.iter().map(|&(outcome, _)| self.excused_as(outcome)).sum()
    }

    /// How many overlooked a hit with an excuse: what they report is missing or farther.
    pub fn overlooked(&self) -> usize {
        self.excused_as(Outcome::Missed) + self.excused_as(Outcome::Farther)
    }

    fn excused_as(&self, outcome: Outcome) -> usize {
        self.count(outcome, Excuse::Edge) + self.count(outcome, Excuse::Limit)
    }
}

impl FromIterator<Verdict> for Tally {
    fn from_iter<I: IntoIterator<Item = Verdict>>(verdicts: I) -> Self {
        let mut tally = Tally::default();
        for verdict in verdicts {
            tally.counts[verdict.outcome as usize][verdict.excuse as usize] += 1;
        }
        tally
    }
}

/// Each outcome as `name wrong+excused`.
impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} rays", self.total())?;
        for (outcome, name) in OUTCOMES {
            let excused = self.excused_as(outcome);
            write!(f, ", {name} {}", self.count(outcome, Excuse::None))?;
            if excused > 0 {
                write!(f, "+{excused}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_are_counted_by_kind() {
        let verdict = |outcome, excuse| Verdict { outcome, excuse };
        let tally: Tally = [
            verdict(Outcome::Agrees, Excuse::None),
            verdict(Outcome::Missed, Excuse::Edge),
            verdict(Outcome::Missed, Excuse::None),
            verdict(Outcome::False, Excuse::Limit),
        ]
        .into_iter()
        .collect();
        assert_eq!((tally.total(), tally.wrong(), tally.excused()), (4, 1, 2));
        assert_eq!(tally.overlooked(), 1);
        assert_eq!(tally.count(Outcome::Missed, Excuse::Edge), 1);
        assert_eq!(
            tally.to_string(),
            "4 rays, agrees 1, missed 1+1, farther 0, nearer 0, false 0+1"
        );
    }
}
