//! Reading a file whole.

use crate::array_file::FileFault;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The bytes of a file, of at most `most` of them.
///
/// # Errors
/// Where there is no such file, or no more than a device or pipe, which may have no end.
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>, FileFault> {
    let unreadable = |reason: io::Error| match reason.kind() {
        io::ErrorKind::NotFound => FileFault::Missing,
        io::ErrorKind::IsADirectory => FileFault::Directory,
        _ => FileFault::Unreadable(reason),
    };
    let file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(FileFault::Directory);
    }
    if !metadata.is_file() {
        return Err(FileFault::Unreadable(io::Error::other("it is a device or a pipe")));
    }
    let mut bytes = Vec::new();
    let size = usize::try_from(metadata.len().min(most)).unwrap_or(usize::MAX);
    bytes
        .try_reserve_exact(size)
        .map_err(|error| unreadable(error.into()))?;
    file.take(most).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.is_empty() {
        return Err(FileFault::Empty);
    }
    Ok(bytes)
}
