//! How the light of a scene is made to fit a screen.

use clap::ValueEnum;
use glam::Vec3;
use oktant_shared::tone::{ACES, CLIPPED, REINHARD, tone_mapped};
use serde::Deserialize;

/// A tone curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curve {
    /// Too bright is white.
    #[default]
    None,
    /// Reinhard's, of the luminance.
    Reinhard,
    /// Like that of the Academy Color Encoding System, with a shoulder and a toe.
    Aces,
}

impl Curve {
    /// All of them.
    pub const ALL: [Curve; 3] = [Curve::None, Curve::Reinhard, Curve::Aces];

    /// As the kernel knows it.
    pub fn code(self) -> u32 {
        match self {
            Curve::None => CLIPPED,
            Curve::Reinhard => REINHARD,
            Curve::Aces => ACES,
        }
    }
}

/// Exposure and tone curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tone {
    /// In stops: each doubles the light.
    pub exposure: f32,
    /// The curve.
    pub curve: Curve,
}

impl Tone {
    /// What colours are multiplied with.
    pub fn factor(&self) -> f32 {
        self.exposure.exp2()
    }

    /// A linear colour as linear RGB from 0 to 1.
    pub fn map(&self, color: Vec3) -> Vec3 {
        tone_mapped(color, self.factor(), self.curve.code())
    }
}
