//! Reading elements through ply-rs, one at a time.
//!
//! ply-rs gets only the properties that the loader uses: from binary elements the bytes of the others are left out, and
//! from ascii lines their words. What it gets has been checked, since ply-rs 0.1.3 takes a negative list length for one
//! of nearly 2^64 and does not say which word of a line it cannot read.

use std::io;

use ply_rs::parser::Parser;
use ply_rs::ply::{ElementDef, Encoding, PropertyAccess};

use super::data::Chunk;
use super::element::Element;
use super::fault::{Fault, Place};
use super::header::Header;
use super::layout::Layout;
use super::lines::Lines;
use super::role::Role;
use super::words::rewrite;
use crate::excerpt::excerpt;

/// What an element is read into.
pub(super) trait Record: PropertyAccess {
    /// Appends the list of `rest`, which is the continuation of this element's own.
    fn append(&mut self, rest: Self);
}

/// Reads the elements of one kind.
pub(super) struct Reader<'a> {
    element: &'a Element,
    definition: ElementDef,
    /// Only the list, for the later parts of a long one.
    continuation: ElementDef,
    layout: Layout,
    encoding: Encoding,
    line_end: u8,
}

/// What an element was read into, and where it came from.
pub(super) struct Item<R> {
    pub(super) record: R,
    /// Index among its kind.
    pub(super) index: usize,
    /// Byte of a binary file, line of an ascii one.
    start: usize,
}

impl<'a> Reader<'a> {
    /// A reader of `element`; with `exact`, the coordinates of an ascii file are read as doubles, whatever their type.
    pub(super) fn new(header: &Header, element: &'a Element, exact: bool) -> Self {
        let definition = element.definition(header.encoding, exact);
        let mut continuation = definition.clone();
        let scalars: Vec<String> = continuation
            .properties
            .keys()
            .filter(|&key| key != Role::Corners.key())
            .cloned()
            .collect();
        for key in scalars {
            continuation.properties.remove(&key);
        }
        Self {
            element,
            definition,
            continuation,
            layout: Layout::new(element, header.encoding),
            encoding: header.encoding,
            line_end: header.line_end,
        }
    }

    /// The element that is read.
    pub(super) fn element(&self) -> &'a Element {
        self.element
    }

    /// Whether the file is text.
    pub(super) fn is_ascii(&self) -> bool {
        self.encoding == Encoding::Ascii
    }

    /// Hands every element of the chunk to `sink`, in order; returns how many lines had more words than declared.
    pub(super) fn read<R: Record>(
        &self,
        chunk: &Chunk<'_>,
        sink: impl FnMut(Item<R>) -> Result<(), Fault>,
    ) -> Result<usize, Fault> {
        match self.encoding {
            Encoding::Ascii => self.read_ascii(chunk, sink),
            Encoding::BinaryLittleEndian => {
                self.read_binary(chunk, sink, |parser, bytes, definition| {
                    parser.read_little_endian_element(bytes, definition)
                })?;
                Ok(0)
            }
            Encoding::BinaryBigEndian => {
                self.read_binary(chunk, sink, |parser, bytes, definition| {
                    parser.read_big_endian_element(bytes, definition)
                })?;
                Ok(0)
            }
        }
    }

    /// Where an item came from, for an error.
    pub(super) fn place<R>(&self, item: &Item<R>) -> Place {
        self.place_of(item.index, item.start)
    }

    fn place_of(&self, index: usize, start: usize) -> Place {
        match self.encoding {
            Encoding::Ascii => Place::Line(start),
            Encoding::BinaryLittleEndian | Encoding::BinaryBigEndian => Place::Element {
                element: self.element.name.clone(),
                index,
                byte: Some(start),
            },
        }
    }

    fn read_binary<R: Record>(
        &self,
        chunk: &Chunk<'_>,
        mut sink: impl FnMut(Item<R>) -> Result<(), Fault>,
        parse: impl Fn(&Parser<R>, &mut &[u8], &ElementDef) -> io::Result<R>,
    ) -> Result<(), Fault> {
        let parser = Parser::<R>::new();
        let mut rest = chunk.bytes;
        let mut gathered = Vec::new();
        for index in chunk.first..chunk.first + chunk.count {
            let start = chunk.start + (chunk.bytes.len() - rest.len());
            let record = if self.layout.is_all_wanted() {
                parse(&parser, &mut rest, &self.definition)
            } else {
                gathered.clear();
                let length = self
                    .layout
                    .gather(rest, &mut gathered)
                    .expect("every element of a chunk was measured when the chunk was cut");
                rest = &rest[length..];
                parse(&parser, &mut gathered.as_slice(), &self.definition)
            };
            let record = record.map_err(|error| self.parser_fault(&error, index, start))?;
            sink(Item { record, index, start })?;
        }
        Ok(())
    }

    fn read_ascii<R: Record>(
        &self,
        chunk: &Chunk<'_>,
        mut sink: impl FnMut(Item<R>) -> Result<(), Fault>,
    ) -> Result<usize, Fault> {
        let parser = Parser::<R>::new();
        let lines = Lines::new(chunk.bytes, chunk.start, self.line_end);
        let mut parts = Vec::new();
        let mut surplus = 0;
        for (index, line) in (chunk.first..).zip(lines.filter(|line| !line.is_blank())) {
            let fault = |error: io::Error| self.parser_fault(&error, index, line.number);
            surplus += usize::from(rewrite(self.element, line, &mut parts)?);
            let mut parts = parts.iter();
            let first = parts.next().map_or("", String::as_str);
            let mut record = parser.read_ascii_element(first, &self.definition).map_err(fault)?;
            for part in parts {
                let rest = parser.read_ascii_element(part, &self.continuation).map_err(fault)?;
                record.append(rest);
            }
            sink(Item {
                record,
                index,
                start: line.number,
            })?;
        }
        Ok(surplus)
    }

    fn parser_fault(&self, error: &io::Error, index: usize, start: usize) -> Fault {
        let text = error.to_string();
        Fault::Parser {
            place: self.place_of(index, start),
            reason: excerpt(text.lines().next().unwrap_or_default().as_bytes()),
        }
    }
}
