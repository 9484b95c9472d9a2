//! Where a camera stands and how much it sees, in a scene's own coordinates.

use crate::model::Focus;
use crate::projection::Projection;
use crate::view::View;
use clap::ValueEnum;
use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

/// What the places of a view are counted from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// What the scene looks at, in the coordinates of its triangles.
    pub focus: Focus,
    /// What was subtracted from the coordinates of its file: see [`crate::mesh::Mesh::shift`].
    pub shift: DVec3,
}

impl Default for Origin {
    /// That of nothing: a sphere of radius 1 about the origin.
    fn default() -> Self {
        Origin {
            focus: Focus {
                center: Vec3::ZERO,
                radius: 1.0,
            },
            shift: DVec3::ZERO,
        }
    }
}

/// The camera of a view, whatever the scene looks at: lengths are in scene units, coordinates are those of the file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Standpoint {
    /// The point that it looks at and circles.
    pub look_at: [f64; 3],
    /// Where it stands, degrees: 0 in front, counterclockwise seen from above.
    pub azimuth: f32,
    /// How high it stands, degrees above the horizon, -90 to 90.
    pub elevation: f32,
    /// How far it is from what it looks at.
    pub distance: f64,
    /// Whether there is perspective.
    pub projection: Projection,
    /// Vertical field of view, degrees, 1 to 170.
    pub fov: f32,
    /// What an orthographic picture shows from its lower edge to the upper one; none in perspective.
    pub height: Option<f64>,
}

impl Standpoint {
    /// That of a view of a scene.
    pub fn of(view: &View, origin: &Origin) -> Self {
        let radius = f64::from(origin.focus.radius);
        let center = origin.focus.center.as_dvec3() + origin.shift;
        Standpoint {
            look_at: (center + view.target.as_dvec3() * radius).to_array(),
            azimuth: view.camera.azimuth,
            elevation: view.camera.elevation,
            distance: f64::from(view.camera.distance) * radius,
            projection: view.projection,
            fov: view.field_of_view,
            height: view.is_orthographic().then(|| f64::from(view.seen_height()) * radius),
        }
    }

    /// A view from there.
    pub fn applied(&self, view: &View, origin: &Origin) -> View {
        let radius = f64::from(origin.focus.radius);
        let center = origin.focus.center.as_dvec3() + origin.shift;
        let mut view = *view;
        view.target = ((DVec3::from_array(self.look_at) - center) / radius).as_vec3();
        view.camera.azimuth = self.azimuth;
        view.camera.elevation = self.elevation;
        view.camera.distance = (self.distance / radius) as f32;
        view.projection = self.projection;
        view.field_of_view = self.fov;
        view.ortho_height = self.height.map(|height| (height / radius) as f32);
        view
    }

    /// Whether a camera can stand there; a file may say anything.
    pub fn is_sound(&self) -> bool {
        let is_length = |length: f64| (1e-9..=1e9).contains(&length);
        self.look_at.iter().all(|coordinate| coordinate.abs() <= 1e9)
            && self.azimuth.abs() <= 1e6
            && (-90.0..=90.0).contains(&self.elevation)
            && is_length(self.distance)
            && (1.0..=170.0).contains(&self.fov)
            && self.height.is_none_or(is_length)
    }

    /// As the table `[camera]` of a scene file, or a file for `--view`.
    pub fn to_toml(&self) -> String {
        // A billionth of the distance is less than f32 can tell.
        let decimal = |length| decimal(length, self.distance * 1e-9);
        let [x, y, z] = self.look_at.map(decimal);
        let mut text = format!(
            "[camera]\nlook_at = [{x}, {y}, {z}]\nazimuth = {}\nelevation = {}\ndistance = {}\nprojection = \"{}\"\nfov = {}\n",
            self.azimuth,
            self.elevation,
            decimal(self.distance),
            name(self.projection),
            self.fov,
        );
        if let Some(height) = self.height {
            text += &format!("height = {}\n", decimal(height));
        }
        text
    }
}

