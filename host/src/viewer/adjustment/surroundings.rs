//! What is around, under the names of scene files.

use super::value::{color, number};
use crate::scene::Staging;
use crate::scene_file::{Amount, Degrees, Radiance};
use crate::viewer::grammar::unknown;
use glam::Vec3;
use oktant_shared::texture::NO_TEXTURE;

/// Something about what is around, with its new value; colours are linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurroundingsAdjustment {
    /// The same colour all around.
    Color(Vec3),
    /// Colour straight above.
    Zenith(Vec3),
    /// Colour at eye level.
    Horizon(Vec3),
    /// Colour straight below.
    Nadir(Vec3),
    /// Factor of an image's light.
    Strength(f32),
    /// How far an image is turned, degrees.
    Rotation(f32),
    /// Light that comes from everywhere.
    Ambient(Vec3),
}

impl SurroundingsAdjustment {
    /// The names, as in scene files.
    pub const NAMES: [&str; 7] = ["color", "zenith", "horizon", "nadir", "strength", "rotation", "ambient"];

    /// What a name and a value mean.
    pub fn parse(name: &str, value: &str) -> Result<Self, String> {
        let radiance = || color::<Radiance>(value).map(|color| color.0);
        Ok(match name {
            "color" => Self::Color(radiance()?),
            "zenith" => Self::Zenith(radiance()?),
            "horizon" => Self::Horizon(radiance()?),
            "nadir" => Self::Nadir(radiance()?),
            "strength" => Self::Strength(number::<Amount>(value)?.0),
            "rotation" => Self::Rotation(number::<Degrees>(value)?.0 as f32),
            "ambient" => Self::Ambient(radiance()?),
            _ => return Err(unknown(name, "setting of the environment", &Self::NAMES)),
        })
    }

    /// Gives a staging the value; else says why that has none.
    pub fn apply(self, staging: &mut Staging) -> Result<(), String> {
        let environment = &mut staging.environment;
        let has_image = environment.texture != NO_TEXTURE;
        match self {
            Self::Strength(_) | Self::Rotation(_) if !has_image => {
                return Err("only an environment with an image has a strength and a rotation; \
                            give it a color, or a zenith, a horizon and a nadir"
                    .into());
            }
            Self::Color(_) | Self::Zenith(_) | Self::Horizon(_) | Self::Nadir(_) if has_image => {
                return Err("an image is around; change its strength or its rotation".into());
            }
            Self::Color(color) => {
                (environment.zenith, environment.horizon, environment.nadir) = (color, color, color);
            }
            Self::Zenith(color) => environment.zenith = color,
            Self::Horizon(color) => environment.horizon = color,
            Self::Nadir(color) => environment.nadir = color,
            Self::Strength(strength) => environment.strength = strength,
            Self::Rotation(degrees) => environment.rotation = (degrees / 360.0).rem_euclid(1.0),
            Self::Ambient(color) => staging.ambient = color,
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(staging: &mut Staging, name: &str, value: &str) -> Result<(), String> {
        SurroundingsAdjustment::parse(name, value).and_then(|adjustment| adjustment.apply(staging))
    }

    #[test]
    fn gradients_and_images_have_settings_of_their_own() {
        let mut staging = Staging::default();
        assert_eq!(set(&mut staging, "color", "0.5"), Ok(()));
        assert_eq!(set(&mut staging, "zenith", "#00f"), Ok(()));
        assert_eq!(set(&mut staging, "ambient", "1,2,3"), Ok(()));
        let environment = staging.environment;
        assert_eq!((environment.zenith, environment.horizon), (Vec3::Z, Vec3::splat(0.5)));
        assert_eq!(
            (environment.nadir, staging.ambient),
            (Vec3::splat(0.5), Vec3::new(1.0, 2.0, 3.0))
        );
        assert!(
            set(&mut staging, "strength", "2")
                .unwrap_err()
                .contains("give it a color")
        );
        staging.environment.texture = 0;
        assert!(set(&mut staging, "color", "1").unwrap_err().contains("strength"));
        assert_eq!(set(&mut staging, "strength", "2"), Ok(()));
        assert_eq!(set(&mut staging, "rotation", "-90"), Ok(()));
        let environment = staging.environment;
        assert_eq!((environment.strength, environment.rotation), (2.0, 0.75));
        assert!(set(&mut staging, "nadri", "1").unwrap_err().contains("\"nadir\""));
    }
}
