//! What the person has set, apart from window, threads and devices.

use super::input::Input;
use crate::sampling::Samples;
use crate::view::{Shading, View};
use glam::Vec3;
use oktant_shared::orbit::Orbit;
use std::path::PathBuf;

/// Degrees that a drag of one pixel turns, at scale factor 1.
const DEGREES_PER_PIXEL: f32 = 0.3;
/// What a notch of the wheel multiplies the distance by.
const CLOSER: f32 = 0.9;
/// Least and greatest distance, radii of the bounding sphere.
const DISTANCES: [f32; 2] = [0.01, 1000.0];
/// Farthest target, radii of the bounding sphere.
const FARTHEST_TARGET: f32 = 1000.0;

/// The state that inputs change.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// What is looked at, and how.
    pub view: View,
    /// The window's size in physical pixels; 0 while it is minimised.
    pub size: [u32; 2],
    /// Physical pixels to a unit.
    pub scale: f64,
    /// Whether the list of keys is shown.
    pub help: bool,
    /// Whether the figures are shown.
    pub figures: bool,
    home: View,
}

/// What an input brings about beyond the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Nothing.
    Nothing,
    /// The overlay has changed.
    Redraw,
    /// Another picture is wanted.
    Render,
    /// The picture is to be saved: into a file, or under the next free name.
    Save(Option<PathBuf>),
    /// A mesh is to be loaded.
    Open(PathBuf),
    /// CPU and GPU change places.
    SwitchBackend,
    /// The window closes.
    Quit,
}

impl Session {
    /// A session that begins with a view, in a window of so many physical pixels.
    pub fn new(view: View, size: [u32; 2], scale: f64) -> Self {
        Session {
            view,
            size,
            scale,
            help: false,
            figures: true,
            home: view,
        }
    }

    /// Takes an input.
    pub fn apply(&mut self, input: Input) -> Effect {
        let before = self.view;
        match input {
            Input::Turn { right, down } => {
                let step = self.degrees_per_pixel();
                let camera = &mut self.view.camera;
                // What is in front follows the pointer, so the camera goes the other way.
                camera.azimuth = wrapped(camera.azimuth - right * step);
                camera.elevation = (camera.elevation + down * step).clamp(-90.0, 90.0);
            }
            Input::TurnLight { right, down } => {
                let step = self.degrees_per_pixel();
                let light = &mut self.view.light;
                light.azimuth = wrapped(light.azimuth + right * step);
                light.elevation = (light.elevation - down * step).clamp(-90.0, 90.0);
            }
            Input::Pan { right, down } => self.pan(right, down),
            Input::Zoom(notches) => {
                let camera = &mut self.view.camera;
                camera.distance = (camera.distance * CLOSER.powf(notches)).clamp(DISTANCES[0], DISTANCES[1]);
            }
            Input::Frame => self.frame(),
            Input::Reset => self.reset(),
            Input::ToggleShading => {
                self.view.shading = match self.view.shading {
                    Shading::Flat => Shading::Phong,
                    Shading::Phong => Shading::Flat,
                };
            }
            Input::NextSamples => {
                let place = Samples::ALL.iter().position(|samples| *samples == self.view.samples);
                let next = place.map_or(0, |place| (place + 1) % Samples::ALL.len());
                self.view.samples = Samples::ALL[next];
            }
            Input::Resize { size, scale } => {
                if (size, scale) == (self.size, self.scale) {
                    return Effect::Nothing;
                }
                (self.size, self.scale) = (size, scale);
                return Effect::Render;
            }
            Input::ToggleHelp => {
                self.help = !self.help;
                return Effect::Redraw;
            }
            Input::ToggleFigures => {
                self.figures = !self.figures;
                return Effect::Redraw;
            }
            Input::SwitchBackend => return Effect::SwitchBackend,
            Input::Save(path) => return Effect::Save(path),
            Input::Open(path) => return Effect::Open(path),
            Input::Quit => return Effect::Quit,
        }
        if self.view == before {
            Effect::Nothing
        } else {
            Effect::Render
        }
    }

