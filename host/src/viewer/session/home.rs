//! The view that comes with a scene, and what the person has made of it.

use super::Session;
use crate::model::Focus;
use crate::stereo::Stereo;
use crate::view::{Place, View};
use glam::Vec3;
use oktant_shared::orbit::{Orbit, Up};

impl Session {
    /// Goes back to where camera and light were; how the picture looks stays.
    pub(super) fn reset(&mut self) {
        self.flight.is_on = false;
        self.view = View {
            camera: self.home.camera,
            target: self.home.target,
            projection: self.home.projection,
            field_of_view: self.home.field_of_view,
            ortho_height: self.home.ortho_height,
            light: self.home.light,
            ..self.view
        };
    }

    /// Another scene has come, with its view. The shading, the samples and the kind of stereo that the person has chosen
    /// stay.
    pub fn open(&mut self, home: View, focus: Focus) {
        self.flight.is_on = false;
        let mode = |view: &View| view.stereo.map(|stereo| stereo.mode);
        let mode = kept(mode(&self.view), mode(&self.home), mode(&home));
        // Parallel rays are for one eye.
        let mode = mode.filter(|_| !home.is_orthographic());
        let stereo = mode.map(|mode| Stereo {
            mode,
            // Lengths are in units of the scene.
            ..home.stereo.unwrap_or(Stereo::new(mode))
        });
        self.view = View {
            shading: kept(self.view.shading, self.home.shading, home.shading),
            samples: kept(self.view.samples, self.home.samples, home.samples),
            adaptive: kept(self.view.adaptive, self.home.adaptive, home.adaptive),
            stereo,
            ..home
        };
        self.stereo = stereo.or(home.stereo).unwrap_or(Stereo::new(self.stereo.mode));
        (self.home, self.focus) = (home, focus);
    }

    /// The scene has come for the first time, or once more after it was saved, with its view: what is new in that
    /// counts, all else stays as the person has left it. Where the scene looks at something else (`is_elsewhere`), the
    /// camera is new in any case.
    pub fn update(&mut self, home: View, focus: Focus, is_elsewhere: bool) {
        let (mine, old) = (self.view, self.home);
        let lens = |view: &View| (view.projection, view.field_of_view, view.ortho_height);
        let camera = |view: &View| (view.camera, view.target, lens(view), view.up);
        let (camera, target, (projection, field_of_view, ortho_height), up) = if is_elsewhere {
            camera(&home)
        } else {
            updated(camera(&mine), camera(&old), camera(&home))
        };
        self.view = View {
            camera,
            target,
            projection,
            field_of_view,
            ortho_height,
            up,
            light: self.updated_light(&home, focus),
            shading: updated(mine.shading, old.shading, home.shading),
            samples: updated(mine.samples, old.samples, home.samples),
            adaptive: updated(mine.adaptive, old.adaptive, home.adaptive),
            tolerance: updated(mine.tolerance, old.tolerance, home.tolerance),
            block: updated(mine.block, old.block, home.block),
            pattern: updated(mine.pattern, old.pattern, home.pattern),
            filter: updated(mine.filter, old.filter, home.filter),
            depth: updated(mine.depth, old.depth, home.depth),
            cutoff: updated(mine.cutoff, old.cutoff, home.cutoff),
            stereo: updated(mine.stereo, old.stereo, home.stereo),
            tone: updated(mine.tone, old.tone, home.tone),
        };
        self.stereo = self.view.stereo.unwrap_or(self.stereo);
        if self.view.is_orthographic() {
            // They are for one eye.
            self.view.stereo = None;
        }
        (self.home, self.focus) = (home, focus);
    }
}

impl Session {
    /// The light after [`Session::update`]. One that has its place in the scene keeps it, whatever places are counted
    /// from now.
    fn updated_light(&self, home: &View, focus: Focus) -> Place {
        let (mine, old) = (self.view.light, self.home.light);
        let was_at = position(&old, self.focus, self.home.up);
        let is_at = position(&home.light, focus, home.up);
        if old == home.light {
            mine
        } else if mine == old || was_at.distance(is_at) > SAME_PLACE * focus.radius {
            home.light
        } else {
            Place::at(
                position(&mine, self.focus, self.view.up) - focus.center,
                focus.radius,
                home.up,
            )
        }
    }
}

/// Places nearer to each other than this part of the radius are the same.
const SAME_PLACE: f32 = 1e-3;

/// Where a place is in the scene.
fn position(place: &Place, focus: Focus, up: Up) -> Vec3 {
    let orbit = Orbit {
        center: focus.center,
        radius: place.distance * focus.radius,
        azimuth: place.azimuth,
        elevation: place.elevation,
        up,
    };
    orbit.position()
}

