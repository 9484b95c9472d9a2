//! What went wrong on a device while nobody asked.

use std::sync::{Arc, Mutex, PoisonError};

/// Something that a device cannot go on after.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// It is gone, with all that lay in its memory; another may be opened.
    Lost(String),
    /// It did something wrong, or was asked to.
    Mistake(String),
}

/// The first failure of a device, shared with those that it tells.
#[derive(Clone, Default)]
pub(super) struct Record(Arc<Mutex<Option<Failure>>>);

impl Record {
    /// Takes note of a failure. The first counts, but that a device is lost explains all others.
    pub(super) fn take(&self, failure: Failure) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_worse = match &*first {
            None => true,
            Some(Failure::Mistake(_)) => matches!(failure, Failure::Lost(_)),
            Some(Failure::Lost(_)) => false,
        };
        if is_worse {
            *first = Some(failure);
        }
    }

    /// What counts so far.
    pub(super) fn failure(&self) -> Option<Failure> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loss_explains_what_went_wrong_before() {
        let record = Record::default();
        assert_eq!(record.failure(), None);
        for (failure, counts) in [
            (Failure::Mistake("one".into()), Failure::Mistake("one".into())),
            (Failure::Mistake("two".into()), Failure::Mistake("one".into())),
            (Failure::Lost("gone".into()), Failure::Lost("gone".into())),
            (Failure::Mistake("three".into()), Failure::Lost("gone".into())),
        ] {
            record.take(failure);
            assert_eq!(record.failure(), Some(counts));
        }
    }
}
