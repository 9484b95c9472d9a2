//! Files that say where a camera stands, for any scene: what a viewer copies, and `--view` takes.

use crate::projection::Projection;
use crate::scene_file::camera::Camera;
use crate::scene_file::fault::{Fault, Reason};
use crate::scene_file::place::Place;
use crate::standpoint::{Origin, Standpoint};
use crate::toml_file::{Subject, TomlFileError};
use crate::view::{Place as ViewPlace, View};
use glam::DVec3;
use serde::Deserialize;
use std::path::Path;

/// What a file says of the camera; the rest is as the scene has it.
#[derive(Clone, Debug)]
pub struct ViewFile(Camera);

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Description {
    /// As in scene files.
    camera: Camera,
}

const SUBJECT: Subject = Subject {
    file: "view file",
    whole: "the view",
    relief: "leave all but [camera] out",
    top_fields: &[],
};

impl ViewFile {
    /// Reads a file.
    ///
    /// # Errors
    /// Says in one sentence what is wrong first, where, and what to do.
    pub fn read(path: &Path) -> Result<Self, TomlFileError> {
        Self::parse(&SUBJECT.load(path)?, path)
    }

    /// Reads what is in memory; `name` is what errors call it.
    ///
    /// # Errors
    /// As [`ViewFile::read`].
    pub fn parse(text: &str, name: &Path) -> Result<Self, TomlFileError> {
        SUBJECT.parse(text, name, |document| {
            let camera = document.deserialize::<Description>()?.camera;
            let place = Place::of("camera");
            camera.check(&place)?;
            if camera.position.is_some() {
                let Some(look_at) = camera.look_at else {
                    return Err(Fault::new(&place, Reason::Lacks("look_at")));
                };
                camera.offset_from(&place, look_at.0)?;
            }
            Ok(ViewFile(camera))
        })
    }

    /// A view of a scene with the camera where the file says.
    pub fn applied(&self, view: &View, origin: &Origin) -> View {
        let ViewFile(camera) = self;
        let mut standpoint = Standpoint::of(view, origin);
        if let Some(look_at) = camera.look_at {
            standpoint.look_at = look_at.0.to_array();
        }
        if let Some(position) = camera.position {
            let offset = position.0 - DVec3::from_array(standpoint.look_at);
            let place = ViewPlace::at(offset.as_vec3(), 1.0, view.up);
            standpoint.azimuth = place.azimuth;
            standpoint.elevation = place.elevation;
            standpoint.distance = offset.length();
        }
        fn set<T: Copy>(value: &mut T, given: Option<T>) {
            *value = given.unwrap_or(*value);
        }
        set(&mut standpoint.azimuth, camera.azimuth.map(|degrees| degrees.0 as f32));
        set(&mut standpoint.elevation, camera.elevation.map(|degrees| degrees.0));
        set(
            &mut standpoint.distance,
            camera.distance.map(|length| f64::from(length.0)),
        );
        set(&mut standpoint.projection, camera.projection);
        set(&mut standpoint.fov, camera.fov.map(|degrees| degrees.0));
        standpoint.height = match standpoint.projection {
            Projection::Perspective => None,
            Projection::Orthographic => camera.height.map(|length| f64::from(length.0)).or(standpoint.height),
        };
        standpoint.applied(view, origin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Focus;
    use glam::{Vec3, vec3};

    fn origin() -> Origin {
        Origin {
            focus: Focus {
                center: vec3(0.5, 1.0, -2.0),
                radius: 0.4,
            },
            shift: DVec3::new(1000.0, 0.0, 0.0),
        }
    }

    fn seen(text: &str) -> View {
        let file = ViewFile::parse(text, Path::new("view.toml")).unwrap();
        file.applied(&View::default(), &origin())
    }

    #[test]
    fn what_is_copied_is_read_again() {
        let mut view = View {
            target: vec3(0.3, -0.1, 2.0),
            field_of_view: 71.5,
            ..View::default()
        };
        view.camera.azimuth = -77.7;
        for _ in 0..2 {
            let back = seen(&Standpoint::of(&view, &origin()).to_toml());
            assert!(back.target.distance(view.target) < 1e-5);
            assert!((back.camera.distance / view.camera.distance - 1.0).abs() < 1e-6);
            assert!((back.seen_height() / view.seen_height() - 1.0).abs() < 1e-6);
            assert_eq!(
                (
                    back.camera.azimuth,
                    back.camera.elevation,
                    back.field_of_view,
                    back.projection
                ),
                (
                    view.camera.azimuth,
                    view.camera.elevation,
                    view.field_of_view,
                    view.projection
                )
            );
            view.toggle_projection();
            view.ortho_height = Some(3.3);
        }
    }

    #[test]
    fn a_position_is_one_in_the_scenes_file() {
        let view = seen("[camera]\nposition = [1000.5, 1, 2]\nlook_at = [1000.5, 1, -2]\n");
        assert!(view.target.distance(Vec3::ZERO) < 1e-6);
        assert_eq!((view.camera.azimuth, view.camera.elevation), (0.0, 0.0));
        assert!((view.camera.distance - 10.0).abs() < 1e-5);
        let only = seen("[camera]\nfov = 20\n");
        let wanted = View {
            field_of_view: 20.0,
            ..View::default()
        };
        assert!(
            (only.camera.distance - wanted.camera.distance).abs() < 1e-6,
            "the rest stays"
        );
        assert_eq!(only.field_of_view, wanted.field_of_view);
        let file = ViewFile::parse("[camera]\nazimuth = 10\n", Path::new("view.toml")).unwrap();
        let parallel = View {
            projection: Projection::Orthographic,
            ortho_height: Some(3.0),
            ..View::default()
        };
        let turned = file.applied(&parallel, &origin());
        assert!((turned.seen_height() - 3.0).abs() < 1e-6, "also its height");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, wanted) in [
            ("", "view.toml:1:1: the view lacks camera; add it"),
            (
                "[camera]\nposition = [1, 2, 3]\n",
                "view.toml:1:1: camera lacks look_at; add it",
            ),
            (
                "[camera]\nposition = [1, 2, 3]\nlook_at = [1, 2, 3]\n",
                "view.toml:2:12: camera.position is also what the camera looks at; move one of them",
            ),
            (
                "[camera]\nposition = [1, 2, 3]\nlook_at = [0, 2, 3]\nazimuth = 3\n",
                "view.toml:4:11: camera.azimuth does not go together with position; leave one of them out",
            ),
            (
                "[camera]\nprojection = \"perspective\"\nheight = 2\n",
                "view.toml:3:10: camera.height means nothing for perspective; leave it out",
            ),
            (
                "[camera]\nprojection = \"ortographic\"\n",
                "view.toml:2:14: camera.projection is \"ortographic\", but there is no such choice; did you mean \
                 \"orthographic\"?",
            ),
            (
                "[camera]\n[render]\nwidth = 3\n",
                "view.toml:2:2: the view has no field \"render\"; there is only \"camera\"",
            ),
        ] {
            let error = ViewFile::parse(text, Path::new("view.toml")).unwrap_err();
            assert_eq!(error.to_string(), wanted);
        }
    }
}
