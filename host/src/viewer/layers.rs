//! What lies over a picture, and how that is shown.

use super::compose::compose;
use super::overlay::Overlay;
use super::panel::{Painting, paint};
use super::showing::Showing;
use crate::picture::Picture;

/// Everything that a window shows but the picture itself.
pub struct Layers<'a> {
    /// Text over the upper left corner.
    pub overlay: &'a Overlay,
    /// The panel, over all else, if it is there.
    pub panel: Option<&'a Painting>,
    /// How the picture is shown.
    pub showing: Showing,
}

impl Layers<'_> {
    /// Writes the pixels of a surface that shows a picture and these, sRGB-encoded, as `0x00RRGGBB`, on the CPU.
    pub fn compose(&self, picture: &Picture, surface: [u32; 2], pixels: &mut [u32]) {
        compose(picture, self.overlay, &self.showing, surface, pixels);
        if let Some(panel) = self.panel {
            paint(panel, surface, pixels);
        }
    }
}
