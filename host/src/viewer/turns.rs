//! The turns that two eyes take where they have one screen between them.

use super::application::Application;
use super::screen::Screen;
use super::showing::Part;
use std::time::{Duration, Instant};

/// A turn on a screen that the CPU draws and that does not say when it was refreshed.
const TURN: Duration = Duration::from_nanos(16_666_667);
/// The least turn on one that the GPU draws: drawing waits for the screen, if the driver can.
const LEAST_TURN: Duration = Duration::from_millis(2);

impl Application {
    /// Plans the other eye's turn, now that one has been shown its picture.
    pub(super) fn plan_turn(&mut self, now: Instant) {
        if self.part == Part::Whole {
            self.next_turn = None;
        } else if self.next_turn.is_none() {
            let is_synchronised = matches!(self.screen, Some(Screen::Gpu(_)));
            self.next_turn = Some(now + if is_synchronised { LEAST_TURN } else { TURN });
        }
    }

    /// It is the other eye's turn.
    pub(super) fn take_turn(&mut self) {
        self.next_turn = None;
        self.part = match self.part {
            Part::Whole => Part::Whole,
            Part::Upper => Part::Lower,
            Part::Lower => Part::Upper,
        };
        self.redraw();
    }
}
