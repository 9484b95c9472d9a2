//! The images of a file, as far as materials use them.

use super::buffers::Buffers;
use super::document::{Document, Image, get};
use super::fault::{Fault, Place};
use super::notices::Notices;
use super::uri;
use crate::texels::{self, ImageFault};
use glam::Vec3;
use image::DynamicImage;
use oktant_shared::color::linear_from_srgb;
use oktant_shared::texture::Texture;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The images that were used so far.
pub(super) struct Images<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    folder: Option<&'a Path>,
    colors: HashMap<usize, Option<Colors>>,
    surfaces: HashMap<usize, Option<Surface>>,
    /// Those that colour something.
    pub(super) textures: Vec<Texture>,
    /// Their texels.
    pub(super) texels: Vec<u32>,
    /// Those that are files, there or not.
    pub(super) files: Vec<PathBuf>,
}

/// An image of colours.
#[derive(Clone, Copy)]
pub(super) struct Colors {
    /// Index of the texture.
    pub(super) texture: u32,
    /// The mean of its colours, linear.
    pub(super) mean: Vec3,
    /// Whether it also says what is transparent.
    pub(super) has_alpha: bool,
}

/// The means of an image of roughness and metalness.
#[derive(Clone, Copy)]
pub(super) struct Surface {
    pub(super) roughness: f64,
    pub(super) metallic: f64,
}

impl<'a> Images<'a> {
    /// None yet. Of a file in memory, which has no folder, only those are read that it holds itself.
    pub(super) fn new(document: &'a Document, buffers: &'a Buffers<'a>, folder: Option<&'a Path>) -> Self {
        Images {
            document,
            buffers,
            folder,
            colors: HashMap::new(),
            surfaces: HashMap::new(),
            textures: Vec::new(),
            texels: Vec::new(),
            files: Vec::new(),
        }
    }

    /// A texture as colours; none where its image cannot be had.
    pub(super) fn colors(&mut self, texture: usize, notices: &mut Notices) -> Result<Option<Colors>, Fault> {
        let Some(id) = self.image_of(texture, notices)? else {
            return Ok(None);
        };
        if let Some(known) = self.colors.get(&id) {
            return Ok(*known);
        }
        let colors = match self.decoded(id, notices)? {
            None => None,
            Some(image) => {
                self.textures.push(texels::add_colors(&image, &mut self.texels)?);
                Some(Colors {
                    texture: self.textures.len() as u32 - 1,
                    mean: mean(&image, linear_from_srgb),
                    has_alpha: image.color().has_alpha(),
                })
            }
        };
        self.colors.insert(id, colors);
        Ok(colors)
    }

    /// A texture as roughness and metalness; none where its image cannot be had.
    pub(super) fn surface(&mut self, texture: usize, notices: &mut Notices) -> Result<Option<Surface>, Fault> {
        let Some(id) = self.image_of(texture, notices)? else {
            return Ok(None);
        };
        if let Some(known) = self.surfaces.get(&id) {
            return Ok(*known);
        }
        let surface = self.decoded(id, notices)?.map(|image| {
            let mean = mean(&image, |part| part);
            Surface {
                roughness: f64::from(mean.y),
                metallic: f64::from(mean.z),
            }
        });
        self.surfaces.insert(id, surface);
        Ok(surface)
    }

    /// The image of a texture, if it has one of a kind that is known.
    fn image_of(&self, texture: usize, notices: &mut Notices) -> Result<Option<usize>, Fault> {
        let texture = get(&self.document.textures, "textures", texture)?;
        if let Some(sampler) = texture.sampler {
            let sampler = get(&self.document.samplers, "samplers", sampler)?;
            if [sampler.wrap_s, sampler.wrap_t]
                .iter()
                .flatten()
                .any(|wrap| *wrap != REPEAT)
            {
                notices.add("the clamping and mirroring of textures, which are repeated");
            }
        }
        if texture.source.is_none() {
            notices.add("textures without a PNG or JPEG image");
        }
        Ok(texture.source)
    }

    fn decoded(&mut self, id: usize, notices: &mut Notices) -> Result<Option<DynamicImage>, Fault> {
        let place = Place::of("images", id);
        let image = get(&self.document.images, "images", id)?;
        let decoded = match self.bytes(image, &place)? {
            Some(decoded) => decoded,
            None => {
                notices.add(&format!("{place}, which is no file here and no data"));
                return Ok(None);
            }
        };
        match decoded {
            Ok(image) => Ok(Some(image)),
            Err(fault) => {
                notices.add(&format!("{place} ({fault})"));
                Ok(None)
            }
        }
    }

    /// What an image is; none where it has no bytes.
    fn bytes(&mut self, image: &Image, place: &Place) -> Result<Option<Result<DynamicImage, ImageFault>>, Fault> {
        if let Some(view) = image.buffer_view {
            let bytes = self.buffers.view(self.document, view)?;
            return Ok(Some(texels::parse(bytes, &place.to_string())));
        }
        let Some(uri) = &image.uri else {
            return Ok(None);
        };
        if uri::is_data(uri) {
            return Ok(uri::data(uri).map(|bytes| texels::parse(&bytes, &place.to_string())));
        }
        let Some(path) = self.folder.and_then(|folder| uri::path(uri, folder)) else {
            return Ok(None);
        };
        self.files.push(path.clone());
        Ok(Some(texels::read(&path)))
    }
}

/// How OpenGL calls the repetition of a texture.
const REPEAT: u32 = 10_497;

/// The mean of what the 8-bit channels of an image stand for.
fn mean(image: &DynamicImage, decode: impl Fn(f32) -> f32) -> Vec3 {
    let image = image.to_rgb8();
    // Counted, so that it is exact, and decoded once a value.
    let mut counts = [[0_u64; 256]; 3];
    for pixel in image.as_raw().as_chunks::<3>().0 {
        for (counts, channel) in counts.iter_mut().zip(pixel) {
            counts[usize::from(*channel)] += 1;
        }
    }
    let pixels = f64::from(image.width()) * f64::from(image.height());
    Vec3::from_array(counts.map(|counts| {
        let values = counts.iter().zip(0_u8..);
        let sum: f64 = values
            .map(|(count, value)| *count as f64 * f64::from(decode(f32::from(value) / 255.0)))
            .sum();
        (sum / pixels) as f32
    }))
}
