//! The bytes of a file's buffers.

use super::document::Document;
use super::fault::{Fault, Place};
use super::uri;
use crate::whole_file;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// All buffers, each as long as it says.
pub(super) struct Buffers<'a> {
    all: Vec<Cow<'a, [u8]>>,
}

impl<'a> Buffers<'a> {
    /// Reads the buffers; `files` learns of those that are files.
    pub(super) fn read(
        document: &Document,
        binary: Option<&'a [u8]>,
        folder: Option<&Path>,
        files: &mut Vec<PathBuf>,
    ) -> Result<Self, Fault> {
        let mut all = Vec::new();
        for (i, buffer) in document.buffers.iter().enumerate() {
            let place = Place::of("buffers", i);
            let mut bytes = match (&buffer.uri, binary) {
                (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
                (None, _) => Cow::Borrowed(&[][..]),
                (Some(uri), _) if uri::is_data(uri) => Cow::Owned(uri::data(uri).ok_or(Fault::Uri(place.clone()))?),
                (Some(uri), _) => {
                    let folder = folder.ok_or_else(|| Fault::NoFolder(place.clone()))?;
                    let path = uri::path(uri, folder).ok_or_else(|| Fault::Uri(place.clone()))?;
                    let bytes = whole_file::read(&path, buffer.byte_length).map_err(|fault| Fault::Buffer {
                        place: place.clone(),
                        file: path.display().to_string(),
                        fault,
                    })?;
                    files.push(path);
                    Cow::Owned(bytes)
                }
            };
            let found = bytes.len() as u64;
            if found < buffer.byte_length {
                return Err(Fault::ShortBuffer {
                    place,
                    promised: buffer.byte_length,
                    found,
                });
            }
            let length = buffer.byte_length as usize;
            match &mut bytes {
                Cow::Borrowed(bytes) => *bytes = &bytes[..length],
                Cow::Owned(bytes) => bytes.truncate(length),
            }
            all.push(bytes);
        }
        Ok(Buffers { all })
    }

    /// Bytes of all.
    pub(super) fn bytes(&self) -> usize {
        self.all.iter().map(|buffer| buffer.len()).sum()
    }

    /// The bytes of a view.
    pub(super) fn view(&self, document: &Document, id: usize) -> Result<&[u8], Fault> {
        let view = document.view(id)?;
        let buffer = super::document::get(&self.all, "buffers", view.buffer)?;
        let end = view.byte_offset.saturating_add(view.byte_length);
        if end > buffer.len() as u64 {
            return Err(Fault::Beyond {
                place: Place::of("bufferViews", id),
                reach: end,
                length: buffer.len() as u64,
            });
        }
        Ok(&buffer[view.byte_offset as usize..end as usize])
    }
}
