//! What the person has set, apart from window, threads and devices.

mod adjusting;
mod flight;
mod home;
mod staging;
mod standing;
mod steering;
#[cfg(test)]
mod tests;

pub use standing::PLACES;
pub use steering::DISTANCES;

use super::input::Input;
use super::seeing::{See, Seeing};
use super::written_camera::Form;
use crate::backend::BackendChoice;
use crate::model::Focus;
use crate::sampling::Samples;
use crate::scene::Staging;
use crate::standpoint::Standpoint;
use crate::stereo::{Stereo, StereoMode};
use crate::structure::StructureOptions;
use crate::tone::Curve;
use crate::view::{Shading, View};
use adjusting::ONE_EYE;
use flight::Flight;
use glam::{DVec3, Vec3};
use oktant_shared::parts::TraversalKind;
use oktant_shared::whitted::MAX_DEPTH;
use std::path::PathBuf;

/// Steps of the exposure in a stop.
const EXPOSURE_STEPS: f32 = 3.0;
/// Least and greatest exposure, stops.
const EXPOSURES: [f32; 2] = [-30.0, 30.0];
/// What a step multiplies the distance between the eyes by.
const FARTHER_APART: f32 = 1.1;
/// Least and greatest distance between the eyes, scene units.
const EYE_DISTANCES: [f32; 2] = [1e-12, 1e12];

/// The state that inputs change.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// What is looked at, and how.
    pub view: View,
    /// What is looked at is made of, and what shines on it.
    pub staging: Staging,
    /// What rays are to be traced through.
    pub structure: StructureOptions,
    /// The window's size in physical pixels; 0 while it is minimised.
    pub size: [u32; 2],
    /// Physical pixels to a unit.
    pub scale: f64,
    /// Whether the list of keys is shown.
    pub help: bool,
    /// Whether the list of what was opened before is shown.
    pub recent: bool,
    /// Whether the figures are shown.
    pub figures: bool,
    /// Whether the panel is open.
    pub panel: bool,
    /// Whether the picture is compared with the oracle's.
    pub oracle: bool,
    /// What is shown of the work behind the picture.
    pub seeing: Seeing,
    /// The view that came with the scene, changed as the command line says.
    home: View,
    /// The staging that came with it.
    home_staging: Staging,
    /// What places are counted from.
    focus: Focus,
    /// What the scene's coordinates were moved by: see [`crate::mesh::Mesh::shift`].
    shift: DVec3,
    /// What stereo is, or would be if it was switched on.
    stereo: Stereo,
    /// Whether the camera flies, and how fast.
    flight: Flight,
    /// Views of the scene that were saved, by their numbers less 1.
    saved: [Option<Standpoint>; PLACES],
}

/// What an input brings about beyond the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Nothing.
    Nothing,
    /// The overlay has changed.
    Redraw,
    /// The picture is to be shown in another way.
    Show,
    /// Another picture is wanted.
    Render,
    /// The picture is to be saved: into a file, or under the next free name.
    Save(Option<PathBuf>),
    /// What is looked at is made of something else, or something else shines on it.
    Restage,
    /// The material of what is at that place of the window, physical pixels, is to be shown.
    Pick([f64; 2]),
    /// Another structure is to be built.
    Rebuild,
    /// Something else is to render.
    Backend(BackendChoice),
    /// A scene is to be loaded, or several meshes.
    Open(Vec<PathBuf>),
    /// Meshes are to be loaded beside what is shown.
    Add(Vec<PathBuf>),
    /// The person is to choose files; beside what is shown, if that is said.
    Choose {
        /// Whether it is.
        beside: bool,
    },
    /// What was opened before is to be loaded: the last is 0.
    Recent(usize),
    /// The line for steps is to have the keyboard.
    Prompt,
    /// A step is to be carried out.
    Typed(String),
    /// CPU and GPU change places.
    SwitchBackend,
    /// A view was saved under that number.
    ViewSaved(usize),
    /// The camera is to be copied.
    Copy(Form),
    /// A flight has ended: what is in the middle is to be circled.
    Land,
    /// It cannot be: why, and what to do, in a sentence without its capital and its point.
    Refused(String),
    /// The window closes.
    Quit,
}

impl Session {
    /// A session that begins with a view, in a window of so many physical pixels; nothing is loaded yet.
    pub fn new(view: View, size: [u32; 2], scale: f64) -> Self {
        Session {
            view,
            staging: Staging::default(),
            structure: StructureOptions::default(),
            size,
            scale,
            help: false,
            recent: false,
            figures: true,
            panel: false,
            oracle: false,
            seeing: Seeing::new(TraversalKind::default()),
            home: view,
            home_staging: Staging::default(),
            focus: Focus {
                center: Vec3::ZERO,
                radius: 1.0,
            },
            shift: DVec3::ZERO,
            stereo: view.stereo.unwrap_or(Stereo::new(StereoMode::Anaglyph)),
            flight: Flight::default(),
            saved: [None; PLACES],
        }
    }

