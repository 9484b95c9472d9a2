//! Which source is loaded, and whether what is shown is to be read again after that.

use super::state::Loading;
use crate::source::Source;

/// Loads that were begun, of which the newest counts.
#[derive(Debug, Default)]
pub struct LoadQueue {
    newest: Option<Loading>,
    begun: u64,
    /// Whether what is shown was saved since it was last read: only one more load follows, however often it was.
    is_stale: bool,
}

impl LoadQueue {
    /// What is being loaded.
    pub fn loading(&self) -> Option<&Loading> {
        self.newest.as_ref()
    }

    /// Another source is wanted, now. Returns the number of its load, which is to be begun.
    pub fn open(&mut self, source: Source) -> u64 {
        // What was saved has not been read: that counts again where the other source cannot be.
        self.is_stale |= self.newest.as_ref().is_some_and(|loading| loading.is_reload);
        self.begin(source, false)
    }

    /// As [`LoadQueue::open`], where the source is what is shown, and more.
    pub fn extend(&mut self, source: Source) -> u64 {
        let load = self.open(source);
        if let Some(loading) = &mut self.newest {
            loading.is_addition = true;
        }
        load
    }

    /// What is shown was saved. Returns the number of the load that is to be begun; none where it has to wait.
    pub fn reload(&mut self, shown: &Source) -> Option<u64> {
        self.is_stale = true;
        self.next(shown)
    }

    /// After a load: the number of the next one, if there is one to be begun.
    pub fn next(&mut self, shown: &Source) -> Option<u64> {
        if !self.is_stale || self.newest.is_some() {
            return None;
        }
        self.is_stale = false;
        Some(self.begin(shown.clone(), true))
    }

    fn begin(&mut self, source: Source, is_reload: bool) -> u64 {
        self.begun += 1;
        self.newest = Some(Loading {
            source,
            stage: "reading",
            fraction: 0.0,
            is_reload,
            is_addition: false,
        });
        self.begun
    }

    /// Takes note of how far a load is. Returns false where nobody cares any more.
    pub fn progressed(&mut self, load: u64, stage: &'static str, fraction: f32) -> bool {
        match &mut self.newest {
            Some(loading) if load == self.begun => {
                (loading.stage, loading.fraction) = (stage, fraction);
                true
            }
            _ => false,
        }
    }

    /// A load is over. Returns what it was about; none where nobody cares any more.
    pub fn ended(&mut self, load: u64, is_successful: bool) -> Option<Loading> {
        let ended = self.newest.take_if(|_| load == self.begun)?;
        // Something else is shown now.
        if is_successful && !ended.is_reload {
            self.is_stale = false;
        }
        Some(ended)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn source(name: &str) -> Source {
        Source::Scene(PathBuf::from(name))
    }

    #[test]
    fn however_often_it_is_saved_one_load_follows() {
        let (mut queue, shown) = (LoadQueue::default(), source("shown"));
        assert_eq!(queue.reload(&shown), Some(1));
        assert_eq!([queue.reload(&shown), queue.reload(&shown)], [None, None]);
        assert!(queue.progressed(1, "building", 0.5));
        for is_successful in [true, false] {
            let load = queue.begun;
            assert!(queue.ended(load, is_successful).unwrap().is_reload);
            assert_eq!(queue.next(&shown), if load == 1 { Some(2) } else { None });
        }
        assert!(queue.loading().is_none());
    }

    #[test]
    fn what_is_saved_while_another_source_fails_is_read() {
        let (mut queue, shown) = (LoadQueue::default(), source("shown"));
        let dropped = queue.open(source("dropped"));
        assert_eq!(queue.reload(&shown), None);
        assert_eq!(queue.ended(dropped, false).unwrap().source, source("dropped"));
        assert_eq!(queue.next(&shown), Some(2));
        // A file that is dropped meanwhile does not wait.
        let dropped = queue.open(source("dropped"));
        assert_eq!(dropped, 3);
        assert!(!queue.progressed(2, "reading", 0.1));
        assert!(queue.ended(2, true).is_none(), "nobody cares any more");
        assert!(queue.ended(dropped, false).is_some());
        let again = queue.next(&shown);
        assert_eq!(again, Some(4), "what was read in vain is read again");
        assert_eq!(queue.loading().unwrap().source, shown);
    }

    #[test]
    fn what_is_no_longer_shown_is_not_read() {
        let (mut queue, shown) = (LoadQueue::default(), source("shown"));
        let dropped = queue.open(source("dropped"));
        assert_eq!(queue.reload(&shown), None);
        assert!(queue.ended(dropped, true).is_some());
        assert_eq!(queue.next(&source("dropped")), None);
    }
}
