//! What the window shows, whoever draws it.

use super::gpu_screen::GpuScreen;
use super::layers::Layers;
use super::notice::Image;
use super::software_screen::SoftwareScreen;
use crate::backend::BackendError;
use crate::backend::gpu::Gpu;
use std::sync::Arc;
use winit::window::Window;

/// Who draws the window.
pub enum Screen {
    /// The CPU.
    Software(SoftwareScreen),
    /// A GPU; it shows pictures of the CPU's too.
    Gpu(Box<GpuScreen>),
}

/// Why a window cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ScreenError {
    /// Without a GPU.
    #[error("The window cannot be drawn ({0}); restart the display, or render a picture with: oktant render.")]
    Software(String),
    /// By the GPU.
    #[error("The GPU {0} cannot draw in this window; use --backend cpu, or a driver that supports the display.")]
    Surface(String),
    /// Because the GPU failed.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

impl Screen {
    /// Whether the picture can be shown by this one: what lies in a GPU's memory needs that GPU.
    pub fn shows(&self, image: &Image) -> bool {
        matches!((self, image), (Screen::Gpu(_), _) | (_, Image::Cpu(_)))
    }

    /// Whether this GPU draws.
    pub fn is_drawn_by(&self, gpu: &Arc<Gpu>) -> bool {
        matches!(self, Screen::Gpu(screen) if Arc::ptr_eq(screen.gpu(), gpu))
    }

    /// The screen of a window without a GPU.
    ///
    /// # Errors
    /// [`ScreenError::Software`].
    pub fn software(window: Arc<Window>) -> Result<Self, ScreenError> {
        SoftwareScreen::new(window).map(Screen::Software)
    }

    /// The screen of a window that the GPU draws. No other screen of the window may exist.
    ///
    /// # Errors
    /// [`ScreenError::Surface`], [`ScreenError::Backend`].
    pub fn gpu(window: Arc<Window>, gpu: Arc<Gpu>) -> Result<Self, ScreenError> {
        GpuScreen::new(window, gpu).map(|screen| Screen::Gpu(Box::new(screen)))
    }

    /// Shows a picture and what lies over it; false where it must be tried again later.
    ///
    /// # Errors
    /// [`ScreenError`], see there.
    pub fn draw(&mut self, image: &Image, layers: &Layers<'_>, size: [u32; 2]) -> Result<bool, ScreenError> {
        match (self, image) {
            (Screen::Software(screen), Image::Cpu(picture)) => screen.draw(picture, layers, size).map(|()| true),
            (Screen::Software(_), Image::Gpu(_)) => Ok(true),
            (Screen::Gpu(screen), _) => screen.draw(image, layers, size),
        }
    }

    /// What [`Screen::draw`] shows: red, green and blue of each pixel, sRGB-encoded.
    ///
    /// # Errors
    /// [`ScreenError::Backend`] where the GPU fails.
    pub fn screenshot(&mut self, image: &Image, layers: &Layers<'_>, size: [u32; 2]) -> Result<Vec<u8>, ScreenError> {
        match (self, image) {
            (Screen::Gpu(screen), _) => screen.screenshot(image, layers, size),
            (Screen::Software(_), Image::Gpu(_)) => Ok(Vec::new()),
            (Screen::Software(_), Image::Cpu(picture)) => {
                let mut pixels = vec![0; size[0] as usize * size[1] as usize];
                layers.compose(picture, size, &mut pixels);
                Ok(pixels
                    .into_iter()
                    .flat_map(|pixel: u32| {
                        let [blue, green, red, _] = pixel.to_le_bytes();
                        [red, green, blue]
                    })
                    .collect())
            }
        }
    }
}
