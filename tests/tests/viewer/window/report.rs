//! What the program says at its end.

use oktant::projection::Projection;
use oktant::sampling::Samples;
use oktant::stereo::{Stereo, StereoMode};
use oktant::tone::{Curve, Tone};
use oktant::view::{Place, Shading, View};
use std::fmt;

/// What a program left behind.
pub struct Report {
    pub code: Option<i32>,
    pub standard_output: String,
    pub standard_error: String,
}

impl Report {
    /// What the step `print` said of something, the last time.
    pub fn value(&self, name: &str) -> String {
        value_in(&self.standard_output, name)
    }

    /// The view that the step `print` printed.
    pub fn view(&self) -> View {
        let numbers = |name: &str| -> Vec<f32> {
            let value = self.value(name);
            value.split(' ').map(|word| word.parse().expect("a number")).collect()
        };
        let place = |name: &str| match numbers(name)[..] {
            [azimuth, elevation, distance] => Place {
                azimuth,
                elevation,
                distance,
            },
            _ => panic!("{name} in {self}"),
        };
        let mode = match self.value("stereo").as_str() {
            "none" => None,
            "anaglyph" => Some(StereoMode::Anaglyph),
            "side-by-side" => Some(StereoMode::SideBySide),
            "rows" => Some(StereoMode::Rows),
            "sequential" => Some(StereoMode::Sequential),
            mode => panic!("stereo {mode} in {self}"),
        };
        let curve = match self.value("tone").as_str() {
            "none" => Curve::None,
            "reinhard" => Curve::Reinhard,
            "aces" => Curve::Aces,
            curve => panic!("tone {curve} in {self}"),
        };
        let projection = match self.value("projection").as_str() {
            "orthographic" => Projection::Orthographic,
            _ => Projection::Perspective,
        };
        let is_parallel = projection == Projection::Orthographic;
        View {
            projection,
            field_of_view: numbers("fov")[0],
            ortho_height: is_parallel.then(|| numbers("seen-height")[0]),
            camera: place("camera"),
            light: place("light"),
            target: glam::Vec3::from_slice(&numbers("target")),
            shading: match self.value("shading").as_str() {
                "flat" => Shading::Flat,
                _ => Shading::Phong,
            },
            samples: match self.value("samples").rsplit(' ').next() {
                Some("4") => Samples::Four,
                Some("16") => Samples::Sixteen,
                Some("64") => Samples::SixtyFour,
                _ => Samples::One,
            },
            depth: numbers("depth")[0] as u32,
            stereo: mode.map(|mode| Stereo {
                mode,
                eye_distance: Some(numbers("eye-distance")[0]),
                convergence: None,
            }),
            tone: Tone {
                exposure: numbers("exposure")[0],
                curve,
            },
            ..View::default()
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "exit code {:?}\n{}\n{}",
            self.code, self.standard_output, self.standard_error
        )
    }
}

/// What stands after a name at the beginning of a line, the last time.
pub fn value_in(text: &str, name: &str) -> String {
    text.lines()
        .rev()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix(' '))
        .unwrap_or_else(|| panic!("no {name} in {text}"))
        .into()
}
