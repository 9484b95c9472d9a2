//! A window that the GPU draws.

use super::accident::caught;
use super::layers::Layers;
use super::notice::Image;
use super::panel::GpuPainter;
use super::presenter::Presenter;
use super::screen::ScreenError;
use crate::backend::gpu::{Gpu, GpuPicture};
use crate::picture::Picture;
use std::sync::{Arc, Weak};
use wgpu::CurrentSurfaceTexture;
use winit::window::Window;

/// A surface of the GPU's in a window.
pub struct GpuScreen {
    // Before the window and the device: fields are dropped in their order.
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    /// Whether the surface must be configured before it is drawn on.
    is_stale: bool,
    presenter: Presenter,
    /// Draws the panel, once there is one.
    painter: Option<GpuPainter>,
    uploaded: Option<(Weak<Picture>, GpuPicture)>,
    gpu: Arc<Gpu>,
    window: Arc<Window>,
}

impl GpuScreen {
    /// Makes the surface, and the pipeline that draws on it.
    ///
    /// # Errors
    /// [`ScreenError::Surface`] where the GPU cannot draw in this window.
    pub fn new(window: Arc<Window>, gpu: Arc<Gpu>) -> Result<Self, ScreenError> {
        let surface = surface(&window, &gpu)?;
        let capabilities = surface.get_capabilities(&gpu.adapter);
        // The fragment shader writes linear colours: the format must encode them.
        let format = capabilities.formats.iter().copied().find(wgpu::TextureFormat::is_srgb);
        let format = format.or_else(|| {
            let any = capabilities.formats.iter().copied();
            any.map(|format| format.add_srgb_suffix())
                .find(wgpu::TextureFormat::is_srgb)
        });
        let format = format.ok_or_else(|| unsupported(&gpu))?;
        let is_native = capabilities.formats.contains(&format);
        let configuration = wgpu::SurfaceConfiguration {
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            format: if is_native { format } else { format.remove_srgb_suffix() },
            color_space: wgpu::SurfaceColorSpace::Auto,
            width: 1,
            height: 1,
            present_mode: wgpu::PresentMode::AutoVsync,
            desired_maximum_frame_latency: 1,
            alpha_mode: wgpu::CompositeAlphaMode::Auto,
            view_formats: if is_native { Vec::new() } else { vec![format] },
        };
        let presenter = Presenter::new(&gpu, format);
        gpu.check()?;
        Ok(GpuScreen {
            surface,
            configuration,
            is_stale: true,
            presenter,
            painter: None,
            uploaded: None,
            gpu,
            window,
        })
    }

    /// Shows a picture and what lies over it in a window of that size; false where it must be tried again, because
    /// the surface was lost or nobody would see it.
    ///
    /// # Errors
    /// [`ScreenError::Backend`] where the device fails, [`ScreenError::Surface`] where the surface does.
    pub fn draw(&mut self, image: &Image, layers: &Layers<'_>, size: [u32; 2]) -> Result<bool, ScreenError> {
        if size.contains(&0) {
            return Ok(true);
        }
        let gpu = self.gpu.clone();
        sound(&gpu, || self.draw_on_surface(image, layers, size))
    }

    fn draw_on_surface(&mut self, image: &Image, layers: &Layers<'_>, size: [u32; 2]) -> Result<bool, ScreenError> {
        self.upload(image)?;
        // A surface is lost rarely, and then once; twice in a row is left to the next attempt.
        for _ in 0..2 {
            self.configure(size)?;
            let (texture, is_suboptimal) = match self.surface.get_current_texture() {
                CurrentSurfaceTexture::Success(texture) => (texture, false),
                CurrentSurfaceTexture::Suboptimal(texture) => (texture, true),
                CurrentSurfaceTexture::Outdated => {
                    self.is_stale = true;
                    continue;
                }
                CurrentSurfaceTexture::Lost => {
                    self.surface = surface(&self.window, &self.gpu)?;
                    self.is_stale = true;
                    continue;
                }
                CurrentSurfaceTexture::Timeout | CurrentSurfaceTexture::Occluded => return Ok(false),
                CurrentSurfaceTexture::Validation => {
                    self.gpu.check()?;
                    return Err(unsupported(&self.gpu));
                }
            };
            let format = self.configuration.view_formats.first().copied();
            let view = texture.texture.create_view(&wgpu::TextureViewDescriptor {
                format,
                ..Default::default()
            });
            let mut painter = self.painter.take();
            if layers.panel.is_some() && painter.is_none() {
                painter = Some(GpuPainter::new(&self.gpu, format.unwrap_or(self.configuration.format)));
            }
            self.presenter
                .draw(&self.gpu, (&view, size), self.picture(image), layers, painter.as_mut());
            self.painter = painter;
            self.window.pre_present_notify();
            self.gpu.queue.present(texture);
            self.is_stale = is_suboptimal;
            self.gpu.check()?;
            return Ok(true);
        }
        Ok(false)
    }

