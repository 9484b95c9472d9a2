//! The view that comes with a scene, and what the person has made of it.

use super::Session;
use crate::stereo::Stereo;
use crate::view::View;

impl Session {
    /// Goes back to where camera and light were; how the picture looks stays.
    pub(super) fn reset(&mut self) {
        self.view = View {
            camera: self.home.camera,
            target: self.home.target,
            light: self.home.light,
            ..self.view
        };
    }

    /// Another scene has come, with its view. The shading, the samples and the kind of stereo that the person has chosen
    /// stay.
    pub fn open(&mut self, home: View, radius: f32) {
        let mode = |view: &View| view.stereo.map(|stereo| stereo.mode);
        let stereo = kept(mode(&self.view), mode(&self.home), mode(&home)).map(|mode| Stereo {
            mode,
            // Lengths are in units of the scene.
            ..home.stereo.unwrap_or(Stereo::new(mode))
        });
        self.view = View {
            shading: kept(self.view.shading, self.home.shading, home.shading),
            samples: kept(self.view.samples, self.home.samples, home.samples),
            stereo,
            ..home
        };
        self.stereo = stereo.or(home.stereo).unwrap_or(Stereo::new(self.stereo.mode));
        (self.home, self.radius) = (home, radius);
    }

    /// The scene has come for the first time, or once more after it was saved, with its view: what is new in that
    /// counts, all else stays as the person has left it. Where the scene looks at something else (`is_elsewhere`), the
    /// camera is new in any case.
    pub fn update(&mut self, home: View, radius: f32, is_elsewhere: bool) {
        let (mine, old) = (self.view, self.home);
        let camera = |view: &View| (view.camera, view.target, view.field_of_view, view.up);
        let (camera, target, field_of_view, up) = if is_elsewhere {
            camera(&home)
        } else {
            updated(camera(&mine), camera(&old), camera(&home))
        };
        self.view = View {
            camera,
            target,
            field_of_view,
            up,
            light: updated(mine.light, old.light, home.light),
            shading: updated(mine.shading, old.shading, home.shading),
            samples: updated(mine.samples, old.samples, home.samples),
            pattern: updated(mine.pattern, old.pattern, home.pattern),
            filter: updated(mine.filter, old.filter, home.filter),
            depth: updated(mine.depth, old.depth, home.depth),
            cutoff: updated(mine.cutoff, old.cutoff, home.cutoff),
            stereo: updated(mine.stereo, old.stereo, home.stereo),
            tone: updated(mine.tone, old.tone, home.tone),
        };
        self.stereo = self.view.stereo.unwrap_or(self.stereo);
        (self.home, self.radius) = (home, radius);
    }
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
        session.update(of_a_scene(), 1.0, false);
        assert_eq!(session.view, of_a_scene());
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        session.apply(Input::Reset);
        assert_eq!(session.view, of_a_scene());
        session.open(View::default(), 1.0);
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
        session.open(home, 1.0);
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
        session.update(of_a_scene(), 1.0, false);
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        session.apply(Input::NextSamples);
        session.apply(Input::Deepen(1));
        let mine = session.view;
        session.update(of_a_scene(), 2.0, false);
        assert_eq!(session.view, mine, "nothing is new");
        let saved = View {
            depth: 3,
            ..of_a_scene()
        };
        session.update(saved, 2.0, false);
        assert_eq!(session.view, View { depth: 3, ..mine });
        let camera = Place {
            azimuth: 90.0,
            ..saved.camera
        };
        let saved = View { camera, ..saved };
        session.update(saved, 2.0, false);
        let wanted = View {
            camera,
            depth: 3,
            ..mine
        };
        assert_eq!(session.view, wanted, "the scene's own camera has moved");
        session.apply(Input::Turn { right: 9.0, down: 9.0 });
        session.update(saved, 2.0, true);
        assert_eq!(session.view, wanted, "it looks at something else");
    }
}
