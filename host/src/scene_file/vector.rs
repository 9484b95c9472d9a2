//! Points and directions.

use super::number::{Coordinate, exactly};
use glam::DVec3;
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;

/// `[x, y, z]`, scene units, each from -1e9 to 1e9.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vector(pub DVec3);

/// A [`Vector`] that is not zero; its length means nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction(pub DVec3);

impl<'de> Deserialize<'de> for Vector {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer
            .deserialize_any(VectorVisitor("three numbers: [x, y, z]"))
            .map(Vector)
    }
}

impl<'de> Deserialize<'de> for Direction {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "three numbers, not all 0: [x, y, z]";
        let vector = deserializer.deserialize_any(VectorVisitor(expected))?;
        if vector == DVec3::ZERO {
            let zero = serde::de::Unexpected::Seq;
            return Err(serde::de::Error::invalid_value(zero, &expected));
        }
        Ok(Direction(vector))
    }
}

struct VectorVisitor(&'static str);

impl<'de> Visitor<'de> for VectorVisitor {
    type Value = DVec3;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, elements: A) -> Result<DVec3, A::Error> {
        let coordinates: [Coordinate; 3] = exactly(elements, &self)?;
        Ok(DVec3::from_array(coordinates.map(|coordinate| coordinate.0)))
    }
}
