//! Noticing that a file was saved.

use super::notice::{Mailbox, Notice};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, SystemTime};
use std::{fs, thread};

/// Between two looks at the files.
const INTERVAL: Duration = Duration::from_millis(125);

/// What tells two versions of a file apart: when it was written, and its length.
type Stamp = (SystemTime, u64);

/// Files as they were when they were read. None for one that nobody has seen like that.
#[derive(Clone, Debug, Default)]
pub struct Stamps(BTreeMap<PathBuf, Option<Stamp>>);

impl Stamps {
    /// Files that were just read, by somebody who began at that time.
    pub fn new(files: Vec<PathBuf>, began: SystemTime) -> Self {
        // What was written meanwhile may have been read before: as if it was never seen, so that it counts as changed.
        let seen = |path: &Path| stamp(path).filter(|(written, _)| *written < began);
        let stamps = files.into_iter().map(|path| {
            let stamp = seen(&path);
            (path, stamp)
        });
        Stamps(stamps.collect())
    }
}

/// The stamp of a file, if it is there.
fn stamp(path: &Path) -> Option<Stamp> {
    let there = fs::metadata(path).ok()?;
    Some((there.modified().unwrap_or(SystemTime::UNIX_EPOCH), there.len()))
}

/// The thread that looks at files; it ends when this is dropped.
pub struct Watcher(Sender<Watch>);

/// What the thread is told.
enum Watch {
    /// To look at these files.
    Only(Stamps),
    /// To look at these files, too.
    Also(Stamps),
}

impl Watcher {
    /// Starts the thread; the mailbox gets this notice whenever one of its files was saved.
    pub fn start(mailbox: Mailbox, notice: fn() -> Notice) -> Self {
        let (sender, files) = channel();
        thread::spawn(move || {
            let mut watched = Watched::default();
            loop {
                match files.recv_timeout(INTERVAL) {
                    Ok(Watch::Only(stamps)) => watched.replace(stamps),
                    Ok(Watch::Also(stamps)) => watched.extend(stamps),
                    Err(RecvTimeoutError::Timeout) if watched.has_changed() => mailbox.send(notice()),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        });
        Watcher(sender)
    }

    /// Looks at these files from now on, and no longer at others.
    pub fn watch(&self, stamps: Stamps) {
        // The thread is gone only when the window is.
        drop(self.0.send(Watch::Only(stamps)));
    }

    /// Looks at these files, too.
    pub fn watch_also(&self, stamps: Stamps) {
        drop(self.0.send(Watch::Also(stamps)));
    }
}

/// Files that are looked at.
#[derive(Default)]
struct Watched {
    stamps: Stamps,
    is_being_written: bool,
}

impl Watched {
    fn replace(&mut self, mut stamps: Stamps) {
        for (path, stamp) in &mut stamps.0 {
            // The older one: what has changed since then has not been noticed yet.
            if let Some(older) = self.stamps.0.get(path) {
                *stamp = *older;
            }
        }
        self.stamps = stamps;
    }

    fn extend(&mut self, stamps: Stamps) {
        for (path, stamp) in stamps.0 {
            self.stamps.0.entry(path).or_insert(stamp);
        }
    }

    /// True once after files have changed, as soon as they rest. One that is missing is about to be replaced.
    fn has_changed(&mut self) -> bool {
        let mut is_being_written = false;
        for (path, seen) in &mut self.stamps.0 {
            let now = stamp(path);
            if now.is_some() && now != *seen {
                *seen = now;
                is_being_written = true;
            }
        }
        let was_being_written = std::mem::replace(&mut self.is_being_written, is_being_written);
        was_being_written && !is_being_written
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looks(watched: &mut Watched) -> [bool; 3] {
        std::array::from_fn(|_| watched.has_changed())
    }

    const NOTHING: [bool; 3] = [false; 3];
    /// At the second look the file rests.
    const ONCE: [bool; 3] = [false, true, false];

    #[test]
    fn every_way_of_saving_is_noticed_once() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        fs::write(file("a"), "one").unwrap();
        fs::write(file("b"), "one").unwrap();
        let mut watched = Watched::default();
        assert_eq!(looks(&mut watched), NOTHING);
        let later = SystemTime::now() + Duration::from_secs(3600);
        watched.replace(Stamps::new(vec![file("a"), file("b"), file("missing")], later));
        assert_eq!(looks(&mut watched), NOTHING);
        fs::write(file("b"), "longer").unwrap();
        assert_eq!(looks(&mut watched), ONCE, "written over");
        fs::write(file("new"), "renamed").unwrap();
        fs::rename(file("new"), file("a")).unwrap();
        assert_eq!(looks(&mut watched), ONCE, "replaced");
        fs::remove_file(file("a")).unwrap();
        assert_eq!(looks(&mut watched), NOTHING, "removed, and about to come back");
        fs::write(file("a"), "back again").unwrap();
        assert_eq!(looks(&mut watched), ONCE);
        fs::write(file("missing"), "here").unwrap();
        assert_eq!(looks(&mut watched), ONCE);
        watched.replace(Stamps::new(vec![file("b")], later));
        fs::write(file("a"), "nobody looks").unwrap();
        assert_eq!(looks(&mut watched), NOTHING);
    }

    #[test]
    fn files_that_are_being_written_are_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        fs::write(&file, "").unwrap();
        let mut watched = Watched::default();
        watched.replace(Stamps::new(
            vec![file.clone()],
            SystemTime::now() + Duration::from_secs(3600),
        ));
        for length in 1..5 {
            fs::write(&file, "x".repeat(length)).unwrap();
            assert!(!watched.has_changed());
        }
        assert!(watched.has_changed());
    }

    #[test]
    fn files_are_added() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        fs::write(file("a"), "one").unwrap();
        let later = SystemTime::now() + Duration::from_secs(3600);
        let mut watched = Watched::default();
        watched.replace(Stamps::new(vec![file("a")], later));
        fs::write(file("a"), "longer").unwrap();
        watched.extend(Stamps::new(vec![file("a"), file("missing")], later));
        assert_eq!(
            looks(&mut watched),
            ONCE,
            "that it is named again does not hide the change"
        );
        fs::write(file("missing"), "here").unwrap();
        assert_eq!(looks(&mut watched), ONCE);
        fs::write(file("a"), "a").unwrap();
        assert_eq!(looks(&mut watched), ONCE);
    }

    #[test]
    fn what_was_saved_while_it_was_read_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        let began = SystemTime::now() - Duration::from_secs(1);
        fs::write(&file, "late").unwrap();
        let mut watched = Watched::default();
        watched.replace(Stamps::new(vec![file.clone()], began));
        assert_eq!(looks(&mut watched), ONCE);
        // The load that follows finds the same, and that is the end of it.
        watched.replace(Stamps::new(vec![file], began));
        assert_eq!(looks(&mut watched), NOTHING);
    }
}
