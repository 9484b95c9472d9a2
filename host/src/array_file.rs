//! Reading binary files of arrays without trusting what their headers claim.

use bytemuck::Pod;
use std::fmt;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;
use thiserror::Error;

// The files hold little-endian words, which are read as they are.
const _: () = assert!(cfg!(target_endian = "little"));

/// A file that cannot be used: its name and what is wrong with it, printed as one sentence.
#[derive(Debug, Error)]
#[error("{file}: {fault}")]
pub struct UnusableFile<F: fmt::Display> {
    /// The file.
    pub file: String,
    /// What is wrong with it and what to do.
    pub fault: F,
}

/// Why a file's bytes cannot be had.
#[derive(Debug, Error)]
pub enum FileFault {
    /// The path leads nowhere.
    #[error("there is no such file; check the path")]
    Missing,
    /// The path is a directory.
    #[error("this is a directory; give the path of a file in it")]
    Directory,
    /// The operating system refuses to read.
    #[error("the file cannot be read ({0}); check its permissions and the disk")]
    Unreadable(io::Error),
    /// Zero bytes.
    #[error("the file is empty; write it again")]
    Empty,
    /// The file ends before its header says that it does.
    #[error(
        "the file is cut short, for its header promises {promised} bytes and it has {found}; copy or write it again"
    )]
    CutShort {
        /// Bytes that there should be.
        promised: u64,
        /// Bytes that there are.
        found: u64,
    },
}

/// A file that is read from its start to its end.
#[derive(Debug)]
pub(crate) struct ArrayFile {
    reader: BufReader<File>,
    /// Bytes in the file; none where it is a pipe or a device, which may have no end.
    size: Option<u64>,
    /// Bytes read so far.
    read: u64,
    /// Bytes that the header promises.
    promised: u64,
}

/// Bytes that are asked for at a time: memory is taken as the file proves to have them.
const BLOCK: usize = 1 << 22;

impl ArrayFile {
    /// Opens a file.
    pub fn open(path: &Path) -> Result<Self, FileFault> {
        let file = File::open(path).map_err(unreadable)?;
        let metadata = file.metadata().map_err(unreadable)?;
        if metadata.is_dir() {
            return Err(FileFault::Directory);
        }
        let size = metadata.is_file().then_some(metadata.len());
        if size == Some(0) {
            return Err(FileFault::Empty);
        }
        Ok(ArrayFile {
            reader: BufReader::new(file),
            size,
            read: 0,
            promised: 0,
        })
    }

    /// The next bytes of a header, fewer where the file ends.
    pub fn head(&mut self, count: usize) -> Result<Vec<u8>, FileFault> {
        let mut bytes = Vec::new();
        let mut part = self.reader.by_ref().take(count as u64);
        part.read_to_end(&mut bytes).map_err(unreadable)?;
        self.read += bytes.len() as u64;
        Ok(bytes)
    }

    /// The next words of a header.
    pub fn words<const N: usize>(&mut self) -> Result<[u32; N], FileFault> {
        self.promised = self.promised.max(self.read + 4 * N as u64);
        let bytes = self.head(4 * N)?;
        let mut words = [0; N];
        if bytes.len() < 4 * N {
            return Err(self.cut_short());
        }
        for (word, bytes) in words.iter_mut().zip(bytes.as_chunks().0) {
            *word = u32::from_le_bytes(*bytes);
        }
        Ok(words)
    }

    /// Takes note of how many bytes the header promises after what has been read; where the file's size is known and
    /// smaller, it is refused before anything is read.
    pub fn promise(&mut self, bytes: u64) -> Result<(), FileFault> {
        self.promised = self.read.saturating_add(bytes);
        match self.size {
            Some(found) if found < self.promised => Err(FileFault::CutShort {
                promised: self.promised,
                found,
            }),
            _ => Ok(()),
        }
    }

    /// Reads an array and hands it on in pieces, which are never empty.
    pub fn pieces<T: Pod>(
        &mut self,
        count: u64,
        mut piece: impl FnMut(&[T]),
        progress: impl Fn(f32),
    ) -> Result<(), FileFault> {
        let most = (BLOCK / size_of::<T>()) as u64;
        let mut block = vec![T::zeroed(); count.min(most) as usize];
        let mut left = count;
        while left > 0 {
            let part = &mut block[..left.min(most) as usize];
            self.fill(bytemuck::cast_slice_mut(part))?;
            piece(part);
            left -= part.len() as u64;
            progress((self.read as f64 / self.promised.max(1) as f64).min(1.0) as f32);
        }
        Ok(())
    }

    /// Reads an array whole.
    pub fn array<T: Pod>(&mut self, count: u64, progress: impl Fn(f32)) -> Result<Vec<T>, FileFault> {
        let mut all = Vec::new();
        self.pieces(count, |piece| all.extend_from_slice(piece), progress)?;
        Ok(all)
    }

    fn fill(&mut self, mut bytes: &mut [u8]) -> Result<(), FileFault> {
        while !bytes.is_empty() {
            match self.reader.read(bytes) {
                Ok(0) => return Err(self.cut_short()),
                Ok(count) => {
                    self.read += count as u64;
                    bytes = &mut bytes[count..];
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(unreadable(error)),
            }
        }
        Ok(())
    }

    fn cut_short(&self) -> FileFault {
        FileFault::CutShort {
            promised: self.promised,
            found: self.read,
        }
    }
}

fn unreadable(reason: io::Error) -> FileFault {
    match reason.kind() {
        io::ErrorKind::NotFound => FileFault::Missing,
        io::ErrorKind::IsADirectory => FileFault::Directory,
        _ => FileFault::Unreadable(reason),
    }
}
