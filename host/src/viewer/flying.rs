//! Flying while keys are held down.

use super::application::Application;
use super::input::Input;
use super::pick::depth_at;
use glam::Vec3;
use std::time::{Duration, Instant};

/// Between two moves of the camera: nobody sees a shorter time.
const INTERVAL: Duration = Duration::from_millis(8);
/// No move is longer, so that nobody wakes up far away after the window hung.
const LONGEST: Duration = Duration::from_millis(250);

impl Application {
    /// Flies as far as it goes in the time since the last call, if keys lead somewhere; says when to go on.
    pub(super) fn fly(&mut self, now: Instant) -> Option<Instant> {
        let (heading, is_fast) = self.translation.heading();
        if heading == Vec3::ZERO || self.session.flying_speed().is_none() {
            self.flown = None;
            return None;
        }
        let since = self.flown.replace(now).unwrap_or(now);
        let time = now.saturating_duration_since(since).min(LONGEST).as_secs_f32();
        if time > 0.0 {
            self.take_input(Input::Fly { heading, time, is_fast }, now);
        }
        Some(now + INTERVAL)
    }

    /// Circles what is seen in the middle of the window, if something is.
    pub(super) fn land(&mut self, now: Instant) {
        let session = &self.session;
        let depth = self
            .scene
            .as_ref()
            .and_then(|scene| depth_at(scene, &session.view, session.size));
        self.session.circle(depth);
        self.schedule.change(now);
        self.redraw();
    }
}
