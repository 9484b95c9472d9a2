//! The parts of a file: JSON, and of a `.glb` the bytes behind it.

use super::fault::Fault;

/// A file's parts.
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    /// The bytes of the first buffer, where it names no file.
    pub(super) binary: Option<&'a [u8]>,
}

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

impl<'a> Container<'a> {
    /// Takes a file apart.
    pub(super) fn split(bytes: &'a [u8]) -> Result<Self, Fault> {
        if !bytes.starts_with(b"glTF") {
            return Ok(Container {
                json: bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes),
                binary: None,
            });
        }
        let word = |at: usize| {
            let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
            word.map(u32::from_le_bytes).ok_or(Fault::CutShort {
                promised: at as u64 + 4,
                found: bytes.len() as u64,
            })
        };
        let version = word(4)?;
        if version != 2 {
            return Err(Fault::Version(version.to_string()));
        }
        let chunk = |at: usize| -> Result<(u32, &'a [u8]), Fault> {
            let (length, kind) = (word(at)? as usize, word(at + 4)?);
            let start = at + CHUNK_HEADER;
            let data = bytes[start..].get(..length).ok_or(Fault::CutShort {
                promised: (start + length) as u64,
                found: bytes.len() as u64,
            })?;
            Ok((kind, data))
        };
        let (kind, json) = chunk(HEADER)?;
        if kind != u32::from_le_bytes(*b"JSON") {
            return Err(Fault::NoJson);
        }
        let next = HEADER + CHUNK_HEADER + json.len().next_multiple_of(4);
        let binary = if next < bytes.len() {
            let (kind, data) = chunk(next)?;
            (kind == u32::from_le_bytes(*b"BIN\0")).then_some(data)
        } else {
            None
        };
        Ok(Container { json, binary })
    }
}
