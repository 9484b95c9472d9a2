//! An element as the header declares it.

use ply_rs::ply::{Addable, ElementDef, Encoding, PropertyDef, PropertyType, ScalarType};

use super::fault::Fault;
use super::role::Role;

/// One `property` line.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Shortened where it is long or strange, so that errors can quote it.
    pub(super) name: String,
    pub(super) data_type: PropertyType,
    /// `None` where the loader skips it.
    pub(super) role: Option<Role>,
}

/// One `element` line with its properties.
#[derive(Clone, Debug)]
pub(super) struct Element {
    /// Shortened where it is long or strange, so that errors can quote it.
    pub(super) name: String,
    /// Whatever the header says: not yet checked against the size of the file.
    pub(super) count: usize,
    /// Line of the header, from 1.
    pub(super) line: usize,
    pub(super) columns: Vec<Column>,
}

impl Element {
    /// The column with this name that is a list, or is none.
    pub(super) fn find(&self, name: &str, list: bool) -> Result<Option<usize>, Fault> {
        let mut found =
            self.columns.iter().enumerate().filter(|(_, column)| {
                column.name == name && matches!(column.data_type, PropertyType::List(..)) == list
            });
        let first = found.next();
        if found.next().is_some() {
            return Err(Fault::DuplicateProperty {
                element: self.name.clone(),
                property: name.to_owned(),
            });
        }
        Ok(first.map(|(column, _)| column))
    }

    /// Whether a property has this role.
    pub(super) fn has(&self, role: Role) -> bool {
        self.columns.iter().any(|column| column.role == Some(role))
    }

    /// Whether every coordinate that a file in this encoding can hold is exact in f32.
    ///
    /// Those that an ascii file declares to be floats count as such, though it can have more digits.
    pub(super) fn is_single(&self, encoding: Encoding) -> bool {
        self.columns
            .iter()
            .filter(|column| column.role.is_some_and(Role::is_coordinate))
            .all(|column| match &column.data_type {
                PropertyType::Scalar(ScalarType::Float) => true,
                PropertyType::Scalar(ScalarType::Int | ScalarType::UInt | ScalarType::Double) => false,
                _ => encoding != Encoding::Ascii,
            })
    }

    /// What ply-rs is told of the element: only the columns that have a role.
    ///
    /// In ascii a type says nothing about the layout, so indices and integer coordinates are read as doubles, which
    /// hold every one of them, whatever their type; with `exact`, so are all coordinates.
    pub(super) fn definition(&self, encoding: Encoding, exact: bool) -> ElementDef {
        let mut definition = ElementDef::new(self.name.clone());
        for column in &self.columns {
            let Some(role) = column.role else { continue };
            let kind = match &column.data_type {
                PropertyType::List(_, kind) | PropertyType::Scalar(kind) => kind,
            };
            let is_float = *kind == ScalarType::Float;
            let is_widened = match role {
                _ if encoding != Encoding::Ascii || role.is_color() => false,
                Role::Corners => true,
                _ if role.is_coordinate() => exact || !is_float,
                _ => !is_float,
            };
            let kind = if is_widened { ScalarType::Double } else { kind.clone() };
            let data_type = match &column.data_type {
                PropertyType::List(length, _) => PropertyType::List(length.clone(), kind),
                PropertyType::Scalar(_) => PropertyType::Scalar(kind),
            };
            definition
                .properties
                .add(PropertyDef::new(role.key().to_owned(), data_type));
        }
        definition
    }
}

/// The type's name in a header.
pub(super) fn type_name(kind: &ScalarType) -> &'static str {
    match kind {
        ScalarType::Char => "char",
        ScalarType::UChar => "uchar",
        ScalarType::Short => "short",
        ScalarType::UShort => "ushort",
        ScalarType::Int => "int",
        ScalarType::UInt => "uint",
        ScalarType::Float => "float",
        ScalarType::Double => "double",
    }
}
