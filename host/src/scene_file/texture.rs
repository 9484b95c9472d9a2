//! Images and patterns.

use super::color::Reflectance;
use super::fault::{Fault, Reason};
use super::number::Repeats;
use super::place::Place;
use super::texels;
use bytemuck::Zeroable;
use glam::Vec3;
use oktant_shared::color::srgb_from_linear;
use oktant_shared::texture::{self, CHECKERBOARD, WAVES};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// `[textures.NAME]`: colours over texture coordinates.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Texture {
    /// "image", "checkerboard" or "waves" (bumps like an egg box's). Default: "image".
    pub kind: Kind,
    /// Image: the file, a PNG, JPEG, HDR or EXR; mandatory.
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
    names: Vec<String>,
    /// As the kernel reads them: first those with names.
    pub textures: Vec<texture::Texture>,
    /// The texels of all images.
    pub texels: Vec<u32>,
    /// The images' files.
    pub files: Vec<PathBuf>,
}

impl Textures {
    /// The textures of a file.
    pub fn read(described: &BTreeMap<String, Texture>, folder: &Path) -> Result<Self, Fault> {
        let mut textures = Textures::default();
        for (name, texture) in described {
            let place = Place::of("textures").key(name);
            texture.check(&place)?;
            let mut built = match (texture.kind, &texture.file) {
                (Kind::Image, Some(file)) => textures.read_image(&folder.join(file), &place.key("file"))?,
                (Kind::Image, None) => return Err(Fault::new(&place, Reason::Lacks("the name of its image, file"))),
                (Kind::Checkerboard, _) => {
                    let colors = texture.colors.map(|colors| colors.map(|color| color.0));
                    let [first, second] = colors.unwrap_or([Vec3::ZERO, Vec3::ONE]);
                    texture::Texture {
                        width: srgb(first),
                        height: srgb(second),
                        kind: CHECKERBOARD,
                        ..texture::Texture::zeroed()
                    }
                }
                (Kind::Waves, _) => texture::Texture {
                    kind: WAVES,
                    ..texture::Texture::zeroed()
                },
            };
            built.repeats = texture.repeats.map_or(1.0, |repeats| repeats.0);
            textures.names.push(name.clone());
            textures.textures.push(built);
        }
        Ok(textures)
    }

    /// Adds an image without a name.
    pub fn add_image(&mut self, path: &Path, place: &Place) -> Result<u32, Fault> {
        let image = self.read_image(path, place)?;
        self.textures.push(image);
        Ok(self.textures.len() as u32 - 1)
    }

    fn read_image(&mut self, path: &Path, place: &Place) -> Result<texture::Texture, Fault> {
        let image = texels::read(path, &mut self.texels).map_err(|reason| Fault::new(place, reason))?;
        self.files.push(path.to_path_buf());
        Ok(image)
    }

    /// The index of the texture that a field at a place names.
    pub fn id(&self, name: &str, place: &Place) -> Result<u32, Fault> {
        let position = self.names.iter().position(|other| other == name);
        position.map(|id| id as u32).ok_or_else(|| {
            let reason = Reason::UnknownName {
                name: name.into(),
                what: "texture",
                valid: self.names.clone(),
            };
            Fault::new(place, reason)
        })
    }
}

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
