//! A material by the name that its file gives it.

use super::MaterialAdjustment;
use crate::names::{Names, on_one_line};
use crate::nearest::nearest;
use crate::viewer::grammar::{name, split};

/// The most names that a message lists, and characters of each: files give any number of any length.
const LISTED: usize = 12;
const LONGEST: usize = 40;

/// Whether a name can stand in a step.
fn can_be_typed(name: &str) -> bool {
    !name.contains(|character: char| character == '"' || character.is_control())
}

/// Whether a word in the place of a name is something else: a number or a setting.
fn is_otherwise_meant(word: &str) -> bool {
    word.parse::<usize>().is_ok() || MaterialAdjustment::NAMES.contains(&word)
}

/// What to give for a material, as a list of several has it.
fn listed(index: usize, name: &str) -> String {
    if !can_be_typed(name) {
        return index.to_string();
    }
    let short = match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &name[..end]),
        None => name.into(),
    };
    if name.is_empty() || name.contains(char::is_whitespace) || is_otherwise_meant(name) {
        format!("\"{short}\"")
    } else {
        short
    }
}

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
        if word.is_empty() || is_otherwise_meant(word) {
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
            [] => Err(self.unknown(&named)),
            several => {
                let numbers: Vec<String> = several.iter().take(LISTED).map(ToString::to_string).collect();
                let more = if several.len() > LISTED { " and so on" } else { "" };
                Err(format!(
                    "\"{}\" is the name of {} materials; give the number of one: {}{more}",
                    self.name,
                    several.len(),
                    numbers.join(", ")
                ))
            }
        }
    }

    /// What is wrong where none of the materials has that name.
    fn unknown(&self, named: &[(usize, &str)]) -> String {
        let names: Vec<&str> = named.iter().map(|(_, name)| *name).collect();
        // Any short name is near to nothing at all.
        let near = nearest(&self.name, &names).filter(|_| !self.name.is_empty());
        let what = match named.iter().find(|(_, name)| Some(*name) == near) {
            Some((_, near)) if can_be_typed(near) => format!("did you mean \"{near}\""),
            Some((index, near)) => format!("did you mean {index}, the number of \"{}\"", on_one_line(near)),
            None if named.len() > LISTED => {
                format!(
                    "give one of {} names, which the step `print settings` prints",
                    named.len()
                )
            }
            None => {
                let listed: Vec<String> = named.iter().map(|(index, name)| listed(*index, name)).collect();
                format!("give one of {}", listed.join(", "))
            }
        };
        format!("\"{}\" is no material; {what}", self.name)
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
        let many: Vec<String> = (100..200).map(|number| number.to_string()).collect();
        let many: Vec<Option<&str>> = many.iter().map(|name| Some(name.as_str())).collect();
        assert!(wood.number(&names(&many)).unwrap_err().contains("one of 100 names"));
    }
    /// Oracle: what is suggested names the material, given as it is written there.
    #[test]
    fn what_is_suggested_can_be_typed() {
        let [long, mistaken] = ["wood", "woot"].map(|word| format!("a {}{word}", "very ".repeat(20)));
        for (given, name, wanted) in [
            ("wodo\\oak", "wood\\oak", "did you mean \"wood\\oak\""),
            ("it's", "its'", "did you mean \"its'\""),
            ("ol\u{308}", "\u{308}ol", "did you mean \"\u{308}ol\""),
            (
                mistaken.as_str(),
                long.as_str(),
                format!("did you mean \"{long}\"").as_str(),
            ),
            ("oldwood", "old\nwood", "did you mean 1, the number of \"old wood\""),
            ("old wood", "\"old wood", "did you mean 1, the number of \"\"old wood\""),
            ("xylophone", "7", "give one of glass-like, \"7\""),
            ("xylophone", "mirror", "give one of glass-like, \"mirror\""),
            ("xylophone", "two words", "give one of glass-like, \"two words\""),
            ("xylophone", "\"quoted\"", "give one of glass-like, 1"),
            ("xylophone", "two\nlines", "give one of glass-like, 1"),
        ] {
            let names = Names {
                materials: vec![Some("glass-like".into()), Some(name.into())],
                environment: None,
            };
            let number = |material: &str| {
                let named = NamedMaterial::parse(&format!("material {material} ior 1.5")).unwrap();
                named.map_or_else(|| Ok(material.parse().unwrap()), |named| named.number(&names))
            };
            let error = number(&format!("\"{given}\"")).unwrap_err();
            assert!(error.ends_with(wanted), "{error}");
            let suggested = wanted
                .strip_prefix("did you mean ")
                .or(wanted.strip_prefix("give one of glass-like, "));
            let suggested = suggested.unwrap().split(", the number of").next().unwrap();
            assert_eq!(number(suggested), Ok(1), "{error}");
        }
    }

    #[test]
    fn long_names_are_shortened_in_lists() {
        let names = Names {
            materials: vec![Some("b".repeat(99))],
            environment: None,
        };
        let wood = NamedMaterial::parse("material wood ior 1.5").unwrap().unwrap();
        let error = wood.number(&names).unwrap_err();
        assert!(
            error.ends_with(&format!("give one of {}...", "b".repeat(LONGEST))),
            "{error}"
        );
    }
}
