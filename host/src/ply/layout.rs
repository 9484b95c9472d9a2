//! Where the bytes of a binary element are.

use ply_rs::ply::{Encoding, PropertyType, ScalarType};

use super::element::Element;

/// The bytes of one element, property by property.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    fields: Vec<Field>,
    big_endian: bool,
}

#[derive(Clone, Debug)]
struct Field {
    /// The length's type, for a list.
    list: Option<ScalarType>,
    /// Bytes of the scalar or of an entry.
    size: usize,
    wanted: bool,
}

/// A list that does not fit into what is left of the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct BadList {
    /// Index of the property.
    pub(super) column: usize,
    pub(super) length: i64,
    /// Bytes after the length.
    pub(super) left: usize,
}

/// Why an element could not be measured.
#[derive(Clone, Copy, Debug)]
pub(super) enum Misfit {
    /// The data ends within the element.
    Short,
    /// A list is longer than the data, or of negative length.
    List(BadList),
}

impl Layout {
    pub(super) fn new(element: &Element, encoding: Encoding) -> Self {
        let fields = element
            .columns
            .iter()
            .map(|column| {
                let (list, kind) = match &column.data_type {
                    PropertyType::Scalar(kind) => (None, kind),
                    PropertyType::List(length, kind) => (Some(length.clone()), kind),
                };
                Field {
                    list,
                    size: size(kind),
                    wanted: column.role.is_some(),
                }
            })
            .collect();
        Self {
            fields,
            big_endian: encoding == Encoding::BinaryBigEndian,
        }
    }

    /// Bytes of every element, where there are no lists.
    pub(super) fn stride(&self) -> Option<usize> {
        self.fields
            .iter()
            .map(|field| field.list.is_none().then_some(field.size))
            .sum()
    }

    /// Whether the loader uses every property.
    pub(super) fn is_all_wanted(&self) -> bool {
        self.fields.iter().all(|field| field.wanted)
    }

    /// Bytes of the element at the start of `bytes`, all of which exist.
    pub(super) fn measure(&self, bytes: &[u8]) -> Result<usize, Misfit> {
        self.walk(bytes, |_, _| {})
    }

    /// Appends the bytes of the wanted properties of the element at the start of `bytes`, and measures it.
    pub(super) fn gather(&self, bytes: &[u8], wanted: &mut Vec<u8>) -> Result<usize, Misfit> {
        self.walk(bytes, |field, bytes| {
            if field.wanted {
                wanted.extend_from_slice(bytes);
            }
        })
    }

    fn walk(&self, bytes: &[u8], mut visit: impl FnMut(&Field, &[u8])) -> Result<usize, Misfit> {
        let mut at = 0;
        for (column, field) in self.fields.iter().enumerate() {
            let rest = &bytes[at..];
            let length = match &field.list {
                None => field.size,
                Some(kind) => {
                    let prefix = size(kind);
                    let length = self.list_length(kind, rest).ok_or(Misfit::Short)?;
                    let left = rest.len() - prefix;
                    usize::try_from(length)
                        .ok()
                        .and_then(|length| length.checked_mul(field.size))
                        .filter(|&bytes| bytes <= left)
                        .map(|bytes| prefix + bytes)
                        .ok_or(Misfit::List(BadList { column, length, left }))?
                }
            };
            visit(field, rest.get(..length).ok_or(Misfit::Short)?);
            at += length;
        }
        Ok(at)
    }

    fn list_length(&self, kind: &ScalarType, bytes: &[u8]) -> Option<i64> {
        let mut length = [0; 4];
        let prefix = bytes.get(..size(kind))?;
        length[..prefix.len()].copy_from_slice(prefix);
        if self.big_endian {
            length[..prefix.len()].reverse();
        }
        let length = u32::from_le_bytes(length);
        // Truncation is meant: each arm keeps the bytes that the type has.
        Some(match kind {
            ScalarType::Char => i64::from(length as i8),
            ScalarType::Short => i64::from(length as i16),
            ScalarType::Int => i64::from(length as i32),
            _ => i64::from(length),
        })
    }
}

/// Bytes of a scalar. List lengths are never float or double: [`super::header`] refuses them.
fn size(kind: &ScalarType) -> usize {
    match kind {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}
