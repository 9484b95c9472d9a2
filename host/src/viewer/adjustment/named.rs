//! A material by the name that its file gives it.

use super::MaterialAdjustment;
use crate::names::Names;
use crate::viewer::grammar::{name, split, unknown};

/// Something about the material of a name with its new value.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    name: String,
    /// What it is to be.
    pub adjustment: MaterialAdjustment,
}

impl NamedMaterial {
    /// What `material NAME SETTING VALUE` means, with the name in quotes where it has spaces, is a number or is called like
    /// a setting; none where that is about something else, or about a number. Else what is wrong with it and what to do.
    pub fn parse(text: &str) -> Result<Option<Self>, String> {
        let ("material", rest) = split(text) else {
            return Ok(None);
        };
        let (word, _) = split(rest);
        if word.is_empty() || word.parse::<usize>().is_ok() || MaterialAdjustment::NAMES.contains(&word) {
            return Ok(None);
        }
        let (name, rest) = name(rest)?;
        let (setting, value) = split(rest);
        Ok(Some(NamedMaterial {
            name: name.into(),
            adjustment: MaterialAdjustment::parse(setting, value)?,
        }))
    }

    /// The number of the material; where there is none of that name, or more than one, what to give instead.
    pub fn number(&self, names: &Names) -> Result<usize, String> {
        let named: Vec<(usize, &str)> = names.materials().collect();
        let found: Vec<usize> = named
            .iter()
            .filter(|(_, name)| *name == self.name)
            .map(|(index, _)| *index)
            .collect();
        match found.as_slice() {
            [index] => Ok(*index),
            [] if named.is_empty() => Err(
                "no material that is shown has a name; give its number, or wait until a scene \
                                           is shown that has names"
                    .into(),
            ),
            [] => {
                let names: Vec<&str> = named.into_iter().map(|(_, name)| name).collect();
                Err(unknown(&self.name, "material", &names))
            }
            several => {
                let numbers: Vec<String> = several.iter().map(ToString::to_string).collect();
                Err(format!(
                    "\"{}\" is the name of several materials; give the number of one: {}",
                    self.name,
                    numbers.join(", ")
                ))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_name_is_a_word_or_stands_in_quotes() {
        let mirror = MaterialAdjustment::Mirror(Vec3::splat(0.5));
        for (text, name) in [
            ("material wood mirror 0.5", "wood"),
            ("material \"old wood\"  mirror 0.5", "old wood"),
            ("material \"7\" mirror 0.5", "7"),
            ("material \"mirror\" mirror 0.5", "mirror"),
        ] {
            let named = NamedMaterial::parse(text).unwrap().expect(text);
            assert_eq!((named.name.as_str(), named.adjustment), (name, mirror), "{text}");
        }
        for text in [
            "material 7 mirror 0.5",
            "material mirror 0.5",
            "material",
            "light 0 range 3",
        ] {
            assert_eq!(NamedMaterial::parse(text), Ok(None), "{text}");
        }
        for (text, wanted) in [
            ("material \"old wood mirror 0.5", "a quote is missing"),
            ("material wood mirorr 0.5", "did you mean \"mirror\""),
            ("material wood", "give one of base"),
        ] {
            let error = NamedMaterial::parse(text).unwrap_err();
            assert!(error.contains(wanted), "{text}: {error}");
        }
    }

    #[test]
    fn a_name_leads_to_one_material() {
        let names = |names: &[Option<&str>]| Names {
            materials: names.iter().map(|name| name.map(String::from)).collect(),
            environment: None,
        };
        let wood = NamedMaterial::parse("material wood ior 1.5").unwrap().unwrap();
        assert_eq!(wood.number(&names(&[Some("glass"), None, Some("wood")])), Ok(2));
        for (given, wanted) in [
            (names(&[]), "wait until a scene is shown"),
            (names(&[None]), "give its number"),
            (names(&[Some("wodo"), Some("glass")]), "did you mean \"wodo\""),
            (names(&[Some("glass"), Some("paint")]), "give one of glass, paint"),
            (
                names(&[Some("wood"), None, Some("wood")]),
                "give the number of one: 0, 2",
            ),
        ] {
            let error = wood.number(&given).unwrap_err();
            assert!(error.contains(wanted), "{error}");
        }
    }
}
