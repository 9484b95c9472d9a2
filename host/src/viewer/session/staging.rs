//! What surfaces are made of, what shines and what is around, as the person has made it.

use super::{Effect, Session};
use crate::model::white_light;
use crate::scene::Staging;
use crate::view::{Place, View};
use crate::viewer::adjustment::{LightAdjustment, MaterialAdjustment};
use glam::Vec3;
use oktant_shared::orbit::Orbit;

/// A light that is added stands so many degrees beside the first one.
const BESIDE: f32 = 90.0;

impl Session {
    /// A scene has come, with its staging: for the first time or instead of another, or once more, and then what the person
    /// has changed stays, unless it has another staging than before.
    pub fn restage(&mut self, home: Staging, is_again: bool) {
        if !is_again || home != self.home_staging {
            self.staging = home.clone();
        }
        self.home_staging = home;
    }

    /// Where a light stands, as a view says it; none where there is no such light.
    pub fn light_place(&self, index: usize) -> Option<Place> {
        let light = self.staging.lights.get(index)?;
        if index == 0 {
            return Some(self.view.light);
        }
        let mut view = self.view;
        view.shine(light, self.focus);
        Some(view.light)
    }

    /// Where a place is, scene units.
    pub fn position(&self, place: &Place) -> Vec3 {
        let orbit = Orbit {
            center: self.focus.center,
            radius: place.distance * self.focus.radius,
            azimuth: place.azimuth,
            elevation: place.elevation,
            up: self.view.up,
        };
        orbit.position()
    }

    /// Moves a light; the first one is the view's.
    fn place_light(&mut self, index: usize, place: Place) {
        if index == 0 {
            self.view.light = place;
        } else if let Some(light) = self.staging.lights.get_mut(index) {
            let view = View {
                light: place,
                ..self.view
            };
            *light = view.lit(light, self.focus);
        }
    }

    pub(super) fn adjust_light(&mut self, index: usize, adjustment: LightAdjustment) -> Result<(), String> {
        let Some(mut place) = self.light_place(index) else {
            return Err(self.no_light(index));
        };
        match adjustment {
            LightAdjustment::Azimuth(degrees) => place.azimuth = degrees,
            LightAdjustment::Elevation(degrees) => place.elevation = degrees,
            LightAdjustment::Distance(radii) => place.distance = radii,
            LightAdjustment::Position(position) => {
                place = Place::at(position - self.focus.center, self.focus.radius, self.view.up);
            }
            other => {
                other.apply(&mut self.staging.lights[index]);
                return Ok(());
            }
        }
        self.place_light(index, place);
        Ok(())
    }

    pub(super) fn adjust_material(&mut self, index: usize, adjustment: MaterialAdjustment) -> Result<(), String> {
        let count = self.staging.materials.len();
        let Some(material) = self.staging.materials.get_mut(index) else {
            return Err(missing("material", index, count));
        };
        adjustment.apply(material);
        Ok(())
    }

    /// Adds a white point light beside the first one.
    pub(super) fn add_light(&mut self) -> Effect {
        let index = self.staging.lights.len();
        self.staging.lights.push(white_light());
        if index > 0 {
            let first = self.view.light;
            self.place_light(
                index,
                Place {
                    azimuth: super::steering::wrapped(first.azimuth + BESIDE),
                    ..first
                },
            );
        }
        Effect::Restage
    }

    /// Removes a light. After the first one, the view moves the one that follows.
    pub(super) fn remove_light(&mut self, index: usize) -> Effect {
        if index >= self.staging.lights.len() {
            return Effect::Refused(self.no_light(index));
        }
        self.staging.lights.remove(index);
        if let (0, Some(first)) = (index, self.staging.lights.first()) {
            self.view.shine(first, self.focus);
        }
        Effect::Restage
    }

    fn no_light(&self, index: usize) -> String {
        missing("light", index, self.staging.lights.len())
    }
}

