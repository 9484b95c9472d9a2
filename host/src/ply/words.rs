//! One line of an ascii file, put into the words that ply-rs shall read.

use std::fmt::Write;

use ply_rs::ply::{PropertyType, ScalarType};

use super::element::{Column, Element, type_name};
use super::fault::{Fault, Place};
use super::lines::Line;
use super::number::{Decimal, is_not_finite};
use super::role::Role;
use crate::excerpt::excerpt;

/// Writes the wanted words of a line in the form that ply-rs reads: into one line, and for a long list into further
/// ones, because ply-rs spends some 60 bytes on a word. Says whether the line has words beyond the last property.
pub(super) fn rewrite(element: &Element, line: Line<'_>, parts: &mut Vec<String>) -> Result<bool, Fault> {
    const LONGEST: usize = 4096;
    let mut words = line.words();
    let mut first = parts.drain(..).next().unwrap_or_default();
    first.clear();
    let mut later = Vec::new();
    for column in &element.columns {
        let mut next = || {
            words.next().ok_or_else(|| Fault::ShortLine {
                line: line.number,
                element: element.name.clone(),
                property: column.name.clone(),
            })
        };
        match (&column.data_type, column.role) {
            (PropertyType::Scalar(_), None) => {
                next()?;
            }
            (PropertyType::Scalar(kind), Some(role)) => {
                push_word(&mut first, next()?, line, column, kind, role)?;
            }
            (PropertyType::List(kind, item), role) => {
                let length = list_length(next()?, line, column, kind)?;
                let Some(role) = role else {
                    for _ in 0..length {
                        next()?;
                    }
                    continue;
                };
                let mut part = &mut first;
                let mut start = 0;
                loop {
                    let end = length.min(start + LONGEST);
                    push_length(part, end - start);
                    for _ in start..end {
                        push_word(part, next()?, line, column, item, role)?;
                    }
                    if end == length {
                        break;
                    }
                    start = end;
                    later.push(String::new());
                    part = later.last_mut().expect("a part was just pushed");
                }
            }
        }
    }
    parts.push(first);
    parts.append(&mut later);
    Ok(words.next().is_some())
}

fn list_length(word: &[u8], line: Line<'_>, column: &Column, kind: &ScalarType) -> Result<usize, Fault> {
    let length = Decimal::parse(word)
        .and_then(Decimal::whole)
        .ok_or_else(|| not_a_number(word, line, column, kind))?;
    usize::try_from(length).map_err(|_| Fault::ListLength {
        place: Place::Line(line.number),
        property: column.name.clone(),
        length,
        left: line.text.trim_ascii().len(),
    })
}

fn push_length(part: &mut String, length: usize) {
    write!(part, " {length}").expect("writing to a string cannot fail");
}

fn push_word(
    part: &mut String,
    word: &[u8],
    line: Line<'_>,
    column: &Column,
    kind: &ScalarType,
    role: Role,
) -> Result<(), Fault> {
    part.push(' ');
    match Decimal::parse(word) {
        Some(decimal) if role.is_color() && !is_float(kind) => {
            let whole = decimal
                .whole()
                .filter(|&whole| fits(kind, whole))
                .ok_or_else(|| not_a_number(word, line, column, kind))?;
            write!(part, "{whole}").expect("writing to a string cannot fail");
        }
        Some(decimal) => decimal.write(part),
        None if !is_not_finite(word) || role == Role::Corners => {
            return Err(not_a_number(word, line, column, kind));
        }
        None if role.is_coordinate() => {
            return Err(Fault::NotFinite {
                place: Place::Line(line.number),
                axis: role.key(),
                value: excerpt(word),
            });
        }
        // ply-rs does not read NaN; a zero normal counts as missing, which is what a normal of NaN shall do, and a
        // texture coordinate of NaN shall be zero.
        None => part.push('0'),
    }
    Ok(())
}

fn not_a_number(word: &[u8], line: Line<'_>, column: &Column, kind: &ScalarType) -> Fault {
    Fault::NotANumber {
        line: line.number,
        text: excerpt(word),
        property: column.name.clone(),
        kind: type_name(kind),
    }
}

fn is_float(kind: &ScalarType) -> bool {
    matches!(kind, ScalarType::Float | ScalarType::Double)
}

fn fits(kind: &ScalarType, value: i64) -> bool {
    match kind {
        ScalarType::Char => i8::try_from(value).is_ok(),
        ScalarType::UChar => u8::try_from(value).is_ok(),
        ScalarType::Short => i16::try_from(value).is_ok(),
        ScalarType::UShort => u16::try_from(value).is_ok(),
        ScalarType::Int => i32::try_from(value).is_ok(),
        ScalarType::UInt => u32::try_from(value).is_ok(),
        ScalarType::Float | ScalarType::Double => true,
    }
}