    /// Whether there is anything to draw on.
    pub fn is_visible(&self) -> bool {
        self.size[0] > 0 && self.size[1] > 0
    }

    /// Goes back to where camera and light were, as it also happens when another mesh comes; shading and samples stay.
    pub fn reset(&mut self) {
        self.view = View {
            shading: self.view.shading,
            samples: self.view.samples,
            ..self.home
        };
    }

    fn degrees_per_pixel(&self) -> f32 {
        DEGREES_PER_PIXEL / self.scale as f32
    }

    /// Moves the target so that a point at its depth follows the pointer.
    fn pan(&mut self, right: f32, down: f32) {
        let camera = self.view.camera;
        let orbit = Orbit {
            center: Vec3::ZERO,
            radius: camera.distance,
            azimuth: camera.azimuth,
            elevation: camera.elevation,
            up: self.view.up,
        };
        let [to_right, upwards] = orbit.right_and_up();
        let half_height = camera.distance * (self.view.field_of_view.to_radians() / 2.0).tan();
        let per_pixel = 2.0 * half_height / self.size[1].max(1) as f32;
        let target = self.view.target - to_right * (right * per_pixel) + upwards * (down * per_pixel);
        self.view.target = target.clamp_length_max(FARTHEST_TARGET);
    }

    /// Looks at the centre from where the bounding sphere just fits.
    fn frame(&mut self) {
        let half_height = (self.view.field_of_view.to_radians() / 2.0).tan();
        let aspect = self.size[0].max(1) as f32 / self.size[1].max(1) as f32;
        let narrower = (half_height * aspect.min(1.0)).atan();
        self.view.target = Vec3::ZERO;
        self.view.camera.distance = (1.0 / narrower.sin()).clamp(DISTANCES[0], DISTANCES[1]);
    }
}

