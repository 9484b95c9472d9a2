//! What can be wrong with a file of rays, each said in one sentence.

use crate::array_file::{FileFault, UnusableFile};
use thiserror::Error;

/// A file of rays that cannot be used.
pub type RaysError = UnusableFile<Fault>;

/// What is wrong with a file of rays.
#[derive(Debug, Error)]
pub enum Fault {
    /// Its bytes cannot be had.
    #[error(transparent)]
    File(#[from] FileFault),
    /// None of the formats.
    #[error(
        "this is no file of rays, for it begins like neither a .npy file nor PRAY nor RAY1; save an array of N x 6 or N x 8 \
         numbers with numpy.save"
    )]
    Unknown,
    /// An archive, as `numpy.savez` makes them.
    #[error("this is an archive, as numpy.savez makes them; save the array of rays alone with numpy.save")]
    Archive,
    /// A version that is not known.
    #[error("version {found} of {format} is not supported; write the file as version {known}")]
    Version {
        /// The format.
        format: &'static str,
        /// What the file says.
        found: u32,
        /// What there is.
        known: &'static str,
    },
    /// A query that is not known.
    #[error("asks for query {0}, where 0 is the closest hit and 1 any hit; write it again with one of them")]
    Query(u32),
    /// A header of a `.npy` file that makes no sense.
    #[error("the header of the array makes no sense ({0}); save the array again with numpy.save")]
    Header(String),
    /// A header of a `.npy` file that is longer than one of an array of numbers is.
    #[error(
        "the header of the array has {found} bytes and that of an array of numbers at most {most}; save the array again with numpy.save"
    )]
    LongHeader {
        /// What the file says.
        found: u64,
        /// What is read.
        most: u64,
    },
    /// Numbers that are no floating-point ones of 32 or 64 bits.
    #[error("the array has elements of type {0}; save it as float32 or float64, array.astype('f4')")]
    Type(String),
    /// Not one row for each ray.
    #[error(
        "the array has the shape ({0}); give it a row for each ray, of 6 numbers (origin and direction) or of 8 (then tmin \
         and tmax)"
    )]
    Shape(String),
}
