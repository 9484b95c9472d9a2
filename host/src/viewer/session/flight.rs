//! Flying through the scene, and circling again what is in the middle.

use super::{DISTANCES, Session};
use glam::Vec3;
use oktant_shared::orbit::Orbit;

/// What a notch of the wheel multiplies the speed by.
const FASTER: f32 = 1.25;
/// Least and greatest speed, radii of what is looked at a second.
const SPEEDS: [f32; 2] = [1e-3, 1e3];
/// How much faster it goes in a hurry.
const HURRY: f32 = 4.0;
/// Farthest target, radii of what is looked at.
pub const FARTHEST_TARGET: f32 = 1000.0;

/// How the camera moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// Whether keys move it, and drags turn it about itself.
    pub is_on: bool,
    /// How fast, radii of what is looked at a second.
    speed: f32,
}

impl Default for Flight {
    fn default() -> Self {
        Flight {
            is_on: false,
            speed: 0.5,
        }
    }
}

impl Session {
    /// How fast it flies, scene units a second, if it does.
    pub fn flying_speed(&self) -> Option<f32> {
        self.flight.is_on.then_some(self.flight.speed * self.focus.radius)
    }

    /// Flies faster by so many notches of the wheel.
    pub(super) fn accelerate(&mut self, notches: f32) {
        self.flight.speed = (self.flight.speed * FASTER.powf(notches)).clamp(SPEEDS[0], SPEEDS[1]);
    }

    /// Moves the camera, and what it looks at with it: to the right, along the scene's up axis, and ahead.
    pub(super) fn fly(&mut self, heading: Vec3, time: f32, is_fast: bool) {
        let orbit = self.unit_orbit();
        let [right, _] = orbit.right_and_up();
        let [_, up, _] = self.view.up.axes();
        let way = right * heading.x + up * heading.y - orbit.direction() * heading.z;
        let hurry = if is_fast { HURRY } else { 1.0 };
        let moved = self.view.target + way.normalize_or_zero() * (self.flight.speed * hurry * time);
        self.view.target = moved.clamp_length_max(FARTHEST_TARGET);
    }

    /// Turns the camera about itself: what it looks at turns about it.
    pub(super) fn look_around(&mut self, azimuth: f32, elevation: f32) {
        let eye = self.unit_orbit().position();
        let camera = &mut self.view.camera;
        (camera.azimuth, camera.elevation) = (azimuth, elevation);
        let back = self.unit_orbit().direction() * self.view.camera.distance;
        self.view.target = (eye - back).clamp_length_max(FARTHEST_TARGET);
    }

    /// Circles what is so far ahead, in scene units, or as far ahead as before; the camera and what it sees stay.
    pub fn circle(&mut self, depth: Option<f32>) {
        let Some(depth) = depth else { return };
        if self.view.is_orthographic() {
            self.view.ortho_height = Some(self.view.seen_height());
        }
        let eye = self.unit_orbit().position();
        let distance = (depth / self.focus.radius).clamp(DISTANCES[0], DISTANCES[1]);
        self.view.camera.distance = distance;
        self.view.target = eye - self.unit_orbit().direction() * distance;
    }

    /// The camera's sphere, in radii from the middle of what the scene looks at.
    pub(super) fn unit_orbit(&self) -> Orbit {
        let camera = self.view.camera;
        Orbit {
            center: self.view.target,
            radius: camera.distance,
            azimuth: camera.azimuth,
            elevation: camera.elevation,
            up: self.view.up,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Effect, Input};
    use super::*;
    use crate::view::View;

    fn session() -> Session {
        Session::new(View::default(), [800, 600], 1.0)
    }

    fn eye(session: &Session) -> Vec3 {
        session.unit_orbit().position()
    }

    fn fly(session: &mut Session, heading: Vec3, time: f32, is_fast: bool) -> Vec3 {
        let before = eye(session);
        session.apply(Input::Fly { heading, time, is_fast });
        eye(session) - before
    }

    #[test]
    fn keys_lead_where_they_say() {
        let mut session = session();
        session.apply(Input::TakeOff);
        let ahead = -session.unit_orbit().direction();
        assert!(fly(&mut session, Vec3::Z, 2.0, false).distance(ahead) < 1e-5);
        assert!(fly(&mut session, Vec3::NEG_Z, 1.0, true).distance(ahead * -2.0) < 1e-5);
        assert!(fly(&mut session, Vec3::X, 2.0, false).distance(Vec3::X) < 1e-5);
        assert!(fly(&mut session, Vec3::NEG_Y, 2.0, false).distance(Vec3::NEG_Y) < 1e-5);
        let across = fly(&mut session, Vec3::new(1.0, 0.0, 1.0), 2.0, false);
        assert!((across.length() - 1.0).abs() < 1e-5, "no faster across");
    }

    #[test]
    fn many_short_ways_are_a_long_one() {
        let [mut slow, mut quick] = [session(), session()];
        fly(&mut slow, Vec3::Z, 1.0, false);
        for _ in 0..128 {
            fly(&mut quick, Vec3::Z, 1.0 / 128.0, false);
        }
        assert!(eye(&slow).distance(eye(&quick)) < 1e-4);
    }

    #[test]
    fn drags_turn_the_camera_about_itself() {
        let mut session = session();
        session.apply(Input::ToggleFlight);
        let (before, view) = (eye(&session), session.view);
        session.apply(Input::Turn {
            right: 100.0,
            down: 30.0,
        });
        assert!(eye(&session).distance(before) < 1e-5);
        assert!((session.view.camera.azimuth - (view.camera.azimuth - 30.0)).abs() < 1e-3);
        assert!(session.view.target.x > 0.1, "what is ahead lies more to the right");
        assert!(session.view.target.y < -0.1, "and farther down");
    }

    #[test]
    fn the_wheel_makes_it_faster() {
        let mut session = session();
        session.apply(Input::TakeOff);
        let before = session.view;
        assert_eq!(session.apply(Input::Zoom(1.0)), Effect::Redraw);
        assert_eq!(session.view, before);
        assert_eq!(session.flying_speed(), Some(0.625));
        session.apply(Input::Zoom(1e9));
        assert_eq!(session.flying_speed(), Some(SPEEDS[1]));
    }

    #[test]
    fn it_ends_about_what_is_in_the_middle() {
        for projection in crate::projection::Projection::ALL {
            let mut session = session();
            session.view.projection = projection;
            session.apply(Input::ToggleFlight);
            fly(&mut session, Vec3::new(1.0, 1.0, 1.0), 1.5, false);
            let (before, height, ahead) = (
                eye(&session),
                session.view.seen_height(),
                session.unit_orbit().direction(),
            );
            session.apply(Input::ToggleRecent);
            assert_eq!(session.apply(Input::Leave), Effect::Redraw, "the list is closed first");
            assert_eq!(session.apply(Input::Leave), Effect::Land);
            assert_eq!(session.flying_speed(), None);
            session.circle(Some(0.7));
            assert!(eye(&session).distance(before) < 1e-5);
            assert!((session.view.target - (before - ahead * 0.7)).length() < 1e-5);
            if session.view.is_orthographic() {
                assert_eq!(session.view.seen_height(), height);
            }
            let view = session.view;
            session.circle(None);
            assert_eq!(session.view, view, "nothing is there");
            assert_eq!(session.apply(Input::Leave), Effect::Quit);
        }
    }
}