    /// Takes an input.
    pub fn apply(&mut self, input: Input) -> Effect {
        let before = self.view;
        match input {
            Input::Turn { right, down } => self.turn(right, down),
            Input::TurnLight { right, down } => self.turn_light(right, down),
            Input::Pan { right, down } => self.pan(right, down),
            Input::Zoom(notches) if self.flight.is_on => {
                self.accelerate(notches);
                return Effect::Redraw;
            }
            Input::Zoom(notches) => self.zoom(notches),
            Input::Frame => self.frame(),
            Input::Reset => self.reset(),
            Input::ToggleShading => {
                self.view.shading = match self.view.shading {
                    Shading::Flat => Shading::Phong,
                    Shading::Phong => Shading::Flat,
                };
            }
            Input::NextSamples => self.view.samples = next(&Samples::ALL, self.view.samples),
            Input::NextTone => self.view.tone.curve = next(&Curve::ALL, self.view.tone.curve),
            Input::Expose(steps) => {
                let exposure = (self.view.tone.exposure * EXPOSURE_STEPS + steps).round() / EXPOSURE_STEPS;
                self.view.tone.exposure = exposure.clamp(EXPOSURES[0], EXPOSURES[1]);
            }
            Input::Deepen(steps) => {
                self.view.depth = self.view.depth.saturating_add_signed(steps).min(MAX_DEPTH);
            }
            Input::Stand(bearing) => self.stand(bearing),
            Input::Widen(_) | Input::ToggleProjection | Input::RecallView(_) => {
                let changed = match input {
                    Input::Widen(steps) => self.widen(steps),
                    Input::RecallView(number) => self.recall_view(number),
                    _ => self.toggle_projection(),
                };
                if let Err(reason) = changed {
                    return Effect::Refused(reason);
                }
            }
            Input::SaveView(number) => {
                self.save_view(number);
                return Effect::ViewSaved(number);
            }
            Input::CopyCamera(form) => return Effect::Copy(form),
            // What lies on top first.
            Input::Leave if self.recent => {
                self.recent = false;
                return Effect::Redraw;
            }
            Input::ToggleFlight | Input::Leave if self.flight.is_on => {
                self.flight.is_on = false;
                return Effect::Land;
            }
            Input::ToggleFlight | Input::TakeOff => {
                self.flight.is_on = true;
                return Effect::Redraw;
            }
            Input::Fly { heading, time, is_fast } => {
                self.flight.is_on = true;
                self.fly(heading, time, is_fast);
            }
            Input::NextStereo if self.view.is_orthographic() => return Effect::Refused(ONE_EYE.into()),
            Input::NextStereo => self.next_stereo(),
            Input::PartEyes(steps) => {
                let apart = self.eye_distance() * FARTHER_APART.powf(steps);
                if let Some(stereo) = &mut self.view.stereo {
                    stereo.eye_distance = Some(apart.clamp(EYE_DISTANCES[0], EYE_DISTANCES[1]));
                    self.stereo = *stereo;
                }
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
            Input::TogglePanel => {
                self.panel = !self.panel;
                return Effect::Redraw;
            }
            Input::Prompt => {
                self.panel = true;
                return Effect::Prompt;
            }
            Input::Typed(step) => return Effect::Typed(step),
            Input::ToggleOracle => {
                self.oracle = !self.oracle;
                return Effect::Redraw;
            }
            Input::See(wish) => {
                self.seeing.apply(wish, &self.view, self.size);
                return Effect::Redraw;
            }
            Input::Leave if self.seeing.pin.is_some() => {
                self.seeing.apply(See::Unpin, &self.view, self.size);
                return Effect::Redraw;
            }
            Input::Adjust(adjustment) => match self.adjust(adjustment) {
                Ok(None) => {}
                Ok(Some(effect)) => return effect,
                Err(reason) => return Effect::Refused(reason),
            },
            Input::Pick(at) => return Effect::Pick(at),
            Input::AddLight => return self.add_light(),
            Input::RemoveLight(index) => return self.remove_light(index),
            Input::SwitchBackend => return Effect::SwitchBackend,
            Input::Save(path) => return Effect::Save(path),
            Input::Open(paths) => return Effect::Open(paths),
            Input::Add(paths) => return Effect::Add(paths),
            Input::Choose { beside } => return Effect::Choose { beside },
            Input::Recent(index) => {
                self.recent = false;
                return Effect::Recent(index);
            }
            Input::ToggleRecent => {
                self.recent = !self.recent;
                return Effect::Redraw;
            }
            Input::Leave | Input::Quit => return Effect::Quit,
        }
        let same_picture = View {
            tone: before.tone,
            ..self.view
        };
        if self.view == before {
            Effect::Nothing
        } else if same_picture == before {
            Effect::Show
        } else {
            Effect::Render
        }
    }

    /// Whether there is anything to draw on.
    pub fn is_visible(&self) -> bool {
        self.size[0] > 0 && self.size[1] > 0
    }

    /// Between the eyes, scene units, if there are two.
    pub fn eye_distance(&self) -> f32 {
        self.stereo.eyes_apart(self.target_distance())
    }

    /// From the camera to what it looks at, scene units.
    pub fn target_distance(&self) -> f32 {
        self.view.camera.distance * self.focus.radius
    }

    /// From one way of sharing the screen to the next; from the last one back to one eye.
    fn next_stereo(&mut self) {
        const MODES: [StereoMode; 4] = [
            StereoMode::Anaglyph,
            StereoMode::SideBySide,
            StereoMode::Rows,
            StereoMode::Sequential,
        ];
        let mode = match self.view.stereo {
            None => Some(MODES[0]),
            Some(stereo) if stereo.mode == MODES[MODES.len() - 1] => None,
            Some(stereo) => Some(next(&MODES, stereo.mode)),
        };
        self.view.stereo = mode.map(|mode| Stereo { mode, ..self.stereo });
        self.stereo = self.view.stereo.unwrap_or(self.stereo);
    }
}

/// What follows a value in a list; the first one follows the last.
fn next<T: Copy + PartialEq>(all: &[T], value: T) -> T {
    let place = all.iter().position(|one| *one == value);
    place.map_or(value, |place| all[(place + 1) % all.len()])
}
