//! What is around the scene.

use super::color::Radiance;
use super::fault::{Fault, Reason};
use super::folder::Folder;
use super::number::{Amount, Degrees};
use super::place::Place;
use super::texture::Textures;
use crate::model::DARK;
use glam::Vec3;
use oktant_shared::environment;
use oktant_shared::orbit::Up;
use serde::Deserialize;
use std::path::PathBuf;

/// `[environment]`: what rays see that leave the scene. One colour, a gradient or an image.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Environment {
    /// The same colour all around.
    pub color: Option<Radiance>,
    /// Gradient: colour straight above. Default: that of the horizon.
    pub zenith: Option<Radiance>,
    /// Gradient: colour at eye level. Default: a dark blue.
    pub horizon: Option<Radiance>,
    /// Gradient: colour straight below. Default: that of the horizon.
    pub nadir: Option<Radiance>,
    /// Image: an equirectangular panorama (HDR, EXR, PNG or JPEG), its middle in front.
    pub image: Option<PathBuf>,
    /// Image: factor of its light, 0 and up. Default: 1.
    pub strength: Option<Amount>,
    /// Image: degrees that it is turned, counterclockwise seen from above. Default: 0.
    pub rotation: Option<Degrees>,
}

impl Environment {
    /// The environment as the kernel reads it.
    pub fn build(
        &self,
        textures: &mut Textures,
        folder: Folder<'_>,
        up: Up,
    ) -> Result<environment::Environment, Fault> {
        let place = Place::of("environment");
        self.check(&place)?;
        let or = |color: Option<Radiance>, otherwise: Vec3| color.map_or(otherwise, |color| color.0);
        let horizon = or(self.color.or(self.horizon), DARK);
        let mut built = environment::Environment {
            zenith: or(self.zenith, horizon),
            nadir: or(self.nadir, horizon),
            up: up.axes()[1],
            ..environment::Environment::constant(horizon)
        };
        if let Some(image) = &self.image {
            built.texture = textures.add_image(&folder.path_of(image, &place.key("image"))?, &place.key("image"))?;
            built.strength = self.strength.map_or(1.0, |strength| strength.0);
            built.rotation = self.rotation.map_or(0.0, |degrees| {
                // Whole turns would take digits from the rest.
                (degrees.0 / 360.0).rem_euclid(1.0) as f32
            });
        }
        Ok(built)
    }

    /// Makes sure that only one thing is around.
    fn check(&self, place: &Place) -> Result<(), Fault> {
        let gradient = [
            ("zenith", self.zenith.is_some()),
            ("horizon", self.horizon.is_some()),
            ("nadir", self.nadir.is_some()),
        ];
        let of_image = [
            ("strength", self.strength.is_some()),
            ("rotation", self.rotation.is_some()),
        ];
        let mut wrong = Vec::new();
        if self.image.is_some() {
            wrong.push(("color", self.color.is_some(), Reason::Excludes("image")));
            wrong.extend(gradient.map(|(key, there)| (key, there, Reason::Excludes("image"))));
        } else {
            wrong.extend(
                of_image.map(|(key, there)| (key, there, Reason::Inapplicable("an environment without image"))),
            );
        }
        if self.color.is_some() {
            wrong.extend(gradient.map(|(key, there)| (key, there, Reason::Excludes("color"))));
        }
        match wrong.into_iter().find(|(_, is_there, _)| *is_there) {
            Some((key, _, reason)) => Err(Fault::new(&place.key(key), reason)),
            None => Ok(()),
        }
    }
}
