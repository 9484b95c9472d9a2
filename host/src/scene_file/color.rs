//! Colours.

use super::number::{Amount, Part, Quantity, exactly};
use glam::Vec3;
use oktant_shared::color::linear_color;
use serde::de::{Error, IntoDeserializer, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// What part of the light a surface sends on, linear RGB, 0 to 1: a number for a grey, `[red, green, blue]`, both linear,
/// or `"#rrggbb"` or `"#rgb"`, sRGB-encoded as on the web.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance(pub Vec3);

/// How much light there is, linear RGB, 0 to 1e9; written like a [`Reflectance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radiance(pub Vec3);

impl<'de> Deserialize<'de> for Reflectance {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer
            .deserialize_any(ColorVisitor::<Part>(PhantomData))
            .map(Reflectance)
    }
}

impl<'de> Deserialize<'de> for Radiance {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer
            .deserialize_any(ColorVisitor::<Amount>(PhantomData))
            .map(Radiance)
    }
}

/// Reads a colour whose channels are `T`.
struct ColorVisitor<T>(PhantomData<T>);

impl<'de, T: Quantity + Into<f32> + Deserialize<'de>> Visitor<'de> for ColorVisitor<T> {
    type Value = Vec3;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let channel = T::EXPECTED;
        write!(f, "a colour: \"#rrggbb\", {channel}, or [red, green, blue]")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Vec3, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Vec3, E> {
        T::deserialize(value.into_deserializer()).map(|grey| Vec3::splat(grey.into()))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Vec3, E> {
        match srgb(text) {
            Some(color) => Ok(linear_color(color)),
            None => Err(E::invalid_value(Unexpected::Str(text), &self)),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, elements: A) -> Result<Vec3, A::Error> {
        let channels: [T; 3] = exactly(elements, &self)?;
        Ok(Vec3::from_array(channels.map(Into::into)))
    }
}

/// The bytes of `#rrggbb` or `#rgb`, red lowest.
fn srgb(text: &str) -> Option<u32> {
    let digits = text.strip_prefix('#')?;
    if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let digits = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit; 2]).collect(),
        6 => digits.to_string(),
        _ => return None,
    };
    let [_, red, green, blue] = u32::from_str_radix(&digits, 16).ok()?.to_be_bytes();
    Some(u32::from_le_bytes([red, green, blue, 0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_notations_of_the_web() {
        assert_eq!(srgb("#102Fff"), Some(0xff_2f_10));
        assert_eq!(srgb("#1aF"), Some(0xff_aa_11));
        for bad in ["", "#", "102030", "#12345", "#12345g", "#+12345", "red"] {
            assert_eq!(srgb(bad), None, "{bad}");
        }
    }
}
