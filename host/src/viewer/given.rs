//! What is set of lights, materials and surroundings when a scene is asked for, by the names of a script's steps.

use super::adjustment::{Adjustment, NamedMaterial};
use super::grammar::{split, step};
use super::input::Input;
use super::session::{Effect, Session};
use super::step::Step;
use crate::scene::Staging;
use crate::source::Setting;
use std::fmt;

/// Something that is to be set before anything is built or rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSetting {
    /// As it was written.
    text: String,
    what: What,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    Ask(Input),
    Material(NamedMaterial),
}

/// What is set does not go with what was loaded.
#[derive(Debug, thiserror::Error)]
#[error("--set \"{text}\": {reason}.")]
pub struct Unsettable {
    text: String,
    /// Why, and what to do.
    reason: String,
}

impl GivenSetting {
    /// What `light N NAME VALUE`, `material N NAME VALUE`, `environment NAME VALUE`, `add light` or `remove light N` means.
    ///
    /// # Errors
    /// What is wrong with it and what to do, without its capital and its point.
    pub fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (word, rest) = split(text);
        let line = match word {
            "add" | "remove" => text.to_string(),
            _ => format!("set {text}"),
        };
        let what = match step(&line)? {
            Step::SetMaterial(material) => What::Material(material),
            Step::Ask(Input::Adjust(Adjustment::Picture(_) | Adjustment::Kernel(_))) => {
                return Err(format!("this has an option of its own: --{word} {rest}"));
            }
            Step::Ask(input @ (Input::Adjust(_) | Input::AddLight | Input::RemoveLight(_))) => What::Ask(input),
            _ => return Err("give further meshes beside the first one, for example: oktant view a.ply b.stl".into()),
        };
        Ok(GivenSetting {
            text: text.into(),
            what,
        })
    }

    /// Sets it in what was loaded, one after the other.
    ///
    /// # Errors
    /// [`Unsettable`] for what is not there, or has no such setting.
    pub fn put_all(settings: &[Self], on: &mut Setting) -> Result<(), Unsettable> {
        if settings.is_empty() {
            return Ok(());
        }
        let focus = on.model.focus.unwrap_or_else(|| on.model.mesh.bounding_sphere());
        let mut session = Session::new(on.view, [1, 1], 1.0);
        session.update(on.view, focus, true);
        session.restage(Staging::of_model(&on.model), false);
        for setting in settings {
            let unsettable = |reason| Unsettable {
                text: setting.text.clone(),
                reason,
            };
            let input = match &setting.what {
                What::Ask(input) => input.clone(),
                What::Material(material) => {
                    let number = material.number(&on.names).map_err(unsettable)?;
                    Input::Adjust(Adjustment::Material(number, material.adjustment))
                }
            };
            if let Effect::Refused(reason) = session.apply(input) {
                return Err(unsettable(reason));
            }
        }
        session.staging.put_on(&mut on.model);
        on.view = session.view;
        Ok(())
    }
}

impl fmt::Display for GivenSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balls::balls;
    use crate::model::Model;
    use crate::names::Names;
    use crate::view::View;
    use glam::Vec3;

    fn loaded() -> Setting {
        Setting {
            model: Model::of_mesh(balls()),
            view: View::default(),
            names: Names {
                materials: vec![Some("old wood".into())],
                environment: None,
            },
            size: None,
            files: Vec::new(),
        }
    }

    fn set(texts: &[&str]) -> Result<Setting, String> {
        let settings: Vec<GivenSetting> = texts.iter().map(|text| GivenSetting::parse(text).unwrap()).collect();
        let mut loaded = loaded();
        GivenSetting::put_all(&settings, &mut loaded).map_err(|error| error.to_string())?;
        Ok(loaded)
    }

    #[test]
    fn what_is_given_is_set_in_turn() {
        let set = set(&[
            "material \"old wood\" mirror 0.5",
            "material 0 ior 1.5",
            "add light",
            "light 1 color 1,0,0",
            "light 0 azimuth 10",
            "environment color 0.25",
        ])
        .unwrap();
        let material = set.model.materials[0];
        assert_eq!((material.mirror, material.ior), (Vec3::splat(0.5), 1.5));
        assert_eq!(set.model.lights.len(), 2);
        assert_eq!(set.model.lights[1].color, Vec3::X);
        assert_eq!(set.view.light.azimuth, 10.0);
        assert_eq!(set.model.environment.zenith, Vec3::splat(0.25));
    }

    #[test]
    fn nothing_changes_what_was_loaded_into_nothing_else() {
        let set = set(&[]).unwrap();
        assert_eq!(
            (set.model.materials, set.view),
            (loaded().model.materials, loaded().view)
        );
    }

    #[test]
    fn what_cannot_be_set_is_told() {
        for (text, wanted) in [
            ("sampels 4", "did you mean \"samples\""),
            ("samples 4", "--samples 4"),
            ("traversal bvh2", "--traversal bvh2"),
            ("add mesh a.ply", "oktant view a.ply b.stl"),
            ("light 0 colour 1", "\"color\""),
            ("", "give one of"),
        ] {
            let error = GivenSetting::parse(text).unwrap_err();
            assert!(error.contains(wanted), "{text}: {error}");
        }
        for (text, wanted) in [
            (
                "light 3 range 2",
                "--set \"light 3 range 2\": there is no light 3; there is one, number 0.",
            ),
            ("remove light 1", "number 0."),
            ("material wood ior 2", "give one of \"old wood\"."),
            ("environment strength 2", "give it a color"),
        ] {
            let error = set(&[text]).err().unwrap_or_default();
            assert!(error.contains(wanted), "{text}: {error}");
        }
    }
}