/// The camera of a view as arguments of `oktant render`, for the same scene.
pub fn arguments(view: &View) -> String {
    let Vec3 { x, y, z } = view.target;
    let mut text = format!(
        "--azimuth={} --elevation={} --distance={} --target={x},{y},{z} --projection={} --fov={}",
        view.camera.azimuth,
        view.camera.elevation,
        view.camera.distance,
        name(view.projection),
        view.field_of_view,
    );
    if view.is_orthographic() {
        // Also where it follows from the others: the scene may say something else.
        text += &format!(" --ortho-height={}", view.seen_height());
    }
    text
}

/// A number with as few digits as bring it so near.
fn decimal(number: f64, near: f64) -> String {
    let near = |text: &String| {
        let read: f64 = text.parse().unwrap_or(f64::NAN);
        (read - number).abs() <= near
    };
    let rounded = (0..20).map(|digits| format!("{number:.digits$}")).find(near);
    rounded.unwrap_or_else(|| number.to_string())
}

fn name(projection: Projection) -> String {
    let value = projection.to_possible_value();
    value.map_or_else(String::new, |value| value.get_name().into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Place;
    use glam::vec3;

    fn view() -> View {
        View {
            camera: Place {
                azimuth: -33.3,
                elevation: 12.7,
                distance: 1.1,
            },
            target: vec3(0.1, -0.7, 1.0 / 3.0),
            projection: Projection::Orthographic,
            field_of_view: 33.3,
            ortho_height: Some(0.7),
            ..View::default()
        }
    }

    fn origin() -> Origin {
        Origin {
            focus: Focus {
                center: vec3(0.03, -20.1, 1e-3),
                radius: 0.77,
            },
            shift: DVec3::new(4.5e6, 0.0, -12.0),
        }
    }

    #[test]
    fn a_view_is_found_again() {
        for origin in [Origin::default(), origin()] {
            let view = view();
            let standpoint = Standpoint::of(&view, &origin);
            assert!(standpoint.is_sound());
            let back = standpoint.applied(&View::default(), &origin);
            assert!(back.target.distance(view.target) < 1e-6);
            assert_eq!(
                View {
                    target: view.target,
                    ..back
                },
                view
            );
        }
    }

    #[test]
    fn it_is_the_same_point_wherever_the_scene_looks() {
        let standpoint = Standpoint::of(&view(), &Origin::default());
        let elsewhere = Origin {
            focus: Focus {
                center: vec3(1.0, 2.0, 3.0),
                radius: 4.0,
            },
            shift: DVec3::ZERO,
        };
        let seen = standpoint.applied(&View::default(), &elsewhere);
        let again = Standpoint::of(&seen, &elsewhere);
        assert!(DVec3::from_array(again.look_at).distance(DVec3::from_array(standpoint.look_at)) < 1e-6);
        assert!((again.distance - standpoint.distance).abs() < 1e-6);
    }

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        for (number, text) in [
            (2.0, "2"),
            (f64::from(0.1_f32), "0.100000001"),
            (0.25, "0.25"),
            (-0.5, "-0.5"),
            (4_500_000.0, "4500000"),
            (0.0, "0"),
        ] {
            assert_eq!(decimal(number, 1e-9), text);
        }
    }

    #[test]
    fn broken_ones_are_noticed() {
        let sound = Standpoint::of(&view(), &Origin::default());
        let broken = [
            Standpoint { fov: 0.0, ..sound },
            Standpoint {
                elevation: f32::NAN,
                ..sound
            },
            Standpoint {
                distance: -1.0,
                ..sound
            },
            Standpoint {
                look_at: [0.0, f64::INFINITY, 0.0],
                ..sound
            },
            Standpoint {
                height: Some(0.0),
                ..sound
            },
        ];
        assert!(sound.is_sound() && broken.iter().all(|one| !one.is_sound()));
    }
}
