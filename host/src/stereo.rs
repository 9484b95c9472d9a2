//! Pictures for two eyes.

use clap::ValueEnum;
use oktant_shared::camera::Camera;
use oktant_shared::stereo::{ANAGLYPH, ROWS, SIDE_BY_SIDE, STACKED};
use serde::Deserialize;

/// How two eyes share the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StereoMode {
    /// The left eye's picture at the left, the right eye's beside it, each half as wide.
    SideBySide,
    /// The rows of both in turn, the uppermost the left eye's, for screens that polarise them differently.
    Rows,
    /// One after the other, for shutter glasses: two files, or turns in the window.
    Sequential,
    /// Red for the left eye, green and blue for the right one.
    Anaglyph,
}

/// Stereo, and how deep it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereo {
    /// How two eyes share the screen.
    pub mode: StereoMode,
    /// Between the eyes, scene units; a thirtieth of the convergence where it is not said.
    pub eye_distance: Option<f32>,
    /// The depth that appears on the screen itself, scene units; what the camera looks at where it is not said.
    pub convergence: Option<f32>,
}

/// What people can bear is about this part of the convergence.
const EYE_PART: f32 = 1.0 / 30.0;

impl StereoMode {
    /// Camera rays that each sample of a pixel takes.
    pub fn rays_per_sample(self) -> u32 {
        match self {
            StereoMode::SideBySide | StereoMode::Rows => 1,
            StereoMode::Sequential | StereoMode::Anaglyph => 2,
        }
    }
}

impl Stereo {
    /// Both at their defaults.
    pub fn new(mode: StereoMode) -> Self {
        Stereo {
            mode,
            eye_distance: None,
            convergence: None,
        }
    }

    /// As the kernel knows the mode.
    pub fn code(&self) -> u32 {
        match self.mode {
            StereoMode::SideBySide => SIDE_BY_SIDE,
            StereoMode::Rows => ROWS,
            StereoMode::Sequential => STACKED,
            StereoMode::Anaglyph => ANAGLYPH,
        }
    }

    /// Width and height in pixels of each eye's picture where both together fill so many.
    pub fn eye_size(&self, [width, height]: [u32; 2]) -> [u32; 2] {
        match self.mode {
            StereoMode::SideBySide => [width.div_ceil(2), height],
            _ => [width, height],
        }
    }

    /// Between the eyes, scene units, where the camera looks at something so far away.
    pub fn eyes_apart(&self, distance: f32) -> f32 {
        self.eye_distance
            .unwrap_or(self.convergence.unwrap_or(distance) * EYE_PART)
    }

    /// Gives a camera its eyes; its own depth of convergence is what it looks at.
    pub fn part_eyes(&self, camera: &mut Camera) {
        camera.eye_shift = self.eyes_apart(camera.convergence) / 2.0;
        if let Some(convergence) = self.convergence {
            camera.convergence = convergence;
        }
    }
}
