//! Where the camera stands at once: sides, and views that were saved; and how much it sees.

use super::Session;
use crate::standpoint::{Origin, Standpoint};
use crate::viewer::bearing::Bearing;
use glam::DVec3;

/// Degrees of a step of the field of view.
const STEP: f32 = 5.0;
/// Least and greatest field of view, degrees.
const FIELDS_OF_VIEW: [f32; 2] = [1.0, 170.0];
/// How many views of a scene can be saved.
pub const PLACES: usize = 9;

impl Session {
    /// What places are counted from.
    pub fn origin(&self) -> Origin {
        Origin {
            focus: self.focus,
            shift: self.shift,
        }
    }

    /// From the lower edge of the picture to the upper one, scene units, where rays are parallel.
    pub fn parallel_height(&self) -> Option<f32> {
        let is_parallel = self.view.is_orthographic();
        is_parallel.then(|| self.view.seen_height() * self.focus.radius)
    }

    /// Another scene has come, whose coordinates were moved by that, and of which these views were saved.
    pub fn arrive(&mut self, shift: DVec3, saved: [Option<Standpoint>; PLACES]) {
        (self.shift, self.saved) = (shift, saved);
    }

    /// Looks at what the camera circles from a side.
    pub(super) fn stand(&mut self, bearing: Bearing) {
        self.flight.is_on = false;
        self.view.camera = bearing.place(self.view.up, self.view.camera.distance);
    }

    /// Widens the field of view by so many steps, or says why there is none.
    pub(super) fn widen(&mut self, steps: f32) -> Result<(), String> {
        if self.view.is_orthographic() {
            return Err(
                "parallel rays have no field of view; turn the wheel, or choose perspective with Shift+P".into(),
            );
        }
        let wider = ((self.view.field_of_view / STEP).round() + steps) * STEP;
        self.view.field_of_view = wider.clamp(FIELDS_OF_VIEW[0], FIELDS_OF_VIEW[1]);
        Ok(())
    }

    /// The view that was saved under a number from 1 to [`PLACES`].
    pub fn saved(&self, number: usize) -> Option<Standpoint> {
        self.saved[number - 1]
    }

    /// Saves where the camera stands under a number.
    pub(super) fn save_view(&mut self, number: usize) {
        self.saved[number - 1] = Some(Standpoint::of(&self.view, &self.origin()));
    }

    /// Goes back to where the camera stood then, or says why that cannot be.
    pub(super) fn recall_view(&mut self, number: usize) -> Result<(), String> {
        let standpoint = self
            .saved(number)
            .ok_or_else(|| format!("no view of this scene is saved as {number}; save one with Ctrl+{number}"))?;
        if standpoint.projection != self.view.projection && self.view.stereo.is_some() {
            return Err(super::ONE_EYE.into());
        }
        self.flight.is_on = false;
        self.view = standpoint.applied(&self.view, &self.origin());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Effect, Input};
    use super::*;
    use crate::model::Focus;
    use crate::view::View;
    use glam::Vec3;

    fn session() -> Session {
        Session::new(View::default(), [800, 600], 1.0)
    }

    #[test]
    fn sides_keep_the_distance_and_end_a_flight() {
        let mut session = session();
        session.apply(Input::Pan { right: 20.0, down: 5.0 });
        session.apply(Input::TakeOff);
        let before = session.view;
        assert_eq!(session.apply(Input::Stand(Bearing::Top)), Effect::Render);
        assert_eq!(session.view.camera.elevation, 90.0);
        assert_eq!(session.view.camera.distance, before.camera.distance);
        assert_eq!(session.view.target, before.target);
        assert_eq!(session.flying_speed(), None);
    }

    #[test]
    fn the_field_of_view_goes_in_steps() {
        let mut session = session();
        session.view.field_of_view = 41.3;
        session.apply(Input::Widen(1.0));
        assert_eq!(session.view.field_of_view, 45.0);
        session.apply(Input::Widen(-100.0));
        assert_eq!(session.view.field_of_view, 1.0);
        session.apply(Input::Widen(1.0));
        assert_eq!(session.view.field_of_view, 5.0);
        session.apply(Input::Widen(100.0));
        assert_eq!(session.view.field_of_view, 170.0);
        session.apply(Input::ToggleProjection);
        assert!(matches!(session.apply(Input::Widen(1.0)), Effect::Refused(_)));
    }

    #[test]
    fn saved_views_come_back_to_the_bit() {
        let mut session = session();
        assert!(matches!(session.apply(Input::RecallView(3)), Effect::Refused(reason) if reason.contains("Ctrl+3")));
        session.apply(Input::Turn { right: 33.0, down: 7.0 });
        session.apply(Input::Pan { right: 11.0, down: 3.0 });
        session.apply(Input::ToggleProjection);
        session.apply(Input::Zoom(2.5));
        let saved = session.view;
        assert_eq!(session.apply(Input::SaveView(3)), Effect::ViewSaved(3));
        session.apply(Input::Reset);
        session.apply(Input::NextSamples);
        assert_ne!(session.view, saved);
        assert_eq!(session.apply(Input::RecallView(3)), Effect::Render);
        let samples = session.view.samples;
        assert_eq!(session.view, View { samples, ..saved }, "only the camera is saved");
        session.apply(Input::Reset);
        session.apply(Input::NextStereo);
        assert!(matches!(session.apply(Input::RecallView(3)), Effect::Refused(_)));
    }

    #[test]
    fn they_stay_where_they_were_when_the_scene_grows() {
        let mut session = session();
        session.apply(Input::SaveView(1));
        let eye = |session: &Session| {
            let origin = session.origin();
            session.unit_orbit().position() * origin.focus.radius + origin.focus.center
        };
        let before = eye(&session);
        let larger = Focus {
            center: Vec3::new(0.0, 2.0, 0.0),
            radius: 3.0,
        };
        session.open(View::default(), larger);
        session.apply(Input::RecallView(1));
        assert!(eye(&session).distance(before) < 1e-5);
    }
}
