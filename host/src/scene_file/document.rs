//! The text of a scene file, and where in it things stand.

use super::deserializer::ValueDeserializer;
use super::fault::{Fault, Reason};
use super::place::Step;
use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A scene file in memory.
pub struct Document<'a> {
    text: &'a str,
    root: Spanned<DeValue<'a>>,
}

/// Line and column of something in a text, both from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

/// A value that is longer than this is not repeated in a message.
const LONGEST_SNIPPET: usize = 40;

impl<'a> Document<'a> {
    /// Parses a text as TOML.
    ///
    /// # Errors
    /// Where and why it is none.
    pub fn parse(text: &'a str) -> Result<Self, (Position, String)> {
        match DeTable::parse(text) {
            Ok(table) => {
                let span = table.span();
                let root = Spanned::new(span, DeValue::Table(table.into_inner()));
                Ok(Document { text, root })
            }
            Err(error) => {
                let offset = error.span().map_or(0, |span| span.start);
                Err((position(text, offset), error.message().replace('\n', ", ")))
            }
        }
    }

    /// Reads the document as a value.
    ///
    /// # Errors
    /// What is not as it should be.
    pub fn deserialize<T: Deserialize<'a>>(&'a self) -> Result<T, Fault> {
        T::deserialize(ValueDeserializer(&self.root))
    }

    /// Where a fault is; completes what the fault says about the value there.
    pub fn locate(&self, fault: &mut Fault) -> Position {
        let mut span = self.root.span();
        let mut value = self.root.get_ref();
        let mut is_whole = true;
        for step in fault.place.steps() {
            let next = match (step, value) {
                (Step::Key(key), DeValue::Table(table)) => table.get(key.as_str()),
                (Step::Index(index), DeValue::Array(array)) => array.get(*index),
                _ => None,
            };
            let Some(next) = next else {
                // What is not there stands where it would be.
                is_whole = false;
                break;
            };
            (span, value) = (next.span(), next.get_ref());
        }
        match &mut fault.reason {
            Reason::UnknownField { name, .. } => {
                if let DeValue::Table(table) = value
                    && let Some((key, _)) = table.get_key_value(name.as_str())
                {
                    span = key.span();
                }
            }
            Reason::Unexpected { found, .. } if is_whole => *found = self.snippet(value, &span),
            _ => {}
        }
        position(self.text, span.start)
    }

    /// A value as it stands in the text, if it is short.
    fn snippet(&self, value: &DeValue<'_>, span: &Range<usize>) -> String {
        let text = self.text.get(span.clone()).unwrap_or_default();
        match value {
            DeValue::Table(_) => "a table".into(),
            _ if text.len() <= LONGEST_SNIPPET && !text.contains('\n') => text.into(),
            DeValue::Array(array) => format!("an array of {}", array.len()),
            _ => format!("a long {}", value.type_str()),
        }
    }
}

fn position(text: &str, offset: usize) -> Position {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Position {
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}
