//! Pictures for two eyes.

use super::number::Length;
use crate::stereo::{self, StereoMode};
use serde::Deserialize;

/// `[stereo]`: pictures for two eyes.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stereo {
    /// How the eyes share the screen: "side-by-side", "rows", "sequential" or "anaglyph". Default: "side-by-side".
    #[serde(default = "side_by_side")]
    pub mode: StereoMode,
    /// Distance between the eyes, scene units. Default: a thirtieth of the convergence.
    pub eye_distance: Option<Length>,
    /// Depth that appears on the screen itself, scene units. Default: that of what the camera looks at.
    pub convergence: Option<Length>,
}

fn side_by_side() -> StereoMode {
    StereoMode::SideBySide
}

impl Stereo {
    /// What a view takes.
    pub fn build(&self) -> stereo::Stereo {
        stereo::Stereo {
            mode: self.mode,
            eye_distance: self.eye_distance.map(|length| length.0),
            convergence: self.convergence.map(|length| length.0),
        }
    }
}