/// Why there is no such thing, and what to do.
fn missing(what: &str, index: usize, count: usize) -> String {
    match count {
        0 => format!("there is no {what}; wait until a scene is shown that has one"),
        1 => format!("there is no {what} {index}; there is one, number 0"),
        _ => format!("there is no {what} {index}; give a number from 0 to {}", count - 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Focus, plain_material};
    use crate::viewer::adjustment::Adjustment;
    use crate::viewer::input::Input;
    use oktant_shared::environment::Environment;
    use oktant_shared::light::{DIRECTIONAL, Light};

    fn staging() -> Staging {
        Staging {
            materials: vec![plain_material()],
            lights: vec![white_light()],
            environment: Environment::constant(Vec3::ONE),
            ambient: Vec3::ZERO,
        }
    }

    fn session() -> Session {
        let mut session = Session::new(View::default(), [800, 600], 1.0);
        let focus = Focus {
            center: Vec3::new(1.0, 2.0, 3.0),
            radius: 2.0,
        };
        session.update(View::default(), focus, false);
        session.restage(staging(), false);
        session
    }

    fn set(session: &mut Session, text: &str) -> Effect {
        session.apply(Input::Adjust(Adjustment::parse(text).unwrap()))
    }

    #[test]
    fn lights_come_move_and_go() {
        let mut session = session();
        assert_eq!(session.apply(Input::AddLight), Effect::Restage);
        assert_eq!(session.staging.lights.len(), 2);
        let beside = session.light_place(1).unwrap();
        assert!((beside.azimuth - (session.view.light.azimuth + 90.0)).abs() < 1e-3);
        assert_eq!(set(&mut session, "light 1 position 3,2,3"), Effect::Restage);
        assert_eq!(set(&mut session, "light 1 position 3,2,3"), Effect::Nothing);
        let place = session.light_place(1).unwrap();
        assert!(
            (place.azimuth - 90.0).abs() < 1e-3 && (place.distance - 1.0).abs() < 1e-5,
            "{place:?}"
        );
        assert_eq!(set(&mut session, "light 1 distance 2"), Effect::Restage);
        assert!(session.staging.lights[1].position.distance(Vec3::new(5.0, 2.0, 3.0)) < 1e-4);
        assert_eq!(set(&mut session, "light 1 color 1,0,0"), Effect::Restage);
        assert_eq!(session.staging.lights[1].color, Vec3::X);
        assert_eq!(set(&mut session, "light 0 azimuth 10"), Effect::Render, "the view's");
        assert_eq!(session.view.light.azimuth, 10.0);
        assert_eq!(session.apply(Input::RemoveLight(0)), Effect::Restage);
        let moved = session.view.light;
        assert!(
            (moved.azimuth - 90.0).abs() < 1e-3 && (moved.distance - 2.0).abs() < 1e-4,
            "{moved:?}"
        );
        assert_eq!(session.staging.lights.len(), 1);
        for input in [Input::RemoveLight(1), Input::RemoveLight(7)] {
            assert!(matches!(session.apply(input), Effect::Refused(reason) if reason.contains("number 0")));
        }
        assert_eq!(session.apply(Input::RemoveLight(0)), Effect::Restage);
        assert!(matches!(set(&mut session, "light 0 range 3"), Effect::Refused(_)));
        assert_eq!(session.apply(Input::AddLight), Effect::Restage);
        assert_eq!(session.light_place(0), Some(session.view.light));
    }

    #[test]
    fn directional_lights_turn() {
        let mut session = session();
        session.staging.lights.push(Light {
            kind: DIRECTIONAL,
            position: Vec3::Z,
            ..white_light()
        });
        set(&mut session, "light 1 azimuth 90");
        let position = session.staging.lights[1].position;
        assert!(position.distance(Vec3::X) < 1e-5, "{position}");
    }

    #[test]
    fn materials_and_surroundings_change() {
        let mut session = session();
        assert_eq!(set(&mut session, "material 0 mirror 0.5"), Effect::Restage);
        assert_eq!(session.staging.materials[0].mirror, Vec3::splat(0.5));
        assert_eq!(set(&mut session, "environment color 0.25"), Effect::Restage);
        assert_eq!(session.staging.environment.zenith, Vec3::splat(0.25));
        assert!(matches!(
            set(&mut session, "material 1 mirror 0.5"),
            Effect::Refused(reason) if reason == "there is no material 1; there is one, number 0"
        ));
    }

    #[test]
    fn what_was_changed_stays_unless_the_file_says_something_new() {
        let mut session = session();
        set(&mut session, "material 0 mirror 0.5");
        let mine = session.staging.clone();
        session.restage(staging(), true);
        assert_eq!(session.staging, mine, "nothing is new");
        let saved = Staging {
            ambient: Vec3::ONE,
            ..staging()
        };
        session.restage(saved.clone(), true);
        assert_eq!(session.staging, saved);
        set(&mut session, "material 0 mirror 0.5");
        session.restage(saved.clone(), false);
        assert_eq!(session.staging, saved, "another scene");
    }
}
