//! How a view changes from frame to frame of an animation.

mod key;
mod pose;
mod spline;

use crate::scene_file::fault::{Fault, Reason};
use crate::scene_file::place::Place;
use crate::toml_file::{Subject, TomlFileError};
use crate::view::View;
use key::Description;
use pose::Pose;
use spline::Knot;
use std::path::Path;

/// A way of the camera, and of all else that a key frame can say.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraPath {
    /// Once about what is looked at, counterclockwise seen from above; the last frame is one step before the first.
    Turntable,
    /// From the first key frame to the last.
    Keys(KeyFrames),
}

/// Key frames, at least one, the earliest first.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyFrames(Vec<key::Key>);

/// What a file of key frames describes.
const SUBJECT: Subject = Subject {
    file: "camera path",
    whole: "the path",
    relief: "leave some keys out",
    top_fields: &[],
};

impl CameraPath {
    /// Reads a file of key frames; docs/output.md describes it.
    ///
    /// # Errors
    /// Says in one sentence what is wrong first, where, and what to do.
    pub fn read(path: &Path) -> Result<Self, TomlFileError> {
        Self::parse(&SUBJECT.load(path)?, path)
    }

    /// Reads key frames that are in memory; `name` is what errors call them.
    ///
    /// # Errors
    /// As [`CameraPath::read`].
    pub fn parse(text: &str, name: &Path) -> Result<Self, TomlFileError> {
        SUBJECT.parse(text, name, |document| {
            let keys = document.deserialize::<Description>()?.key;
            if keys.is_empty() {
                return Err(Fault::new(&Place::ROOT, Reason::Lacks("[[key]]")));
            }
            let earlier = keys.windows(2).position(|pair| pair[1].time.0 <= pair[0].time.0);
            match earlier {
                Some(index) => {
                    let place = Place::of("key").index(index + 1).key("time");
                    Err(Fault::new(&place, Reason::NotLater))
                }
                None => Ok(CameraPath::Keys(KeyFrames(keys))),
            }
        })
    }

    /// The view of a frame, 1 to `frame_count`. What a key frame leaves out is as in `view`.
    pub fn view(&self, view: &View, frame: u32, frame_count: u32) -> View {
        match self {
            CameraPath::Turntable => {
                let turned = f64::from(frame - 1) / f64::from(frame_count) * 360.0;
                let mut view = *view;
                view.camera.azimuth = (f64::from(view.camera.azimuth) + turned) as f32;
                view
            }
            CameraPath::Keys(KeyFrames(keys)) => {
                let knots: Vec<Knot<{ pose::NUMBERS }>> = keys
                    .iter()
                    .map(|key| Knot {
                        time: key.time.0,
                        value: Pose::of(&key.applied(view)).0,
                    })
                    .collect();
                // The first frame is the first key, and the last the last.
                let part = f64::from(frame - 1) / f64::from((frame_count - 1).max(1));
                let [first, last] = [knots[0].time, knots[knots.len() - 1].time];
                let time = if part == 1.0 {
                    last
                } else {
                    first + (last - first) * part
                };
                Pose(spline::value(&knots, time)).applied(view)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> CameraPath {
        CameraPath::parse(text, Path::new("path.toml")).unwrap()
    }

    fn refused(text: &str) -> String {
        CameraPath::parse(text, Path::new("path.toml")).unwrap_err().to_string()
    }

    #[test]
    fn a_turntable_turns_once_and_does_not_come_back() {
        let view = View::default();
        let azimuths = |count| {
            let of = |frame| CameraPath::Turntable.view(&view, frame, count).camera.azimuth;
            (1..=count).map(of).collect::<Vec<_>>()
        };
        assert_eq!(azimuths(1), [0.0]);
        assert_eq!(azimuths(3), [0.0, 120.0, 240.0]);
        assert_eq!(azimuths(8)[1], 45.0);
    }

    #[test]
    fn keys_are_met_and_what_they_leave_out_is_the_views() {
        let path = parsed(
            "[[key]]\ntime = -1\nazimuth = 700\n[[key]]\ntime = 0\nelevation = 33.3\nfov = 20\ntarget = [1, 2, 3]\n\
             [[key]]\ntime = 1\ndistance = 4\nlight_azimuth = 1\nlight_elevation = 2\nlight_distance = 3\nexposure = -1\n",
        );
        let mut view = View::default();
        view.camera.azimuth = 10.0;
        let at = |frame| path.view(&view, frame, 3);
        let mut first = view;
        first.camera.azimuth = 700.0;
        let mut second = view;
        second.camera.elevation = 33.3;
        second.field_of_view = 20.0;
        second.target = glam::vec3(1.0, 2.0, 3.0);
        let mut third = view;
        third.camera.distance = 4.0;
        third.light = crate::view::Place {
            azimuth: 1.0,
            elevation: 2.0,
            distance: 3.0,
        };
        third.tone.exposure = -1.0;
        assert_eq!([at(1), at(2), at(3)], [first, second, third]);
        // One frame is the first key, one key is every frame.
        assert_eq!(path.view(&view, 1, 1), first);
        let one = parsed("[[key]]\ntime = 5\nazimuth = 700\n");
        assert_eq!([one.view(&view, 1, 9), one.view(&view, 9, 9)], [first, first]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, wanted) in [
            ("", "path.toml:1:1: the path lacks [[key]]; add it"),
            (
                "[[key]]\ntime = 1\n[[key]]\ntime = 1\n",
                "path.toml:4:8: key.time is not later than the key before it; put the keys in the order of their times",
            ),
            ("[[key]]\nazimuth = 1\n", "path.toml:1:1: key lacks time; add it"),
            (
                "[[key]]\ntime = 0\nazimut = 1\n",
                "path.toml:3:1: key has no field \"azimut\"; did you mean \"azimuth\"?",
            ),
            (
                "[[keys]]\ntime = 0\n",
                "path.toml:1:3: the path has no field \"keys\"; did you mean \"key\"?",
            ),
            (
                "[[key]]\ntime = nan\n",
                "path.toml:2:8: key.time is nan; give a number from -1e9 to 1e9",
            ),
            (
                "[[key]]\ntime = 0\nelevation = inf\n",
                "path.toml:3:13: key.elevation is inf; give a number of degrees from -90 to 90",
            ),
            (
                "[[key]]\ntime = 0\ndistance = 0\n",
                "path.toml:3:12: key.distance is 0; give a number of radii from 0.001 to 100000",
            ),
        ] {
            assert_eq!(refused(text), wanted);
        }
        assert!(refused("[[key]\n").starts_with("path.toml:1:7: this is not TOML"));
        let missing = CameraPath::read(Path::new("missing.toml")).unwrap_err().to_string();
        assert!(
            missing.starts_with("missing.toml: the camera path cannot be read"),
            "{missing}"
        );
    }
}