/// The same angle, at least -180 and less than 180 degrees.
fn wrapped(degrees: f32) -> f32 {
    if (-180.0..180.0).contains(&degrees) {
        degrees
    } else {
        (degrees + 180.0).rem_euclid(360.0) - 180.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Place;

    fn session() -> Session {
        Session::new(View::default(), [800, 600], 1.0)
    }

    #[test]
    fn the_camera_and_the_light_turn() {
        let mut session = session();
        let start = session.view;
        let drag = Input::Turn {
            right: 100.0,
            down: 50.0,
        };
        assert_eq!(session.apply(drag.clone()), Effect::Render);
        let near = |a: f32, b: f32| (a - b).abs() < 1e-3;
        assert!(near(session.view.camera.azimuth, start.camera.azimuth - 30.0));
        assert!(near(session.view.camera.elevation, start.camera.elevation + 15.0));
        assert_eq!(session.view.light, start.light);
        let camera = session.view.camera;
        session.apply(Input::TurnLight {
            right: 100.0,
            down: 50.0,
        });
        assert_eq!(session.view.camera, camera);
        assert!(near(session.view.light.azimuth, start.light.azimuth + 30.0));
        assert!(near(session.view.light.elevation, start.light.elevation - 15.0));
        session.scale = 2.0;
        session.apply(drag);
        assert!(
            (session.view.camera.azimuth - (camera.azimuth - 15.0)).abs() < 1e-3,
            "pixels are smaller"
        );
    }

    #[test]
    fn angles_stay_in_range() {
        let mut session = session();
        for _ in 0..100 {
            session.apply(Input::Turn {
                right: 77.0,
                down: 90.0,
            });
        }
        assert_eq!(session.view.camera.elevation, 90.0);
        assert!((-180.0..180.0).contains(&session.view.camera.azimuth));
        assert_eq!(wrapped(180.0), -180.0);
        assert_eq!(wrapped(-190.0), 170.0);
        let at_the_pole = session.view;
        assert_eq!(
            session.apply(Input::Turn { right: 0.0, down: 5.0 }),
            Effect::Nothing,
            "there is nothing above the pole"
        );
        assert_eq!(session.view, at_the_pole);
    }

    #[test]
    fn the_wheel_has_limits() {
        let mut session = session();
        let before = session.view.camera.distance;
        session.apply(Input::Zoom(2.0));
        assert!((session.view.camera.distance - before * 0.81).abs() < 1e-5);
        session.apply(Input::Zoom(1e9));
        assert_eq!(session.view.camera.distance, DISTANCES[0]);
        session.apply(Input::Zoom(-1e9));
        assert_eq!(session.view.camera.distance, DISTANCES[1]);
        assert_eq!(session.apply(Input::Zoom(-1.0)), Effect::Nothing);
    }

    #[test]
    fn panning_follows_the_pointer() {
        // Where the target was is seen as many pixels from the middle as the pointer went.
        let mut session = session();
        session.view.camera = Place {
            azimuth: 30.0,
            elevation: 40.0,
            distance: 3.0,
        };
        session.apply(Input::Pan {
            right: 60.0,
            down: -45.0,
        });
        let view = session.view;
        let orbit = Orbit {
            center: view.target,
            radius: view.camera.distance,
            azimuth: view.camera.azimuth,
            elevation: view.camera.elevation,
            up: view.up,
        };
        let camera = oktant_shared::camera::Camera::on_orbit(&orbit, view.field_of_view, 800, 600);
        let ray = camera.ray(400.0 + 60.0, 300.0 - 45.0, 0.0);
        let nearest = ray.at(-ray.origin.dot(ray.direction) / ray.direction.length_squared());
        assert!(nearest.length() < 1e-4, "{nearest}");
    }

    #[test]
    fn framing_fits_the_narrower_side_and_reset_goes_home() {
        let mut session = session();
        session.apply(Input::Pan { right: 9.0, down: 9.0 });
        session.apply(Input::Frame);
        assert_eq!(session.view.target, Vec3::ZERO);
        let wide = session.view.camera.distance;
        assert!((wide * 20.0_f32.to_radians().sin() - 1.0).abs() < 1e-5);
        session.apply(Input::Resize {
            size: [300, 600],
            scale: 1.0,
        });
        session.apply(Input::Frame);
        assert!(session.view.camera.distance > 1.5 * wide);
        session.apply(Input::NextSamples);
        session.apply(Input::Reset);
        let home = View {
            samples: Samples::Four,
            ..View::default()
        };
        assert_eq!(session.view, home);
        assert_eq!(session.apply(Input::Reset), Effect::Nothing);
    }

    #[test]
    fn switches() {
        let mut session = session();
        assert_eq!(session.apply(Input::ToggleShading), Effect::Render);
        assert_eq!(session.view.shading, Shading::Flat);
        let counts: Vec<u32> = (0..3)
            .map(|_| {
                session.apply(Input::NextSamples);
                session.view.samples.count()
            })
            .collect();
        assert_eq!(counts, [4, 16, 1]);
        assert_eq!(session.apply(Input::ToggleHelp), Effect::Redraw);
        assert!(session.help);
        assert_eq!(session.apply(Input::ToggleFigures), Effect::Redraw);
        assert!(!session.figures);
        assert_eq!(session.apply(Input::SwitchBackend), Effect::SwitchBackend);
        assert_eq!(session.apply(Input::Save(None)), Effect::Save(None));
        assert_eq!(session.apply(Input::Quit), Effect::Quit);
        let minimised = Input::Resize {
            size: [0, 0],
            scale: 1.0,
        };
        assert_eq!(session.apply(minimised.clone()), Effect::Render);
        assert!(!session.is_visible());
        assert_eq!(session.apply(minimised), Effect::Nothing);
    }
}
