//! When to render what: drafts while things change, the finished picture once they rest.

use std::time::{Duration, Instant};

/// So long after the last change the picture is refined.
const REST: Duration = Duration::from_millis(100);

/// How good a picture is to become.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// What is there in time: with fewer pixels where that is needed, with more samples where there is time to spare.
    Draft,
    /// As wanted, in passes.
    Final,
}

/// What there is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Nothing until something happens.
    Nothing,
    /// Render the wanted picture.
    Start(Quality),
    /// Stop what is being rendered: nobody wants it any more.
    Cancel,
    /// Ask again at that time.
    Wait(Instant),
}

/// Follows the picture that is wanted, the one that is rendered and the one that is shown. Pictures are numbered: a
/// change makes the next number the wanted one.
#[derive(Debug)]
pub struct Schedule {
    wanted: u64,
    changed: Instant,
    /// The first change that no picture was begun for.
    unanswered: Option<Instant>,
    /// The first change that the picture to be drawn next is an answer to.
    answered: Option<Instant>,
    running: Option<Running>,
    shown: Option<(u64, Quality)>,
    /// The picture that cannot be had: what is shown in its place is another.
    missing: Option<u64>,
}

#[derive(Debug)]
struct Running {
    number: u64,
    quality: Quality,
    cancelled: bool,
    /// The first change that it is an answer to.
    asked: Option<Instant>,
}

impl Schedule {
    /// Nothing is shown yet.
    pub fn new(now: Instant) -> Self {
        Schedule {
            wanted: 1,
            changed: now,
            unanswered: None,
            answered: None,
            running: None,
            shown: None,
            missing: None,
        }
    }

    /// Another picture is wanted.
    pub fn change(&mut self, now: Instant) {
        self.wanted += 1;
        self.changed = now;
        self.unanswered.get_or_insert(now);
    }

    /// What to do now. Drafts are finished even if they are no longer wanted, so that something is seen to move.
    pub fn next(&mut self, now: Instant) -> Decision {
        if let Some(running) = &mut self.running {
            if running.quality == Quality::Final && running.number != self.wanted && !running.cancelled {
                running.cancelled = true;
                return Decision::Cancel;
            }
            return Decision::Nothing;
        }
        match self.shown {
            Some((number, Quality::Final)) if number == self.wanted => Decision::Nothing,
            Some((number, Quality::Draft)) if number == self.wanted => {
                let rested = self.changed + REST;
                if now >= rested {
                    Decision::Start(Quality::Final)
                } else {
                    Decision::Wait(rested)
                }
            }
            _ => Decision::Start(Quality::Draft),
        }
    }

    /// Rendering of the wanted picture has begun; returns its number.
    pub fn started(&mut self, quality: Quality) -> u64 {
        self.running = Some(Running {
            number: self.wanted,
            quality,
            cancelled: false,
            asked: self.unanswered.take(),
        });
        self.wanted
    }

    /// Whether a picture that was rendered meanwhile should be shown: it is not older than the one that is.
    pub fn takes(&self, number: u64) -> bool {
        self.shown.is_none_or(|(shown, _)| number >= shown)
    }

    /// A picture is shown, of that quality.
    pub fn shows(&mut self, number: u64, quality: Quality) {
        self.shown = Some((number, quality));
        let asked = self.running.as_mut().and_then(|running| running.asked.take());
        self.answered = self.answered.or(asked);
    }

    /// When the first change was that the picture just drawn is an answer to, told once.
    pub fn answered(&mut self) -> Option<Instant> {
        self.answered.take()
    }

    /// What is shown is gone: the window begins anew.
    pub fn shows_nothing(&mut self, now: Instant) {
        self.shown = None;
        self.change(now);
    }

    /// The renderer is free again, but the picture cannot be had: it is not tried again.
    pub fn gives_up(&mut self) {
        if let Some(running) = self.running.take() {
            self.shows(running.number, Quality::Final);
            self.missing = Some(running.number);
        }
    }

