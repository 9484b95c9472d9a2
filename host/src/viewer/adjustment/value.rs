//! Values as people write them: numbers in the ranges of scene files, names of the command line.

use crate::scene_file::Quantity;
use crate::viewer::grammar::unknown;
use clap::ValueEnum;
use glam::Vec3;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::{Error, SeqDeserializer};
use std::ops::RangeInclusive;

/// A number in the range that scene files have for it.
pub fn number<T: Quantity + for<'de> Deserialize<'de>>(text: &str) -> Result<T, String> {
    let wanted = || format!("give {}", T::EXPECTED);
    let number: f64 = text.parse().map_err(|_| wanted())?;
    T::deserialize(IntoDeserializer::<Error>::into_deserializer(number)).map_err(|_| wanted())
}

/// A number in another range, of so many of what `unit` says.
pub fn number_in(text: &str, range: &RangeInclusive<f32>, unit: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("give a number of {unit} from {} to {}", range.start(), range.end()))
}

/// A colour as scene files have it: `#rrggbb`, a number for a grey, or red, green and blue, separated by commas.
pub fn color<T: for<'de> Deserialize<'de>>(text: &str) -> Result<T, String> {
    let read = if text.starts_with('#') {
        T::deserialize(IntoDeserializer::<Error>::into_deserializer(text))
    } else {
        match channels(text)?.as_slice() {
            [grey] => T::deserialize(IntoDeserializer::<Error>::into_deserializer(*grey)),
            channels => T::deserialize(SeqDeserializer::<_, Error>::new(channels.iter().copied())),
        }
    };
    read.map_err(|error| format!("{error}; for example: 1,0.5,0"))
}

/// A place: three coordinates, separated by commas.
pub fn position(text: &str) -> Result<Vec3, String> {
    let wanted = || "give three coordinates from -1e9 to 1e9, separated by commas, for example: 1,2.5,-3".to_owned();
    match channels(text).map_err(|_| wanted())?.as_slice() {
        [x, y, z] if [x, y, z].iter().all(|coordinate| coordinate.abs() <= 1e9) => {
            Ok(Vec3::new(*x as f32, *y as f32, *z as f32))
        }
        _ => Err(wanted()),
    }
}

fn channels(text: &str) -> Result<Vec<f64>, String> {
    let numbers = text.split(',').map(|number| number.trim().parse());
    let numbers: Result<Vec<f64>, _> = numbers.collect();
    numbers.map_err(|_| {
        format!("\"{text}\" is no colour; give a number, red, green and blue separated by commas, or #rrggbb")
    })
}

/// One of some values, by its name.
pub fn named<T: Copy>(text: &str, kind: &str, all: &[T], name: impl Fn(T) -> String) -> Result<T, String> {
    let names: Vec<String> = all.iter().map(|value| name(*value)).collect();
    match names.iter().position(|name| name == text) {
        Some(place) => Ok(all[place]),
        None => Err(unknown(
            text,
            kind,
            &names.iter().map(String::as_str).collect::<Vec<_>>(),
        )),
    }
}

/// One of the values that the command line takes.
pub fn choice<T: ValueEnum + Copy>(text: &str, kind: &str) -> Result<T, String> {
    named(text, kind, T::value_variants(), |value| {
        crate::viewer::caption::name(&value)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::{Depth, Stops};
    use crate::tone::Curve;

    #[test]
    fn numbers_have_ranges_and_names_are_found() {
        assert_eq!(number::<Stops>("-1.5").map(|stops| stops.0), Ok(-1.5));
        assert_eq!(number::<Depth>("3").map(|depth| depth.0), Ok(3));
        for bad in ["", "x", "1.5", "17", "-1", "NaN"] {
            let error = number::<Depth>(bad).unwrap_err();
            assert_eq!(
                error, "give a whole number of reflections and refractions from 0 to 16",
                "{bad}"
            );
        }
        assert_eq!(number_in("0.5", &(0.01..=1000.0), "radii"), Ok(0.5));
        assert!(
            number_in("0.001", &(0.01..=1000.0), "radii")
                .unwrap_err()
                .contains("radii from 0.01")
        );
        assert_eq!(choice::<Curve>("aces", "tone curve"), Ok(Curve::Aces));
        let error = choice::<Curve>("acess", "tone curve").unwrap_err();
        assert!(error.contains("did you mean \"aces\""), "{error}");
    }
}
