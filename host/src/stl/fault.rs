//! What can be wrong with an STL file, each said in one sentence.

use crate::array_file::{FileFault, UnusableFile};
use thiserror::Error;

/// An STL file that cannot be used.
pub type StlError = UnusableFile<Fault>;

/// What is wrong with an STL file. Texts quoted from it are shortened and have control characters escaped.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Fault {
    /// Its bytes cannot be had.
    #[error(transparent)]
    File(#[from] FileFault),
    /// Neither text nor as long as a header.
    #[error(
        "this is no STL file, for it neither begins with \"solid\" nor has a header of 84 bytes; export the mesh again"
    )]
    NotStl,
    /// A binary file that ends too early.
    #[error(
        "the file ends after {found} of the {promised} facets that its header promises; it is cut short or no STL file, \
         so copy or export it again"
    )]
    CutShort {
        /// Facets that there should be.
        promised: u32,
        /// Facets that there are.
        found: usize,
    },
    /// Text that ends within a facet.
    #[error("line {line}: the file ends where {wanted} should be; it is cut short, so copy or export it again")]
    CutText {
        /// Last line, from 1.
        line: usize,
        /// What is missing.
        wanted: &'static str,
    },
    /// A word that does not belong there.
    #[error("line {line}: \"{word}\" stands where {wanted} should be; correct it, or export the mesh again")]
    Unexpected {
        /// Line, from 1.
        line: usize,
        /// The word.
        word: String,
        /// What should be there.
        wanted: &'static str,
    },
    /// A coordinate that is none.
    #[error("line {line}: \"{word}\" is no finite number; correct the coordinate, or export the mesh again")]
    Number {
        /// Line, from 1.
        line: usize,
        /// The word.
        word: String,
    },
    /// A binary coordinate that is none.
    #[error(
        "facet {facet} (counted from 0, at byte {byte}) has a coordinate that is not finite; export the mesh again"
    )]
    NotFinite {
        /// Which facet.
        facet: usize,
        /// Where it starts, bytes from the file's start.
        byte: usize,
    },
    /// Nothing to see.
    #[error("there are no facets in the file, so there is nothing to trace; export the mesh with its faces")]
    NoTriangles,
    /// More than ids can count.
    #[error("the mesh has more triangles or vertices than the 4294967295 that are supported; split it")]
    TooMany,
    /// Coordinates that f32 cannot hold.
    #[error("a coordinate is beyond what single precision holds; export the mesh in other units")]
    TooFar,
}
