//! Numbers with a range.

use serde::de::{Error, IntoDeserializer, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;
use std::ops::RangeInclusive;

/// A number that a scene file may hold.
pub trait Quantity: Copy {
    /// What to give, for messages.
    const EXPECTED: &'static str;
}

/// Reads a number within a range.
struct Ranged {
    range: RangeInclusive<f64>,
    is_whole: bool,
    expected: &'static str,
}

impl Visitor<'_> for Ranged {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        if self.range.contains(&value) && (!self.is_whole || value.fract() == 0.0) {
            Ok(value)
        } else {
            Err(E::invalid_value(Unexpected::Float(value), &self))
        }
    }
}

macro_rules! quantities {
    ($is_whole:literal, $inner:ty: $($(#[$doc:meta])* $name:ident in $range:expr, $expected:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name(pub $inner);

        impl Quantity for $name {
            const EXPECTED: &'static str = $expected;
        }

        impl From<$name> for $inner {
            fn from(number: $name) -> $inner {
                number.0
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let number = deserializer.deserialize_any(Ranged {
                    range: $range,
                    is_whole: $is_whole,
                    expected: $expected,
                })?;
                Ok($name(number as $inner))
            }
        }
    )*};
}

quantities! { false, f64:
    /// A coordinate, scene units.
    Coordinate in -1e9..=1e9, "a number from -1e9 to 1e9";
    /// An angle, degrees.
    Degrees in -1e6..=1e6, "a number of degrees from -1e6 to 1e6";
    /// A time, in any unit.
    Time in -1e9..=1e9, "a number from -1e9 to 1e9";
}

quantities! { false, f32:
    /// Steps of an output of 8 bits.
    Steps in 0.0..=255.0, "a number of steps of 8 bits from 0 to 255";
    /// How far a pixel may be off, as a part of the output's range.
    Tolerance in 1e-4..=1.0, "a part of the output's range from 0.0001 to 1";
    /// A distance from what is looked at, in the radii that a view counts in.
    Radii in 1e-3..=1e5, "a number of radii from 0.001 to 100000";
    /// A part of a whole.
    Part in 0.0..=1.0, "a number from 0 to 1";
    /// A length, scene units.
    Length in 1e-9..=1e9, "a length from 1e-9 to 1e9";
    /// How much of something that has no upper limit.
    Amount in 0.0..=1e9, "a number from 0 to 1e9";
    /// A height over the surface, scene units.
    Height in -1e6..=1e6, "a height from -1e6 to 1e6";
    /// An angle above the horizon, degrees.
    Elevation in -90.0..=90.0, "a number of degrees from -90 to 90";
    /// A field of view, degrees.
    FieldOfView in 1.0..=170.0, "a number of degrees from 1 to 170";
    /// An index of refraction.
    Ior in 0.1..=10.0, "an index of refraction from 0.1 to 10";
    /// An exposure, stops.
    Stops in -30.0..=30.0, "a number of stops from -30 to 30";
    /// How often a texture is repeated.
    Repeats in 1e-6..=1e6, "a number from 1e-6 to 1e6";
}

quantities! { true, u32:
    /// Triangles of a sphere.
    Triangles in 8.0..=1e6, "a whole number of triangles from 8 to 1000000";
    /// Squares along an edge of a checkerboard.
    Squares in 1.0..=1000.0, "a whole number of squares from 1 to 1000";
    /// Parts of a circle.
    Slices in 3.0..=1000.0, "a whole number of slices from 3 to 1000";
    /// Samples along each edge of an area light.
    SamplesPerSide in 1.0..=16.0, "a whole number of samples from 1 to 16";
    /// Priority of a medium.
    Priority in 0.0..=1e6, "a whole number from 0 to 1000000";
    /// Depth of the ray tree.
    Depth in 0.0..=16.0, "a whole number of reflections and refractions from 0 to 16";
    /// Pixels of a row or column.
    Pixels in 1.0..=32_768.0, "a whole number of pixels from 1 to 32768";
}

const _: () = assert!(
    oktant_shared::whitted::MAX_DEPTH == 16,
    "the range of Depth has to follow"
);

/// A factor along an axis; negative mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor(pub f64);

impl Quantity for Factor {
    const EXPECTED: &'static str = "a factor from 1e-9 to 1e9 or -1e9 to -1e-9";
}

impl<'de> Deserialize<'de> for Factor {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let range = Ranged {
            range: -1e9..=1e9,
            is_whole: false,
            expected: Self::EXPECTED,
        };
        let factor = deserializer.deserialize_any(range)?;
        if factor.abs() < 1e-9 {
            return Err(D::Error::invalid_value(Unexpected::Float(factor), &Self::EXPECTED));
        }
        Ok(Factor(factor))
    }
}

/// Exponent of a highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent(pub f32);

impl Quantity for Exponent {
    const EXPECTED: &'static str = "0, or an exponent from 1 to 1e6";
}

impl<'de> Deserialize<'de> for Exponent {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let range = Ranged {
            range: 0.0..=1e6,
            is_whole: false,
            expected: Self::EXPECTED,
        };
        let exponent = deserializer.deserialize_any(range)?;
        if exponent > 0.0 && exponent < 1.0 {
            return Err(D::Error::invalid_value(Unexpected::Float(exponent), &Self::EXPECTED));
        }
        Ok(Exponent(exponent as f32))
    }
}

/// One number for all, or `N` of them in brackets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Each<T, const N: usize>(pub [T; N]);

impl<'de, T: Quantity + Deserialize<'de>, const N: usize> Deserialize<'de> for Each<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EachVisitor(PhantomData)).map(Each)
    }
}

struct EachVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Quantity + Deserialize<'de>, const N: usize> Visitor<'de> for EachVisitor<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, or {N} of them in brackets", T::EXPECTED)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<[T; N], E> {
        T::deserialize(value.into_deserializer()).map(|value| [value; N])
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<[T; N], E> {
        T::deserialize(value.into_deserializer()).map(|value| [value; N])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, elements: A) -> Result<[T; N], A::Error> {
        exactly(elements, &self)
    }
}

/// The elements of an array that must have `N`.
pub fn exactly<'de, A: SeqAccess<'de>, T: Copy + Deserialize<'de>, const N: usize>(
    mut elements: A,
    expected: &dyn serde::de::Expected,
) -> Result<[T; N], A::Error> {
    let mut found = Vec::with_capacity(N);
    while let Some(element) = elements.next_element()? {
        found.push(element);
    }
    <[T; N]>::try_from(found).map_err(|found| A::Error::invalid_length(found.len(), expected))
}
