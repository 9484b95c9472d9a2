//! How a picture is shown.

use super::overlay::Overlay;
use crate::tone::Tone;
use bytemuck::Zeroable;
use oktant_shared::present::Present;

/// Which of its rows are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    #[default]
    Whole,
    /// Of two pictures, one above the other, the upper one: the left eye's.
    Upper,
    /// The lower one: the right eye's.
    Lower,
}

/// Tone, and part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Showing {
    /// How the light is made to fit the screen.
    pub tone: Tone,
    /// Which rows.
    pub part: Part,
}

impl Showing {
    /// How a picture of that size and an overlay go onto a surface of that size.
    pub fn present(&self, [width, height]: [u32; 2], overlay: &Overlay, surface: [u32; 2]) -> Present {
        let (height, first_row) = match self.part {
            Part::Whole => (height, 0),
            Part::Upper => (height / 2, 0),
            Part::Lower => (height / 2, height / 2),
        };
        Present {
            width,
            height,
            surface_width: surface[0],
            surface_height: surface[1],
            overlay_width: overlay.width,
            overlay_height: overlay.height,
            exposure: self.tone.factor(),
            curve: self.tone.curve.code(),
            first_row,
            ..Present::zeroed()
        }
    }
}
