//! A window without a GPU: the CPU writes its pixels.

use super::layers::Layers;
use super::screen::ScreenError;
use crate::picture::Picture;
use softbuffer::{Context, SoftBufferError, Surface};
use std::num::NonZeroU32;
use std::sync::Arc;
use winit::window::Window;

/// The window's pixels in the computer's memory.
pub struct SoftwareScreen {
    window: Arc<Window>,
    surface: Surface<Arc<Window>, Arc<Window>>,
}

impl SoftwareScreen {
    /// The pixels of a window.
    ///
    /// # Errors
    /// [`ScreenError::Software`] where the window system refuses.
    pub fn new(window: Arc<Window>) -> Result<Self, ScreenError> {
        let context = Context::new(window.clone()).map_err(failed)?;
        let surface = Surface::new(&context, window.clone()).map_err(failed)?;
        Ok(SoftwareScreen { window, surface })
    }

    /// Shows a picture and what lies over it in a window of that size.
    ///
    /// # Errors
    /// [`ScreenError::Software`] where the window system refuses.
    pub fn draw(&mut self, picture: &Picture, layers: &Layers<'_>, size: [u32; 2]) -> Result<(), ScreenError> {
        let (Some(width), Some(height)) = (NonZeroU32::new(size[0]), NonZeroU32::new(size[1])) else {
            return Ok(());
        };
        self.surface.resize(width, height).map_err(failed)?;
        let mut buffer = self.surface.buffer_mut().map_err(failed)?;
        layers.compose(picture, size, &mut buffer);
        self.window.pre_present_notify();
        buffer.present().map_err(failed)
    }
}

fn failed(error: SoftBufferError) -> ScreenError {
    ScreenError::Software(match error {
        SoftBufferError::PlatformError(Some(reason), _) => reason,
        other => other.to_string(),
    })
}
