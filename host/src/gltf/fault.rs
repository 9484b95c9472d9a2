//! What can be wrong with a glTF file, each said in one sentence.

use crate::array_file::{FileFault, UnusableFile};
use crate::texels::TooManyTexels;
use std::fmt;
use thiserror::Error;

/// A glTF file that cannot be used.
pub type GltfError = UnusableFile<Fault>;

/// Where in a file something is, such as `meshes[3].primitives[0]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place(String);

impl Place {
    /// An element of an array at the top.
    pub(super) fn of(array: &str, index: usize) -> Self {
        Place(format!("{array}[{index}]"))
    }

    /// A field of what is here.
    pub(super) fn field(&self, name: &str) -> Self {
        Place(format!("{}.{name}", self.0))
    }

    /// An element of what is here.
    pub(super) fn index(&self, index: usize) -> Self {
        Place(format!("{}[{index}]", self.0))
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// What is wrong with a glTF file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Fault {
    /// Its bytes cannot be had.
    #[error(transparent)]
    File(#[from] FileFault),
    /// A `.glb` whose parts do not fit into it.
    #[error(
        "the file is cut short or damaged, for its header promises {promised} bytes and it has {found}; copy or export it again"
    )]
    CutShort {
        /// Bytes that there should be.
        promised: u64,
        /// Bytes that there are.
        found: u64,
    },
    /// A `.glb` that does not begin with JSON.
    #[error("the file's first chunk is no JSON; export it again as glTF 2.0")]
    NoJson,
    /// Not JSON, or JSON of another form.
    #[error("the JSON of the file cannot be used ({0}); correct it, or export it again")]
    Json(String),
    /// JSON of something else.
    #[error("this is no glTF file, for it lacks asset.version; export the scene again as glTF 2.0")]
    NotGltf,
    /// An older or newer format.
    #[error("version {0} of glTF is not supported; export the scene as glTF 2.0")]
    Version(String),
    /// Something without which the file cannot be understood.
    #[error("the file needs the extension {0}, which is not supported; export it without")]
    Extension(String),
    /// An index of nothing.
    #[error("{place} is mentioned, and there are {count} of them; correct the index, or export the file again")]
    NoSuch {
        /// What is mentioned.
        place: Place,
        /// How many there are.
        count: usize,
    },
    /// A node above itself, or below two others.
    #[error("{0} is reached twice from the scene, whose nodes must be a tree; take it out of the children of one")]
    NoTree(Place),
    /// A buffer beside a file that lies nowhere.
    #[error("{0} is a file beside this one, and a file in memory has none beside it; save it, and give its path")]
    NoFolder(Place),
    /// A buffer that cannot be had.
    #[error("{place} cannot be used: {file}: {fault}")]
    Buffer {
        /// Which.
        place: Place,
        /// The file.
        file: String,
        /// What is wrong with it.
        fault: FileFault,
    },
    /// A URI that is no file and no data.
    #[error("{0} is neither the name of a file beside this one nor data in base64; export the file with its buffers")]
    Uri(Place),
    /// A buffer without bytes.
    #[error("{place} has {found} bytes and claims {promised}; copy or export it again")]
    ShortBuffer {
        /// Which.
        place: Place,
        /// Bytes that it says it has.
        promised: u64,
        /// Bytes that there are.
        found: u64,
    },
    /// A part of a buffer that is not there.
    #[error(
        "{place} reaches beyond what it is a part of ({reach} of {length} bytes); correct it, or export the file again"
    )]
    Beyond {
        /// Which.
        place: Place,
        /// Its end, bytes.
        reach: u64,
        /// Bytes that there are.
        length: u64,
    },
    /// Numbers of another kind than can be used there.
    #[error("{place} is {found}; give {wanted}")]
    Kind {
        /// Which accessor.
        place: Place,
        /// What it is.
        found: String,
        /// What it should be.
        wanted: &'static str,
    },
    /// Elements closer together than they are long.
    #[error("{place} has a stride of {stride} bytes for elements of {size}; correct it, or export the file again")]
    Stride {
        /// Which view.
        place: Place,
        /// Bytes from element to element.
        stride: u64,
        /// Bytes of an element.
        size: u64,
    },
    /// Zeros without end.
    #[error(
        "{place} claims {count} elements without data for them; at most {most} are taken, so export the file again"
    )]
    TooManyZeros {
        /// Which accessor.
        place: Place,
        /// How many.
        count: u64,
        /// How many may be.
        most: u64,
    },
    /// An attribute that is not as long as the positions.
    #[error("{place} has {found} elements for {wanted} vertices; export the file again")]
    Length {
        /// Which attribute.
        place: Place,
        /// How many there are.
        found: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// A primitive without vertices.
    #[error("{0} has no POSITION, without which there is nothing to see; export the file again")]
    NoPositions(Place),
    /// A position that is none.
    #[error("{place} has a vertex {vertex} (counted from 0) that is not finite; correct it, or export the file again")]
    NotFinite {
        /// Which primitive.
        place: Place,
        /// Which vertex.
        vertex: usize,
    },
    /// A triangle with a corner that is not there.
    #[error(
        "{place} has a triangle with the corner {corner}, and there are {vertices} vertices; export the file again"
    )]
    Corner {
        /// Which primitive.
        place: Place,
        /// The index.
        corner: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A number that cannot be.
    #[error("{place} is {value}; give {wanted}")]
    Value {
        /// Which.
        place: Place,
        /// The number.
        value: f64,
        /// What it should be.
        wanted: &'static str,
    },
    /// Nothing to see.
    #[error("the scene has no triangles, so there is nothing to trace; export it with its meshes")]
    NoTriangles,
    /// More than the file can mean.
    #[error(
        "{place} makes it more than {most} triangles or vertices, too many for a file of this size; show fewer meshes"
    )]
    TooMany {
        /// Where it becomes too much.
        place: Place,
        /// How many may be.
        most: usize,
    },
    /// Coordinates that f32 cannot hold.
    #[error("a vertex is beyond what single precision holds beside the others; bring the nodes nearer together")]
    TooFar,
    /// Images larger than a GPU takes.
    #[error(transparent)]
    Texels(#[from] TooManyTexels),
}
