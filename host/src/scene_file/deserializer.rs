//! From TOML values to what they describe, with faults that know their place.
//!
//! The toml crate's own deserializer says in which bytes an error is, but neither in which field nor, as data, which
//! names would have been right.

use super::fault::Fault;
use super::place::Step;
use serde::Deserializer;
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Error, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::forward_to_deserialize_any;
use toml::Spanned;
use toml::de::{DeString, DeValue};

/// Deserializes a value.
#[derive(Clone, Copy)]
pub struct ValueDeserializer<'de>(pub &'de Spanned<DeValue<'de>>);

impl<'de> ValueDeserializer<'de> {
    fn value(self) -> &'de DeValue<'de> {
        self.0.get_ref()
    }

    /// Goes on if the value has the wanted type.
    fn only<V: Visitor<'de>>(self, is_wanted: bool, wanted: &str, visitor: V) -> Result<V::Value, Fault> {
        if is_wanted {
            self.deserialize_any(visitor)
        } else {
            Err(Fault::unexpected(wanted))
        }
    }
}

impl<'de> Deserializer<'de> for ValueDeserializer<'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.value() {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(value) => visitor.visit_i64(value),
                // Whoever wants a number says which ones fit.
                Err(_) => visitor.visit_f64(f64::NAN),
            },
            DeValue::Float(float) => visitor.visit_f64(float.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(value) => visitor.visit_bool(*value),
            DeValue::Datetime(_) => Err(Fault::invalid_type(Unexpected::Other("datetime"), &visitor)),
            DeValue::Array(array) => {
                let mut elements = Elements { rest: array, next: 0 };
                let value = visitor.visit_seq(&mut elements)?;
                // Arrays of a fixed length take their elements and leave the rest.
                if elements.rest.is_empty() {
                    Ok(value)
                } else {
                    Err(Fault::unexpected(format!("an array of length {}", elements.next)))
                }
            }
            DeValue::Table(table) => {
                // In the order of the file, so that its first fault is told first.
                let mut entries: Vec<_> = table.iter().collect();
                entries.sort_unstable_by_key(|(key, _)| std::cmp::Reverse(key.span().start));
                visitor.visit_map(Entries {
                    rest: entries,
                    value: None,
                })
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match self.value() {
            DeValue::String(text) => {
                let text: StrDeserializer<'_, Fault> = text.as_ref().into_deserializer();
                visitor.visit_enum(text)
            }
            _ => {
                let quoted: Vec<_> = variants.iter().map(|variant| format!("\"{variant}\"")).collect();
                Err(Fault::unexpected(quoted.join(" or ")))
            }
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.only(self.value().is_table(), "a table", visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.only(self.value().is_table(), "a table", visitor)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let wanted = "an array: write its name in two brackets, as in [[mesh]]";
        self.only(self.value().is_array(), wanted, visitor)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.only(self.value().is_str(), "a text in quotes", visitor)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.only(self.value().is_bool(), "true or false", visitor)
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str bytes byte_buf unit unit_struct tuple tuple_struct identifier
        ignored_any
    }
}

/// The elements of an array that are left.
struct Elements<'de> {
    rest: &'de [Spanned<DeValue<'de>>],
    next: usize,
}

impl<'de> SeqAccess<'de> for Elements<'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let Some((first, rest)) = self.rest.split_first() else {
            return Ok(None);
        };
        let index = self.next;
        (self.rest, self.next) = (rest, index + 1);
        seed.deserialize(ValueDeserializer(first))
            .map(Some)
            .map_err(|fault| fault.inside(Step::Index(index)))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.rest.len())
    }
}

/// The entries of a table that are left, the next one last.
struct Entries<'de> {
    rest: Vec<(&'de Spanned<DeString<'de>>, &'de Spanned<DeValue<'de>>)>,
    value: Option<(&'de str, &'de Spanned<DeValue<'de>>)>,
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        let Some((key, value)) = self.rest.pop() else {
            return Ok(None);
        };
        let key = key.get_ref().as_ref();
        self.value = Some((key, value));
        let key: StrDeserializer<'_, Fault> = key.into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        let Some((key, value)) = self.value.take() else {
            return Err(Fault::custom("a value was asked for before its key"));
        };
        seed.deserialize(ValueDeserializer(value))
            .map_err(|fault| fault.inside(Step::Key(key.into())))
    }
}
