//! What can be asked of the viewer.

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
    /// Move the mesh across the line of sight, by a drag in pixels of the window.
    Pan {
        /// To the right.
        right: f32,
        /// Downwards.
        down: f32,
    },
    /// Come closer by so many notches of the wheel; negative ones lead away.
    Zoom(f32),
    /// Fit the mesh into the window.
    Frame,
    /// Go back to the view that the window opened with.
    Reset,
    /// Flat or Phong shading.
    ToggleShading,
    /// 1, 4 or 16 samples a pixel.
    NextSamples,
    /// CPU or GPU.
    SwitchBackend,
    /// The list of keys.
    ToggleHelp,
    /// The figures.
    ToggleFigures,
    /// Save the picture: into a file, or under the next free name.
    Save(Option<PathBuf>),
    /// Look at another mesh.
    Open(PathBuf),
    /// The window has another size now, in physical pixels (0 while it is minimised), and so many of them to a unit.
    Resize {
        /// Width and height.
        size: [u32; 2],
        /// The scale factor, 1 and up.
        scale: f64,
    },
    /// Close the window.
    Quit,
}