    /// The renderer is free again.
    pub fn finished(&mut self) {
        self.running = None;
    }

    /// Whether the wanted picture is shown, finished.
    pub fn is_settled(&self) -> bool {
        self.running.is_none() && self.shown == Some((self.wanted, Quality::Final))
    }

    /// Whether what is shown is the wanted picture, finished, and not one from before because that cannot be had.
    pub fn has_final(&self) -> bool {
        self.is_settled() && self.missing != Some(self.wanted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draft_rest_final() {
        let start = Instant::now();
        let mut schedule = Schedule::new(start);
        assert_eq!(schedule.next(start), Decision::Start(Quality::Draft));
        let number = schedule.started(Quality::Draft);
        assert_eq!(schedule.next(start), Decision::Nothing, "one at a time");
        schedule.shows(number, Quality::Draft);
        schedule.finished();
        assert_eq!(schedule.next(start), Decision::Wait(start + REST));
        let rested = start + REST;
        assert_eq!(schedule.next(rested), Decision::Start(Quality::Final));
        let number = schedule.started(Quality::Final);
        schedule.shows(number, Quality::Final);
        assert!(!schedule.is_settled());
        schedule.finished();
        assert!(schedule.is_settled());
        assert_eq!(schedule.next(rested), Decision::Nothing, "no work without a change");
    }

    #[test]
    fn a_picture_answers_the_first_change_since_the_last_was_begun() {
        let start = Instant::now();
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        let mut schedule = Schedule::new(start);
        schedule.change(at(1));
        schedule.change(at(2));
        let first = schedule.started(Quality::Draft);
        schedule.change(at(3));
        schedule.change(at(4));
        assert_eq!(schedule.answered(), None, "nothing is shown");
        schedule.shows(first, Quality::Draft);
        schedule.finished();
        assert_eq!(schedule.answered(), Some(at(1)));
        assert_eq!(schedule.answered(), None, "once");
        let second = schedule.started(Quality::Draft);
        schedule.shows(second, Quality::Draft);
        schedule.finished();
        let finished = schedule.started(Quality::Final);
        schedule.shows(finished, Quality::Final);
        assert_eq!(
            schedule.answered(),
            Some(at(3)),
            "what was not drawn counts with what is"
        );
    }

    #[test]
    fn what_cannot_be_had_is_not_tried_again() {
        let start = Instant::now();
        let mut schedule = Schedule::new(start);
        schedule.started(Quality::Draft);
        schedule.gives_up();
        assert_eq!(schedule.next(start), Decision::Nothing);
        assert!(schedule.is_settled() && !schedule.has_final());
        schedule.change(start);
        assert_eq!(schedule.next(start), Decision::Start(Quality::Draft));
    }

    #[test]
    fn stale_finals_are_cancelled_once_and_stale_drafts_are_finished() {
        let start = Instant::now();
        let mut schedule = Schedule::new(start);
        let draft = schedule.started(Quality::Draft);
        schedule.change(start);
        assert_eq!(schedule.next(start), Decision::Nothing);
        assert!(schedule.takes(draft));
        schedule.shows(draft, Quality::Draft);
        schedule.finished();
        assert_eq!(schedule.next(start), Decision::Start(Quality::Draft));
        let draft = schedule.started(Quality::Draft);
        schedule.shows(draft, Quality::Draft);
        schedule.finished();
        schedule.started(Quality::Final);
        schedule.change(start);
        assert_eq!(schedule.next(start), Decision::Cancel);
        assert_eq!(schedule.next(start), Decision::Nothing);
        schedule.finished();
        assert_eq!(schedule.next(start), Decision::Start(Quality::Draft));
        let newer = schedule.started(Quality::Draft);
        schedule.shows(newer, Quality::Draft);
        assert!(!schedule.takes(draft), "never back to an older picture");
    }
}
