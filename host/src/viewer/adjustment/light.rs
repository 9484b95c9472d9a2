//! What shines, under the names of scene files and of the command line.

use super::value::{color, named, number, position};
use crate::scene_file::{Amount, Degrees, Elevation, Length, Radiance};
use crate::viewer::grammar::unknown;
use glam::Vec3;
use oktant_shared::light::Light;

/// What a light that falls off counts as its nearest distance where nobody says it, scene units, as in scene files.
const NEAREST: f32 = 1e-3;

/// Something about a light with its new value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightAdjustment {
    /// Its colour; the intensity stays.
    Color(Vec3),
    /// What the colour is multiplied with.
    Intensity(f32),
    /// Where it is, of an area light its middle, and of a directional one where it comes from; scene units.
    Position(Vec3),
    /// Where it stands on its sphere, degrees about the up axis.
    Azimuth(f32),
    /// How high it stands there, degrees.
    Elevation(f32),
    /// How far it is from what is looked at, in its radii.
    Distance(f32),
    /// Where it has faded out, scene units; 0 for never.
    Range(f32),
    /// Whether it decreases with the square of the distance.
    FallsOff(bool),
    /// With falloff: nearer than this it increases no more, scene units.
    Radius(f32),
}

impl LightAdjustment {
    /// The names.
    pub const NAMES: [&str; 9] = [
        "color",
        "intensity",
        "position",
        "azimuth",
        "elevation",
        "distance",
        "range",
        "falloff",
        "radius",
    ];
    /// The ways to decrease with the distance.
    pub const FALLOFFS: [&str; 2] = ["none", "inverse-square"];

    /// What a name and a value mean.
    pub fn parse(name: &str, value: &str) -> Result<Self, String> {
        Ok(match name {
            "color" => Self::Color(color::<Radiance>(value)?.0),
            "intensity" => Self::Intensity(number::<Amount>(value)?.0),
            "position" => Self::Position(position(value)?),
            "azimuth" => Self::Azimuth(number::<Degrees>(value)?.0 as f32),
            "elevation" => Self::Elevation(number::<Elevation>(value)?.0),
            "distance" => Self::Distance(number::<Length>(value)?.0),
            "range" => Self::Range(number::<Amount>(value)?.0),
            "falloff" => Self::FallsOff(named(value, "falloff", &[false, true], |falls| {
                Self::FALLOFFS[usize::from(falls)].into()
            })?),
            "radius" => Self::Radius(number::<Length>(value)?.0),
            _ => return Err(unknown(name, "setting of a light", &Self::NAMES)),
        })
    }

    /// Gives a light the value, unless that is a place: those are counted from what is looked at.
    pub fn apply(self, light: &mut Light) {
        match self {
            Self::Color(color) => light.color = color * intensity(light),
            Self::Intensity(intensity) => light.color = hue(light) * intensity,
            Self::Range(range) => light.range = range,
            Self::FallsOff(false) => light.falloff_radius = 0.0,
            Self::FallsOff(true) if light.falloff_radius == 0.0 => light.falloff_radius = NEAREST,
            Self::Radius(radius) => light.falloff_radius = radius,
            Self::FallsOff(true) | Self::Position(_) | Self::Azimuth(_) | Self::Elevation(_) | Self::Distance(_) => {}
        }
    }
}

/// What a light's colour is multiplied with: its greatest channel, or 1 where it is black.
pub fn intensity(light: &Light) -> f32 {
    match light.color.max_element() {
        0.0 => 1.0,
        greatest => greatest,
    }
}

/// The colour of a light without that; white where it is black.
pub fn hue(light: &Light) -> Vec3 {
    if light.color == Vec3::ZERO {
        return Vec3::ONE;
    }
    light.color / intensity(light)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::white_light;

    #[test]
    fn every_name_takes_a_value_and_refuses_others() {
        for name in LightAdjustment::NAMES {
            for bad in ["", "?", "1e30", "1,2"] {
                let error = LightAdjustment::parse(name, bad).unwrap_err();
                assert!(!error.contains("setting"), "{name} {bad}: {error}");
            }
        }
        assert_eq!(
            LightAdjustment::parse("position", "1,-2,3.5"),
            Ok(LightAdjustment::Position(Vec3::new(1.0, -2.0, 3.5)))
        );
        assert_eq!(
            LightAdjustment::parse("falloff", "inverse-square"),
            Ok(LightAdjustment::FallsOff(true))
        );
    }

    #[test]
    fn colour_and_intensity_are_apart() {
        let mut light = white_light();
        LightAdjustment::Intensity(6.0).apply(&mut light);
        LightAdjustment::Color(Vec3::new(1.0, 0.5, 0.0)).apply(&mut light);
        assert_eq!(light.color, Vec3::new(6.0, 3.0, 0.0));
        assert_eq!((intensity(&light), hue(&light)), (6.0, Vec3::new(1.0, 0.5, 0.0)));
        LightAdjustment::Intensity(0.0).apply(&mut light);
        assert_eq!(light.color, Vec3::ZERO);
        LightAdjustment::Intensity(2.0).apply(&mut light);
        assert_eq!(light.color, Vec3::splat(2.0), "what was off comes back white");
    }

    #[test]
    fn falloff_has_a_radius() {
        let mut light = white_light();
        LightAdjustment::FallsOff(true).apply(&mut light);
        assert_eq!(light.falloff_radius, NEAREST);
        LightAdjustment::Radius(0.5).apply(&mut light);
        LightAdjustment::FallsOff(true).apply(&mut light);
        assert_eq!(light.falloff_radius, 0.5);
        LightAdjustment::FallsOff(false).apply(&mut light);
        assert_eq!(light.falloff_radius, 0.0);
    }
}
