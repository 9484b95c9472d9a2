//! Images and patterns.

use super::color::Reflectance;
use super::fault::{Fault, Reason};
use super::folder::Folder;
use super::material::Material;
use super::number::Repeats;
use super::place::Place;
use crate::texels::{self, TooManyTexels};
use bytemuck::Zeroable;
use glam::Vec3;
use image::DynamicImage;
use oktant_shared::color::srgb_from_linear;
use oktant_shared::texture::{self, CHECKERBOARD, WAVES};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// `[textures.NAME]`: colours over texture coordinates.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Texture {
    /// "image", "checkerboard" or "waves" (bumps like an egg box's). Default: "image".
    pub kind: Kind,
    /// Image: the file, a PNG, JPEG, HDR or EXR; mandatory. As the bump of a material its numbers are heights.
    pub file: Option<PathBuf>,
    /// Checkerboard: its two colours. Default: black and white.
    pub colors: Option<[Reflectance; 2]>,
    /// How often the image or pattern is repeated a unit of the texture coordinates; a checkerboard has so many squares a
    /// unit. Default: 1.
    pub repeats: Option<Repeats>,
}

/// What a texture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// An image.
    #[default]
    Image,
    /// Squares in two colours.
    Checkerboard,
    /// Sine waves along both axes.
    Waves,
}

/// The textures of a scene.
#[derive(Default)]
pub struct Textures {
    named: BTreeMap<String, Ids>,
    /// As the kernel reads them.
    pub textures: Vec<texture::Texture>,
    /// The texels of all images.
    pub texels: Vec<u32>,
    /// The images' files.
    pub files: Vec<PathBuf>,
}

/// The indices of a texture: an image has one for each thing that it is used as, a pattern the same for both.
#[derive(Clone, Copy, Default)]
struct Ids {
    color: Option<u32>,
    height: Option<u32>,
}

impl Textures {
    /// The textures of a file, as what its materials use them. What none uses is read all the same, to say what is wrong
    /// with it.
    pub fn read(
        described: &BTreeMap<String, Texture>,
        materials: &BTreeMap<String, Material>,
        folder: Folder<'_>,
    ) -> Result<Self, Fault> {
        let used = |field: fn(&Material) -> &Option<String>| -> BTreeSet<&str> {
            materials.values().filter_map(|it| field(it).as_deref()).collect()
        };
        let (as_color, as_height) = (used(|material| &material.texture), used(|material| &material.bump));
        let mut textures = Textures::default();
        for (name, texture) in described {
            let place = Place::of("textures").key(name);
            texture.check(&place)?;
            let repeats = texture.repeats.map_or(1.0, |repeats| repeats.0);
            let ids = match (texture.kind, &texture.file) {
                (Kind::Image, Some(file)) => {
                    let place = place.key("file");
                    let image = textures.read_image(&folder.path_of(file, &place)?, &place)?;
                    let is_height = as_height.contains(name.as_str());
                    let is_color = !is_height || as_color.contains(name.as_str());
                    let mut add = |is_wanted: bool, keep: Keep| match is_wanted {
                        true => textures.keep(&image, keep, repeats, &place).map(Some),
                        false => Ok(None),
                    };
                    Ids {
                        color: add(is_color, texels::add_colors)?,
                        height: add(is_height, texels::add_heights)?,
                    }
                }
                (Kind::Image, None) => return Err(Fault::new(&place, Reason::Lacks("the name of its image, file"))),
                (Kind::Checkerboard, _) => {
                    let colors = texture.colors.map(|colors| colors.map(|color| color.0));
                    let [first, second] = colors.unwrap_or([Vec3::ZERO, Vec3::ONE]);
                    textures.add_pattern(texture::Texture {
                        width: srgb(first),
                        height: srgb(second),
                        kind: CHECKERBOARD,
                        repeats,
                        ..texture::Texture::zeroed()
                    })
                }
                (Kind::Waves, _) => textures.add_pattern(texture::Texture {
                    kind: WAVES,
                    repeats,
                    ..texture::Texture::zeroed()
                }),
            };
            textures.named.insert(name.clone(), ids);
        }
        Ok(textures)
    }

    /// Adds an image without a name, for its colours.
    pub fn add_image(&mut self, path: &Path, place: &Place) -> Result<u32, Fault> {
        let image = self.read_image(path, place)?;
        self.keep(&image, texels::add_colors, 1.0, place)
    }

    fn read_image(&mut self, path: &Path, place: &Place) -> Result<DynamicImage, Fault> {
        let image = texels::read(path).map_err(|fault| Fault::new(place, fault.into()))?;
        self.files.push(path.to_path_buf());
        Ok(image)
    }

    fn keep(&mut self, image: &DynamicImage, keep: Keep, repeats: f32, place: &Place) -> Result<u32, Fault> {
        let kept = keep(image, &mut self.texels).map_err(|fault| Fault::new(place, fault.into()))?;
        Ok(self.add(texture::Texture { repeats, ..kept }))
    }

    fn add_pattern(&mut self, pattern: texture::Texture) -> Ids {
        let id = Some(self.add(pattern));
        Ids { color: id, height: id }
    }

    fn add(&mut self, texture: texture::Texture) -> u32 {
        self.textures.push(texture);
        self.textures.len() as u32 - 1
    }

    /// Adds textures, and the texels that they refer to; returns the index of the first.
    pub fn append(&mut self, textures: &[texture::Texture], texels: &[u32]) -> Result<u32, TooManyTexels> {
        texels::append((&mut self.textures, &mut self.texels), (textures, texels))
    }

    /// The index of the texture of colours that a field at a place names.
    pub fn color_id(&self, name: &str, place: &Place) -> Result<u32, Fault> {
        self.id(name, |ids| ids.color, place)
    }

    /// The index of the texture of heights that a field at a place names.
    pub fn height_id(&self, name: &str, place: &Place) -> Result<u32, Fault> {
        self.id(name, |ids| ids.height, place)
    }

    fn id(&self, name: &str, which: impl Fn(&Ids) -> Option<u32>, place: &Place) -> Result<u32, Fault> {
        self.named.get(name).and_then(which).ok_or_else(|| {
            let reason = Reason::UnknownName {
                name: name.into(),
                what: "texture",
                valid: self.named.keys().cloned().collect(),
            };
            Fault::new(place, reason)
        })
    }
}

/// What keeps the texels of an image.
type Keep = fn(&DynamicImage, &mut Vec<u32>) -> Result<texture::Texture, TooManyTexels>;

impl Texture {
    /// Makes sure that nothing is said that has no meaning.
    fn check(&self, place: &Place) -> Result<(), Fault> {
        let whose = match self.kind {
            Kind::Image => "an image",
            Kind::Checkerboard => "a checkerboard",
            Kind::Waves => "waves",
        };
        for (key, is_there) in [
            ("file", self.file.is_some() && self.kind != Kind::Image),
            ("colors", self.colors.is_some() && self.kind != Kind::Checkerboard),
        ] {
            if is_there {
                return Err(Fault::new(&place.key(key), Reason::Inapplicable(whose)));
            }
        }
        Ok(())
    }
}

/// A linear colour, 0 to 1, as three sRGB-encoded bytes, red lowest.
fn srgb(color: Vec3) -> u32 {
    let [red, green, blue] = color
        .to_array()
        .map(|channel| (srgb_from_linear(channel) * 255.0).round() as u8);
    u32::from_le_bytes([red, green, blue, 0])
}
