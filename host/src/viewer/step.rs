//! The steps of a script.

use super::adjustment::NamedMaterial;
use super::event::{Button, Key, Modifiers};
use super::input::Input;
use super::written_camera::Form;
use crate::insight::Aspect;
use std::path::PathBuf;

/// A step of a script.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Drag from the window's middle.
    Drag {
        /// The button held down.
        button: Button,
        /// Whether Shift is, too.
        shift: bool,
        /// Pixels to the right.
        right: f64,
        /// Pixels downwards.
        down: f64,
    },
    /// Click with the left button at a place, physical pixels from the upper left corner.
    Click([f64; 2]),
    /// Double click with the left button.
    DoubleClick,
    /// Turn the wheel by so many notches.
    Wheel(f32),
    /// Press a key.
    Key {
        /// Which.
        key: Key,
        /// What is held down beside it.
        modifiers: Modifiers,
    },
    /// Give the window's inside a size.
    Resize([u32; 2]),
    /// Minimise the window.
    Minimise,
    /// Restore the minimised window.
    Restore,
    /// Drop files on the window.
    Open(Vec<PathBuf>),
    /// Save the picture and wait until it is written.
    Save(PathBuf),
    /// Save what the window shows, overlay and all.
    Screenshot(PathBuf),
    /// Compare the picture with the oracle's, or no longer.
    Oracle(bool),
    /// Open the panel, or close it.
    Panel(bool),
    /// Show what pixels tell in the place of the picture, or the picture.
    Show(Option<Aspect>),
    /// Move the pointer there, in pixels from the upper left corner.
    Move([f64; 2]),
    /// Pin the ray of a pixel.
    Pin([f64; 2]),
    /// Pin none.
    Unpin,
    /// Ask for something without a detour over pointer and keyboard.
    Ask(Input),
    /// Give a material a value that is known by its name.
    SetMaterial(NamedMaterial),
    /// Print the figures.
    Print,
    /// Lose the GPU's device.
    LoseDevice,
    /// Print the camera.
    PrintCamera(Form),
    /// Print all settings.
    PrintSettings,
    /// Wait until nothing changes any more.
    WaitSettled,
    /// Wait until so many new pictures were shown.
    WaitFrames(u64),
    /// Wait until the picture that is shown has so many samples a pixel.
    WaitSamples(u64),
    /// Wait until what is shown was read again because it was saved, even if that went wrong.
    WaitReloaded,
    /// Wait so many milliseconds.
    WaitMilliseconds(u64),
    /// Fail if something is not so.
    Expect(Expectation),
    /// Close the window.
    Quit,
}

/// What a script can insist on.
#[derive(Clone, Debug, PartialEq)]
pub enum Expectation {
    /// The first picture was there within so many milliseconds.
    FirstPicture(u64),
    /// The shown picture was rendered by a GPU, or by the CPU.
    Gpu(bool),
    /// The mesh has so many triangles.
    Triangles(usize),
    /// The overlay's message contains this.
    Message(String),
}
