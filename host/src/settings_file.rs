//! Files of settings: a TOML table of names with a value each.

use crate::scene_file::fault::{Fault, Reason};
use crate::scene_file::place::{Place, Step};
use crate::toml_file::{Subject, TomlFileError};
use serde::de::{Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::path::Path;

/// What such a file describes.
const SUBJECT: Subject = Subject {
    file: "configuration file",
    whole: "the configuration",
    relief: "leave something out",
    top_fields: &[],
};

/// Why a setting cannot be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unfit {
    /// Its name stands for none.
    Name {
        /// All names that do.
        valid: Vec<String>,
    },
    /// Its value does not do.
    Value {
        /// What does, as in "give a number".
        expected: String,
    },
}

/// Reads the settings of a file, in its order; `check` is asked about the name and the value of each.
///
/// # Errors
/// Says in one sentence what is wrong first, where, and what to do.
pub fn read(
    path: &Path,
    check: impl Fn(&str, &str) -> Result<(), Unfit>,
) -> Result<Vec<(String, String)>, TomlFileError> {
    parse(&SUBJECT.load(path)?, path, check)
}

fn parse(
    text: &str,
    path: &Path,
    check: impl Fn(&str, &str) -> Result<(), Unfit>,
) -> Result<Vec<(String, String)>, TomlFileError> {
    SUBJECT.parse(text, path, |document| {
        let Settings(settings) = document.deserialize()?;
        let mut checked = Vec::with_capacity(settings.len());
        for (name, value) in settings {
            let wrong = |expected| Fault::unexpected(expected).inside(Step::Key(name.clone()));
            match (check(&name, value.as_deref().unwrap_or_default()), value) {
                (Err(Unfit::Name { valid }), _) => {
                    let reason = Reason::UnknownField {
                        name: name.clone(),
                        valid,
                    };
                    return Err(Fault::new(&Place::ROOT, reason));
                }
                (_, None) => return Err(wrong(WANTED.to_string())),
                (Err(Unfit::Value { expected }), _) => return Err(wrong(expected)),
                (Ok(()), Some(value)) => checked.push((name, value)),
            }
        }
        Ok(checked)
    })
}

/// What stands in the place of a value.
const WANTED: &str = "a text in quotes, or a number";

/// Names and values, in the order of the file.
struct Settings(Vec<(String, Option<String>)>);

impl<'de> Deserialize<'de> for Settings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(SettingsVisitor).map(Settings)
    }
}

struct SettingsVisitor;

impl<'de> Visitor<'de> for SettingsVisitor {
    type Value = Vec<(String, Option<String>)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let mut settings = Vec::new();
        while let Some((name, Value(value))) = entries.next_entry()? {
            settings.push((name, value));
        }
        Ok(settings)
    }
}

/// A value as it would stand on the command line; none where it could not.
struct Value(Option<String>);

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ValueVisitor).map(Value)
    }
}

struct ValueVisitor;

impl<'de> Visitor<'de> for ValueVisitor {
    type Value = Option<String>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(WANTED)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Option<String>, E> {
        Ok(Some(value.into()))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Option<String>, E> {
        Ok(Some(value.to_string()))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Option<String>, E> {
        Ok(Some(value.to_string()))
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<Option<String>, E> {
        Ok(None)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Option<String>, A::Error> {
        while elements.next_element::<IgnoredAny>()?.is_some() {}
        Ok(None)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Option<String>, A::Error> {
        while entries.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(name: &str, value: &str) -> Result<(), Unfit> {
        match (name, value) {
            ("size" | "error", "bad") => Err(Unfit::Value {
                expected: "something good".into(),
            }),
            ("size" | "error", _) => Ok(()),
            _ => Err(Unfit::Name {
                valid: vec!["size".into(), "error".into()],
            }),
        }
    }

    fn read(text: &str) -> Result<Vec<(String, String)>, String> {
        parse(text, Path::new("config.toml"), check).map_err(|error| error.to_string())
    }

    #[test]
    fn values_are_texts_in_the_order_of_the_file() {
        let pair = |name: &str, value: &str| (name.to_string(), value.to_string());
        assert_eq!(
            read("size = \"1x2\"\nerror = 0.01\n").unwrap(),
            [pair("size", "1x2"), pair("error", "0.01")]
        );
        assert_eq!(read("size = -3").unwrap(), [pair("size", "-3")]);
        assert_eq!(read("# nothing\n").unwrap(), []);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, wanted) in [
            (
                "error = 1\nsise = 2\n",
                "config.toml:2:1: the configuration has no field \"sise\"; did you mean \"size\"?",
            ),
            (
                "\nsize = \"bad\"\n",
                "config.toml:2:8: size is \"bad\"; give something good",
            ),
            (
                "[sizes]\na = [{b = 1}]\n",
                "config.toml:1:2: the configuration has no field \"sizes\"; did you mean \"size\"?",
            ),
            (
                "[size]\na = [{b = 1}]\n",
                "config.toml:1:1: size is a table; give a text in quotes, or a number",
            ),
            (
                "size = true\n",
                "config.toml:1:8: size is true; give a text in quotes, or a number",
            ),
        ] {
            assert_eq!(read(text), Err(wanted.to_string()));
        }
    }
}
