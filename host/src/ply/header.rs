//! The header of a PLY file.
//!
//! It is scanned here and not by ply-rs 0.1.3, which never returns from a header without end, panics on a count above
//! 2^64 and merges properties of the same name, so that all that follows is read from the wrong place.

use std::collections::BTreeMap;

use ply_rs::ply::{Encoding, PropertyType, ScalarType};

use super::element::{Column, Element};
use super::fault::Fault;
use super::lines::{Line, Lines};
use crate::excerpt::excerpt;

/// What a header says, and where it ends.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the data starts, in bytes from the start of the file.
    pub(super) body: usize,
    /// Number of the first line after the header.
    pub(super) body_line: usize,
    /// The byte that ends a line: `\n`, or `\r` where the first line ends in that alone.
    pub(super) line_end: u8,
}

impl Header {
    /// Scans the header at the start of a file.
    pub(super) fn scan(file: &[u8]) -> Result<Self, Fault> {
        let text = file.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(file);
        let start = file.len() - text.len();
        check_magic(text)?;
        let line_end = match text.iter().position(|&byte| matches!(byte, b'\r' | b'\n')) {
            Some(end) if text[end] == b'\r' && text.get(end + 1) != Some(&b'\n') => b'\r',
            _ => b'\n',
        };
        let mut lines = Lines::new(text, 1, line_end);
        match lines.next() {
            Some(line) if line.words().eq([b"ply".as_slice()]) => {}
            _ => return Err(Fault::NotPly),
        }

        let mut format = None;
        let mut elements: Vec<Element> = Vec::new();
        for line in lines {
            let mut words = line.words();
            let keyword = words.next().unwrap_or_default();
            if matches!(keyword, b"" | b"comment" | b"obj_info") {
                continue;
            }
            // The longest valid line has five words; the rest of a longer one need not be kept.
            let values: Vec<&[u8]> = words.take(5).collect();
            match (keyword, values.as_slice()) {
                (b"format", values) => {
                    let encoding = parse_format(line, values)?;
                    if format.is_some_and(|earlier| earlier != encoding) {
                        return Err(Fault::ContradictingFormat { line: line.number });
                    }
                    format = Some(encoding);
                }
                (b"element", [name, count]) => elements.push(Element {
                    name: excerpt(name),
                    count: parse_count(line, name, count)?,
                    line: line.number,
                    columns: Vec::new(),
                }),
                (b"property", values) => {
                    let column = parse_property(line, values)?;
                    elements
                        .last_mut()
                        .ok_or(Fault::PropertyWithoutElement { line: line.number })?
                        .columns
                        .push(column);
                }
                (b"end_header", []) => {
                    return Ok(Self {
                        encoding: format.ok_or(Fault::NoFormat)?,
                        elements,
                        body: start + line.next,
                        body_line: line.number + 1,
                        line_end,
                    });
                }
                _ => return Err(unknown_line(line)),
            }
        }
        Err(Fault::NoEndHeader)
    }

    /// The element of this name, of which there may be one at most.
    pub(super) fn find(&self, name: &str) -> Result<Option<usize>, Fault> {
        let mut found = self
            .elements
            .iter()
            .enumerate()
            .filter(|(_, element)| element.name == name);
        let first = found.next();
        if let Some((_, second)) = found.next() {
            return Err(Fault::DuplicateElement {
                line: second.line,
                element: name.to_owned(),
            });
        }
        Ok(first.map(|(index, _)| index))
    }

    /// What the header declares, in words.
    pub(super) fn summary(&self) -> String {
        const MOST: usize = 4;
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for element in &self.elements {
            let count = counts.entry(&element.name).or_default();
            *count = count.saturating_add(element.count);
        }
        let mut words: Vec<String> = counts
            .iter()
            .take(MOST)
            .map(|(name, count)| format!("{count} \"{name}\""))
            .collect();
        if counts.len() > MOST {
            words.push(format!("{} more elements", counts.len() - MOST));
        }
        if words.is_empty() {
            words.push("no elements at all".to_owned());
        }
        words.join(", ")
    }
}

/// Whether a file of which these are the first bytes can be a PLY file.
pub(super) fn check_magic(start: &[u8]) -> Result<(), Fault> {
    let text = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(start);
    match text {
        [] => Err(Fault::Empty),
        [0x1F, 0x8B, ..] => Err(Fault::Gzip),
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => Err(Fault::Utf16),
        [b'p', b'l', b'y', ..] => Ok(()),
        _ => Err(Fault::NotPly),
    }
}

fn unknown_line(line: Line<'_>) -> Fault {
    Fault::UnknownLine {
        line: line.number,
        text: excerpt(line.text),
    }
}

fn parse_format(line: Line<'_>, values: &[&[u8]]) -> Result<Encoding, Fault> {
    let unknown = || Fault::UnknownFormat {
        line: line.number,
        text: excerpt(line.text),
    };
    let [encoding, version] = values else {
        return Err(unknown());
    };
    let encoding = match *encoding {
        b"ascii" => Encoding::Ascii,
        b"binary_little_endian" => Encoding::BinaryLittleEndian,
        b"binary_big_endian" => Encoding::BinaryBigEndian,
        _ => return Err(unknown()),
    };
    if *version != b"1.0" {
        return Err(Fault::UnsupportedVersion {
            line: line.number,
            version: excerpt(version),
        });
    }
    Ok(encoding)
}

fn parse_count(line: Line<'_>, element: &[u8], count: &[u8]) -> Result<usize, Fault> {
    let digits = count.iter().all(u8::is_ascii_digit);
    std::str::from_utf8(count)
        .ok()
        .filter(|_| digits)
        .and_then(|count| count.parse().ok())
        .ok_or_else(|| Fault::Count {
            line: line.number,
            element: excerpt(element),
            text: excerpt(count),
        })
}

fn parse_property(line: Line<'_>, values: &[&[u8]]) -> Result<Column, Fault> {
    let (data_type, name) = match *values {
        [b"list", length, item, name] => {
            let length = match parse_type(length) {
                Some(kind) if !matches!(kind, ScalarType::Float | ScalarType::Double) => kind,
                _ => {
                    return Err(Fault::UnknownType {
                        line: line.number,
                        text: excerpt(length),
                        what: "list length",
                        more: "",
                    });
                }
            };
            (PropertyType::List(length, parse_value_type(line, item)?), name)
        }
        [kind, name] => (PropertyType::Scalar(parse_value_type(line, kind)?), name),
        _ => return Err(unknown_line(line)),
    };
    Ok(Column {
        name: excerpt(name),
        data_type,
        role: None,
    })
}

fn parse_value_type(line: Line<'_>, name: &[u8]) -> Result<ScalarType, Fault> {
    parse_type(name).ok_or_else(|| Fault::UnknownType {
        line: line.number,
        text: excerpt(name),
        what: "property",
        more: ", float and double",
    })
}

fn parse_type(name: &[u8]) -> Option<ScalarType> {
    Some(match name {
        b"char" | b"int8" => ScalarType::Char,
        b"uchar" | b"uint8" => ScalarType::UChar,
        b"short" | b"int16" => ScalarType::Short,
        b"ushort" | b"uint16" => ScalarType::UShort,
        b"int" | b"int32" => ScalarType::Int,
        b"uint" | b"uint32" => ScalarType::UInt,
        b"float" | b"float32" => ScalarType::Float,
        b"double" | b"float64" => ScalarType::Double,
        _ => return None,
    })
}
