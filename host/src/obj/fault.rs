//! What can be wrong with an OBJ file, each said in one sentence.

use crate::array_file::{FileFault, UnusableFile};
use crate::texels::TooManyTexels;
use thiserror::Error;

/// An OBJ file that cannot be used.
pub type ObjError = UnusableFile<Fault>;

/// What is wrong with an OBJ file. Lines count from 1; texts quoted from it are shortened and have control characters
/// escaped.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Fault {
    /// Its bytes cannot be had.
    #[error(transparent)]
    File(#[from] FileFault),
    /// A number that is none.
    #[error("line {line}: \"{word}\" is no finite number; correct it, or export the mesh again")]
    Number {
        /// Which line.
        line: usize,
        /// The word.
        word: String,
    },
    /// Too few numbers.
    #[error("line {line}: {what} has {found} numbers and needs {needed}; add the others, or export the mesh again")]
    TooFewNumbers {
        /// Which line.
        line: usize,
        /// "v", "vt" or "vn".
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        needed: usize,
    },
    /// A corner that is none.
    #[error(
        "line {line}: \"{word}\" is no corner of a face, which is written v, v/vt, v//vn or v/vt/vn with indices from 1 \
         or -1; correct it"
    )]
    Corner {
        /// Which line.
        line: usize,
        /// The word.
        word: String,
    },
    /// An index of nothing.
    #[error("line {line}: the face has a corner at {what} {index}, and there are {count} of them; correct the index")]
    OutOfRange {
        /// Which line.
        line: usize,
        /// "vertex", "texture coordinate" or "normal".
        what: &'static str,
        /// The index, from 1.
        index: i64,
        /// How many there are.
        count: usize,
    },
    /// A polygon that would take too long.
    #[error("line {line}: the face is concave and has {corners} corners, more than {limit}; cut it into smaller ones")]
    PolygonTooLarge {
        /// Which line.
        line: usize,
        /// How many corners it has.
        corners: usize,
        /// How many it may have.
        limit: usize,
    },
    /// Nothing to see.
    #[error("there are no faces in the file, so there is nothing to trace; export the mesh with its faces")]
    NoFaces,
    /// More than ids can count.
    #[error("the mesh has more {0} than the 4294967295 that are supported; split it")]
    TooMany(&'static str),
    /// Coordinates that f32 cannot hold.
    #[error(
        "vertex {0} (counted from 1) is beyond what single precision holds beside the others; export it in other units"
    )]
    TooFar(usize),
    /// A line of an MTL file that is wrong.
    #[error("{file}, line {line}: \"{word}\" is no finite number; correct it, or leave its line out")]
    Material {
        /// The MTL file.
        file: String,
        /// Which line.
        line: usize,
        /// The word.
        word: String,
    },
    /// Images larger than a GPU takes.
    #[error(transparent)]
    Texels(#[from] TooManyTexels),
}