/// What was chosen, if it was, else what is new.
fn kept<T: PartialEq>(chosen: T, old: T, new: T) -> T {
    if chosen == old { new } else { chosen }
}

/// What is new, if it is, else what was chosen.
fn updated<T: PartialEq>(chosen: T, old: T, new: T) -> T {
    if new == old { chosen } else { new }
}

#[cfg(test)]
mod tests {
    use super::super::Input;
    use super::*;
    use crate::sampling::Samples;
    use crate::stereo::StereoMode;
    use crate::tone::{Curve, Tone};
    use crate::view::{Place, Shading};

    const FOCUS: Focus = Focus {
        center: Vec3::ZERO,
        radius: 1.0,
    };
    const LARGER: Focus = Focus {
        center: Vec3::Y,
        radius: 2.0,
    };

    fn session() -> Session {
        Session::new(View::default(), [800, 600], 1.0)
    }

    /// A view as a scene might bring it.
    fn of_a_scene() -> View {
        View {
            camera: Place {
                azimuth: 10.0,
                elevation: 20.0,
                distance: 2.0,
            },
            samples: Samples::Four,
            depth: 9,
            tone: Tone {
                exposure: 0.5,
                curve: Curve::Aces,
            },
            ..View::default()
        }
    }

    #[test]
    fn a_scene_comes_with_its_view() {
        let mut session = session();
        session.update(of_a_scene(), FOCUS, false);
        assert_eq!(session.view, of_a_scene());
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        session.apply(Input::Reset);
        assert_eq!(session.view, of_a_scene());
        session.open(View::default(), FOCUS);
        assert_eq!(session.view, View::default(), "nothing was chosen");
    }

    #[test]
    fn what_was_chosen_stays_when_another_scene_comes() {
        let mut session = session();
        session.apply(Input::NextSamples);
        session.apply(Input::ToggleShading);
        session.apply(Input::NextStereo);
        session.apply(Input::PartEyes(5.0));
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        let home = View {
            samples: Samples::Sixteen,
            ..of_a_scene()
        };
        session.open(home, FOCUS);
        let wanted = View {
            samples: Samples::Four,
            shading: Shading::Flat,
            stereo: Some(Stereo::new(StereoMode::Anaglyph)),
            ..home
        };
        assert_eq!(session.view, wanted);
    }

    #[test]
    fn what_is_new_in_a_saved_scene_counts_and_the_rest_stays() {
        let mut session = session();
        session.update(of_a_scene(), FOCUS, false);
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        session.apply(Input::NextSamples);
        session.apply(Input::Deepen(1));
        let mine = session.view;
        session.update(of_a_scene(), LARGER, false);
        assert_eq!(session.view, mine, "nothing is new");
        let saved = View {
            depth: 3,
            ..of_a_scene()
        };
        session.update(saved, LARGER, false);
        assert_eq!(session.view, View { depth: 3, ..mine });
        let camera = Place {
            azimuth: 90.0,
            ..saved.camera
        };
        let saved = View { camera, ..saved };
        session.update(saved, LARGER, false);
        let wanted = View {
            camera,
            depth: 3,
            ..mine
        };
        assert_eq!(session.view, wanted, "the scene's own camera has moved");
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        session.update(saved, LARGER, true);
        assert_eq!(session.view, wanted, "it looks at something else");
    }

    #[test]
    fn lights_keep_their_places_in_the_scene() {
        let of = |position: Vec3, focus: Focus| View {
            light: Place::at(position - focus.center, focus.radius, Up::Y),
            ..View::default()
        };
        let at = |session: &Session| position(&session.view.light, session.focus, session.view.up);
        let lamp = Vec3::new(3.0, 4.0, 5.0);
        let mut session = session();
        session.update(of(lamp, FOCUS), FOCUS, false);
        session.update(of(lamp, LARGER), LARGER, false);
        assert!(at(&session).distance(lamp) < 1e-5);
        session.apply(Input::TurnLight { right: 50.0, down: 9.0 });
        let moved = at(&session);
        assert!(moved.distance(lamp) > 1.0);
        session.update(of(lamp, FOCUS), FOCUS, false);
        assert!(
            at(&session).distance(moved) < 1e-5,
            "only the ball around all has shrunk"
        );
        session.update(of(lamp + Vec3::X, FOCUS), FOCUS, false);
        assert!(
            at(&session).distance(lamp + Vec3::X) < 1e-5,
            "the scene's own light has moved"
        );
    }
}