    /// What [`GpuScreen::draw`] shows, drawn by the GPU into a picture of its own and read back: red, green and blue of
    /// each pixel, sRGB-encoded.
    ///
    /// # Errors
    /// [`ScreenError::Backend`] where the device fails.
    pub fn screenshot(&mut self, image: &Image, layers: &Layers<'_>, size: [u32; 2]) -> Result<Vec<u8>, ScreenError> {
        let gpu = self.gpu.clone();
        sound(&gpu, || self.draw_apart(image, layers, size))
    }

    fn draw_apart(&mut self, image: &Image, layers: &Layers<'_>, size: [u32; 2]) -> Result<Vec<u8>, ScreenError> {
        self.upload(image)?;
        let format = wgpu::TextureFormat::Rgba8UnormSrgb;
        let texture = self.gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("screenshot"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let presenter = Presenter::new(&self.gpu, format);
        let mut painter = layers.panel.map(|_| GpuPainter::new(&self.gpu, format));
        presenter.draw(&self.gpu, (&view, size), self.picture(image), layers, painter.as_mut());
        Ok(self.gpu.read_rgb8(&texture)?)
    }

    /// The device.
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    fn configure(&mut self, size: [u32; 2]) -> Result<(), ScreenError> {
        if self.is_stale || [self.configuration.width, self.configuration.height] != size {
            [self.configuration.width, self.configuration.height] = size;
            self.surface.configure(&self.gpu.device, &self.configuration);
            self.gpu.check()?;
            self.is_stale = false;
        }
        Ok(())
    }

    /// Copies a picture of the CPU's to the GPU, if it is not there yet.
    fn upload(&mut self, image: &Image) -> Result<(), ScreenError> {
        let Image::Cpu(picture) = image else {
            self.uploaded = None;
            return Ok(());
        };
        let size = [picture.width, picture.height];
        let there = match self.uploaded.take() {
            Some((of, there)) if std::ptr::eq(of.as_ptr(), Arc::as_ptr(picture)) => {
                self.uploaded = Some((of, there));
                return Ok(());
            }
            Some((_, there)) if [there.width, there.height] == size => there,
            _ => self.gpu.picture(picture.width, picture.height, false)?,
        };
        self.gpu
            .queue
            .write_buffer(&there.sums, 0, bytemuck::cast_slice(&picture.sums));
        self.uploaded = Some((Arc::downgrade(picture), there));
        Ok(())
    }

    fn picture<'a>(&'a self, image: &'a Image) -> (&'a wgpu::Buffer, [u32; 2]) {
        let picture = match (image, &self.uploaded) {
            (Image::Gpu(picture), _) => &**picture,
            (Image::Cpu(_), Some((_, there))) => there,
            (Image::Cpu(_), None) => unreachable!("pictures are uploaded before they are drawn"),
        };
        (&picture.sums, [picture.width, picture.height])
    }
}

/// Does something on a device that may be lost while it is done: wgpu panics then in places.
fn sound<T>(gpu: &Gpu, work: impl FnOnce() -> Result<T, ScreenError>) -> Result<T, ScreenError> {
    gpu.check()?;
    let done = caught(work).unwrap_or_else(|accident| Err(ScreenError::Backend(gpu.failed_by(&accident))));
    if matches!(done, Err(ScreenError::Surface(_))) {
        // Of a lost device, surfaces cannot be drawn on either.
        gpu.check_again()?;
    }
    done
}

fn surface(window: &Arc<Window>, gpu: &Gpu) -> Result<wgpu::Surface<'static>, ScreenError> {
    let surface = gpu
        .instance
        .create_surface(window.clone())
        .map_err(|_| unsupported(gpu))?;
    if gpu.adapter.is_surface_supported(&surface) {
        Ok(surface)
    } else {
        Err(unsupported(gpu))
    }
}

fn unsupported(gpu: &Gpu) -> ScreenError {
    ScreenError::Surface(gpu.name.clone())
}
