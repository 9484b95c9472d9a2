//! How the panel is laid out, and stays so.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A part of the panel that can be folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// What is opened, and what was.
    Files,
    /// What renders, and what rays are traced through.
    Kernel,
    /// Samples, shading, tone and all else about the picture.
    Picture,
    /// What shines.
    Lights,
    /// What surfaces are made of.
    Materials,
    /// What is around.
    Environment,
    /// Figures.
    Statistics,
}

impl Section {
    /// All of them, the uppermost first.
    pub const ALL: [Section; 7] = [
        Section::Files,
        Section::Kernel,
        Section::Picture,
        Section::Lights,
        Section::Materials,
        Section::Environment,
        Section::Statistics,
    ];

    /// What stands over it.
    pub fn title(self) -> &'static str {
        match self {
            Section::Files => "Files",
            Section::Kernel => "Kernel",
            Section::Picture => "Picture",
            Section::Lights => "Lights",
            Section::Materials => "Materials",
            Section::Environment => "Environment",
            Section::Statistics => "Statistics",
        }
    }
}

/// How wide the panel is, and what of it is unfolded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    /// Points.
    pub width: f32,
    /// The sections that are unfolded.
    pub unfolded: BTreeSet<Section>,
    /// The material that is looked at.
    #[serde(skip)]
    pub material: usize,
}

impl Layout {
    /// Unfolds what is said of a material.
    pub fn show_material(&mut self, index: usize) {
        self.material = index;
        self.unfolded.insert(Section::Materials);
    }

    /// What the open panel leaves of a window's width, pixels, where a point has so many.
    pub fn width_beside(&self, window_width: u32, scale: f64) -> u32 {
        window_width.saturating_sub((f64::from(self.width) * scale).ceil() as u32)
    }
}

impl Default for Layout {
    fn default() -> Self {
        Layout {
            width: 300.0,
            unfolded: [Section::Picture, Section::Statistics].into(),
            material: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::overlay::Overlay;

    #[test]
    fn what_lies_beside_the_panel_is_narrower() {
        let layout = Layout {
            width: 299.5,
            ..Layout::default()
        };
        assert_eq!(layout.width_beside(640, 1.0), 340);
        assert_eq!(layout.width_beside(640, 2.0), 41);
        assert_eq!(layout.width_beside(200, 1.0), 0);
        let columns = |width| Overlay::columns(width, 1);
        assert_eq!(columns(layout.width_beside(640, 1.0)), 38);
        assert_eq!(columns(layout.width_beside(200, 1.0)), 20, "as few as can be read");
    }
}
