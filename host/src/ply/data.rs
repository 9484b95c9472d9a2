//! The data after the header, cut into chunks of elements.
//!
//! Cutting proves that every element is there with all its bytes or on a line of its own, so that what is allocated
//! afterwards is bounded by the size of the file, whatever the header claims.

use ply_rs::ply::Encoding;

use super::element::Element;
use super::fault::{Fault, Place};
use super::header::Header;
use super::layout::{Layout, Misfit};
use super::lines::Lines;

/// Some successive elements of one kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chunk<'a> {
    /// From the first byte of the first element to the last of the last.
    pub(super) bytes: &'a [u8],
    /// Index of the first element among its kind.
    pub(super) first: usize,
    /// How many elements there are.
    pub(super) count: usize,
    /// Where `bytes` starts in the file: a byte in binary files, a line in ascii ones.
    pub(super) start: usize,
}

/// What is left of the data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Data<'a> {
    rest: &'a [u8],
    encoding: Encoding,
    line_end: u8,
    /// Where `rest` starts in the file, in bytes.
    byte: usize,
    /// Number of the line that `rest` starts with, in ascii files.
    line: usize,
}

impl<'a> Data<'a> {
    /// All data of a file with this header.
    pub(super) fn new(file: &'a [u8], header: &Header) -> Self {
        Self {
            rest: &file[header.body..],
            encoding: header.encoding,
            line_end: header.line_end,
            byte: header.body,
            line: header.body_line,
        }
    }

    /// Cuts off the data of the next element that the header declares.
    pub(super) fn take(&mut self, element: &Element) -> Result<Vec<Chunk<'a>>, Fault> {
        if element.columns.is_empty() {
            // There is nothing to read, however many there are.
            return Ok(Vec::new());
        }
        match self.encoding {
            Encoding::Ascii => self.take_lines(element),
            Encoding::BinaryBigEndian | Encoding::BinaryLittleEndian => self.take_bytes(element),
        }
    }

    /// Bytes after the last element that was taken, not counting blank ones in ascii.
    pub(super) fn surplus(&self) -> usize {
        match self.encoding {
            Encoding::Ascii => self.rest.trim_ascii().len(),
            Encoding::BinaryBigEndian | Encoding::BinaryLittleEndian => self.rest.len(),
        }
    }

    fn take_bytes(&mut self, element: &Element) -> Result<Vec<Chunk<'a>>, Fault> {
        let layout = Layout::new(element, self.encoding);
        let mut chunks = Vec::new();
        if let Some(stride) = layout.stride() {
            let complete = self.rest.len() / stride;
            if complete < element.count {
                return Err(self.cut_short(element, complete, complete * stride));
            }
            let mut first = 0;
            while first < element.count {
                let count = chunk_size(element.count).min(element.count - first);
                chunks.push(self.cut(first, count, count * stride));
                first += count;
            }
            return Ok(chunks);
        }
        let (mut first, mut length) = (0, 0);
        for index in 0..element.count {
            length += match layout.measure(&self.rest[length..]) {
                Ok(bytes) => bytes,
                Err(Misfit::Short) => return Err(self.cut_short(element, index, length)),
                Err(Misfit::List(list)) => {
                    return Err(Fault::ListLength {
                        place: self.place(element, index, length),
                        property: element.columns[list.column].name.clone(),
                        length: list.length,
                        left: list.left,
                    });
                }
            };
            let count = index + 1 - first;
            if count == chunk_size(element.count) || index + 1 == element.count {
                chunks.push(self.cut(first, count, length));
                (first, length) = (index + 1, 0);
            }
        }
        Ok(chunks)
    }

    fn take_lines(&mut self, element: &Element) -> Result<Vec<Chunk<'a>>, Fault> {
        let mut chunks = Vec::new();
        let (mut first, mut found) = (0, 0);
        let mut last = self.line.saturating_sub(1);
        let (file, start) = (self.rest, self.line);
        let mut used = 0;
        for line in Lines::new(file, start, self.line_end) {
            if found == element.count {
                break;
            }
            last = line.number;
            if line.is_blank() {
                continue;
            }
            found += 1;
            let count = found - first;
            if count == chunk_size(element.count) || found == element.count {
                chunks.push(self.cut(first, count, line.next - used));
                self.line = line.number + 1;
                (first, used) = (found, line.next);
            }
        }
        if found < element.count {
            return Err(Fault::TooFewLines {
                line: last,
                element: element.name.clone(),
                found,
                count: element.count,
            });
        }
        Ok(chunks)
    }

    fn cut(&mut self, first: usize, count: usize, length: usize) -> Chunk<'a> {
        let (bytes, rest) = self.rest.split_at(length);
        let start = match self.encoding {
            Encoding::Ascii => self.line,
            Encoding::BinaryBigEndian | Encoding::BinaryLittleEndian => self.byte,
        };
        self.rest = rest;
        self.byte += length;
        Chunk {
            bytes,
            first,
            count,
            start,
        }
    }

    fn cut_short(&self, element: &Element, index: usize, offset: usize) -> Fault {
        Fault::CutShort {
            place: self.place(element, index, offset),
            count: element.count,
        }
    }

    fn place(&self, element: &Element, index: usize, offset: usize) -> Place {
        Place::Element {
            element: element.name.clone(),
            index,
            byte: Some(self.byte + offset),
        }
    }
}

/// Elements in a chunk: enough to be worth a task, few enough to share among threads and to report progress.
fn chunk_size(count: usize) -> usize {
    const SMALLEST: usize = 8192;
    const CHUNKS: usize = 128;
    count.div_ceil(CHUNKS).max(SMALLEST)
}
