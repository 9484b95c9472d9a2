//! What can be asked of the viewer.

use super::adjustment::Adjustment;
use super::bearing::Bearing;
use super::seeing::See;
use super::written_camera::Form;
use glam::Vec3;
use std::path::PathBuf;

/// Something that a person, or a script, asks for; where it came from can no longer be told.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// Turn the camera on its sphere, by a drag in pixels of the window.
    Turn {
        /// To the right.
        right: f32,
        /// Downwards.
        down: f32,
    },
    /// Turn the light on its sphere, by a drag in pixels of the window.
    TurnLight {
        /// To the right.
        right: f32,
        /// Downwards.
        down: f32,
    },
    /// Move what is seen across the line of sight, by a drag in pixels of the window.
    Pan {
        /// To the right.
        right: f32,
        /// Downwards.
        down: f32,
    },
    /// Come closer by so many notches of the wheel; negative ones lead away.
    Zoom(f32),
    /// Fit what is looked at into the window.
    Frame,
    /// Go back to where camera and light first were.
    Reset,
    /// Flat or Phong shading.
    ToggleShading,
    /// 1, 4, 16 or 64 samples a pixel.
    NextSamples,
    /// Another tone curve.
    NextTone,
    /// Brighter by so many steps of the exposure; negative ones are darker.
    Expose(f32),
    /// So many reflections and refractions more; negative ones are fewer.
    Deepen(i32),
    /// Look at what the camera circles from a side.
    Stand(Bearing),
    /// A wider field of view by so many steps; negative ones are narrower.
    Widen(f32),
    /// Perspective, or parallel rays.
    ToggleProjection,
    /// Remember the camera under a number, 1 to 9.
    SaveView(usize),
    /// Go back to where the camera was then.
    RecallView(usize),
    /// Copy the camera, to be used elsewhere.
    CopyCamera(Form),
    /// Fly, or circle what is in the middle again.
    ToggleFlight,
    /// Fly.
    TakeOff,
    /// Fly in a direction for some time.
    Fly {
        /// How much of it is to the right, upwards and ahead, each -1, 0 or 1.
        heading: Vec3,
        /// Seconds.
        time: f32,
        /// Whether it is to go fast.
        is_fast: bool,
    },
    /// One eye, or another way for two to share the screen.
    NextStereo,
    /// The eyes farther apart by so many steps; negative ones bring them together.
    PartEyes(f32),
    /// Give something a value.
    Adjust(Adjustment),
    /// Look closer at the material of what is there, physical pixels from the window's upper left corner.
    Pick([f64; 2]),
    /// Another light.
    AddLight,
    /// One light less, by its number.
    RemoveLight(usize),
    /// CPU or GPU.
    SwitchBackend,
    /// The list of keys.
    ToggleHelp,
    /// The figures.
    ToggleFigures,
    /// The panel.
    TogglePanel,
    /// The panel, with the keyboard in its line for steps.
    Prompt,
    /// Carry out a step of a script that was typed there.
    Typed(String),
    /// Whether the picture is compared with the oracle's.
    ToggleOracle,
    /// Save the picture: into a file, or under the next free name.
    Save(Option<PathBuf>),
    /// Look at another scene, or at several meshes.
    Open(Vec<PathBuf>),
    /// Look at meshes beside what is shown.
    Add(Vec<PathBuf>),
    /// Let the person choose files to look at; beside what is shown, if that is said.
    Choose {
        /// Whether it is.
        beside: bool,
    },
    /// Look again at what was opened before: the last is 0.
    Recent(usize),
    /// The list of what was opened before.
    ToggleRecent,
    /// The window has another size now, in physical pixels (0 while it is minimised), and so many of them to a unit.
    Resize {
        /// Width and height.
        size: [u32; 2],
        /// The scale factor, 1 and up.
        scale: f64,
    },
    /// See something of the work behind the picture.
    See(See),
    /// Undo what is on top, or close the window.
    Leave,
    /// Close the window.
    Quit,
}
