//! What can be wrong with a PLY file, each said in one sentence.

use std::fmt;
use std::io;

use thiserror::Error;

/// A file that could not be loaded: its name and what is wrong with it, printed as one sentence.
#[derive(Debug, Error)]
#[error("{file}: {fault}")]
pub struct PlyError {
    /// What the caller called the file.
    pub file: String,
    /// What is wrong with it and what to do.
    pub fault: Fault,
}

/// Where in the file's data a fault is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line, counted from 1.
    Line(usize),
    /// An element of a binary file, or of any file once it has been read.
    Element {
        /// Name of the element in the header, such as `face`.
        element: String,
        /// Which one of them, counted from 0.
        index: usize,
        /// Where it starts in a binary file, in bytes from the file's start.
        byte: Option<usize>,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Element { element, index, byte } => {
                write!(f, "element {element} {index}")?;
                match byte {
                    Some(byte) => write!(f, " (counted from 0, at byte {byte})"),
                    None => write!(f, " (counted from 0)"),
                }
            }
        }
    }
}

/// What is wrong with a PLY file.
///
/// Texts quoted from the file are shortened and have control characters escaped.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Fault {
    /// The path leads nowhere.
    #[error("there is no such file; check the path")]
    Missing,
    /// The path is a directory.
    #[error(
        "this is a directory; give the path of a file in it, a mesh (PLY, OBJ, STL or glTF) or a scene file (.toml)"
    )]
    Directory,
    /// The operating system refuses to read.
    #[error("the file cannot be read ({reason}); check its permissions and the disk")]
    Unreadable {
        /// The operating system's words.
        reason: io::Error,
    },
    /// Zero bytes, or nothing but a byte order mark.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// A gzip archive.
    #[error("the file is compressed with gzip; unpack it with gunzip first")]
    Gzip,
    /// Text in UTF-16.
    #[error("the file is text in UTF-16; save it as ASCII or UTF-8")]
    Utf16,
    /// The first line is not `ply`.
    #[error(
        "this is not a PLY file, for its first line is not \"ply\"; give a mesh as PLY, OBJ, STL or glTF, with a name that \
         ends as its format says (.ply, .obj, .stl, .glb, .gltf); a scene file's ends in .toml"
    )]
    NotPly,

    /// A header without end.
    #[error("the header has no end_header line, so the file is cut short; export or copy it again")]
    NoEndHeader,
    /// A header without a format.
    #[error("the header has no format line; add \"format ascii 1.0\" or the binary format it has")]
    NoFormat,
    /// A format line that names no known format.
    #[error(
        "line {line}: \"{text}\" names no known format; PLY has ascii, binary_little_endian and \
         binary_big_endian, followed by 1.0"
    )]
    UnknownFormat {
        /// Line, from 1.
        line: usize,
        /// The line.
        text: String,
    },
    /// A version other than 1.0.
    #[error("line {line}: PLY version {version} is not supported; export the mesh as PLY 1.0")]
    UnsupportedVersion {
        /// Line, from 1.
        line: usize,
        /// The version.
        version: String,
    },
    /// A second format line that says something else.
    #[error("line {line}: the format contradicts an earlier format line; delete the wrong one")]
    ContradictingFormat {
        /// Line, from 1.
        line: usize,
    },
    /// A line that does not belong in a header.
    #[error(
        "line {line}: \"{text}\" is no valid line of a PLY header; correct it, or put \"comment \" \
         in front of it"
    )]
    UnknownLine {
        /// Line, from 1.
        line: usize,
        /// The line.
        text: String,
    },
    /// A property that belongs to no element.
    #[error("line {line}: a property stands before the first element; move it below its element")]
    PropertyWithoutElement {
        /// Line, from 1.
        line: usize,
    },
    /// A type that PLY does not have.
    #[error(
        "line {line}: \"{text}\" is no type of a PLY {what}; PLY has char, uchar, short, ushort, \
         int, uint{more}"
    )]
    UnknownType {
        /// Line, from 1.
        line: usize,
        /// The type.
        text: String,
        /// "property" or "list length".
        what: &'static str,
        /// What is allowed besides integers.
        more: &'static str,
    },
    /// An element's count that is no number or cannot be true.
    #[error("line {line}: \"{text}\" cannot be the number of \"{element}\" elements; correct the count")]
    Count {
        /// Line, from 1.
        line: usize,
        /// Name of the element.
        element: String,
        /// The count.
        text: String,
    },
    /// An element declared twice that may be declared only once.
    #[error("line {line}: element \"{element}\" is declared twice; merge the two into one")]
    DuplicateElement {
        /// Line, from 1.
        line: usize,
        /// Name of the element.
        element: String,
    },
    /// A property declared twice that may be declared only once.
    #[error("element \"{element}\" declares property \"{property}\" twice; rename or remove one of them")]
    DuplicateProperty {
        /// Name of the element.
        element: String,
        /// Name of the property.
        property: String,
    },

    /// No element `vertex`.
    #[error("the file declares no element \"vertex\" (it has {found}); export the mesh again")]
    NoVertices {
        /// What it declares instead.
        found: String,
    },
    /// Neither faces nor triangle strips: a cloud of points.
    #[error(
        "the file declares no faces or triangle strips (it has {found}), so there is nothing to \
         trace; export the mesh with its faces"
    )]
    NoFaces {
        /// What it declares instead.
        found: String,
    },
    /// Faces, but none with three corners.
    #[error(
        "none of the {faces} faces and strips has three corners, so there is nothing to trace; \
         export the mesh with its faces"
    )]
    NoTriangles {
        /// How many faces and strips there are.
        faces: usize,
    },
    /// A vertex without x, y or z.
    #[error("element \"vertex\" has no number property \"{property}\"; a vertex needs x, y and z")]
    NoCoordinate {
        /// Name of the missing property.
        property: &'static str,
    },
    /// A face without corners.
    #[error(
        "element \"{element}\" has no list property \"vertex_indices\" or \"vertex_index\"; \
         rename the list that holds the corners"
    )]
    NoIndices {
        /// Name of the element.
        element: String,
    },
    /// More vertices or triangles than 32-bit ids can name.
    #[error("the mesh has {count} {what}, but at most 4294967295 are supported; split the mesh")]
    TooMany {
        /// How many.
        count: usize,
        /// "vertices" or "triangles".
        what: &'static str,
    },

    /// A binary file that ends too early.
    #[error(
        "{place}: the data ends here, though the header declares {count} of them; the file is cut \
         short or its header wrong, so export or copy it again"
    )]
    CutShort {
        /// The first element that is not complete.
        place: Place,
        /// How many the header declares.
        count: usize,
    },
    /// An ascii file that ends too early.
    #[error(
        "line {line}: the file ends after {found} of the {count} \"{element}\" elements that its \
         header declares; it is cut short or its header wrong, so export or copy it again"
    )]
    TooFewLines {
        /// Last line, from 1.
        line: usize,
        /// Name of the element.
        element: String,
        /// How many are there.
        found: usize,
        /// How many the header declares.
        count: usize,
    },
    /// A line with too few values.
    #[error(
        "line {line}: the line ends before property \"{property}\" of element \"{element}\" is \
         complete; add the missing values, or export the mesh again if the file is cut short"
    )]
    ShortLine {
        /// Line, from 1.
        line: usize,
        /// Name of the element.
        element: String,
        /// Name of the property.
        property: String,
    },
    /// A list whose length is negative or larger than the file.
    #[error(
        "{place}: list \"{property}\" claims {length} entries, but {left} bytes of data are left; \
         the file is damaged or cut short, so export or copy it again"
    )]
    ListLength {
        /// The list's element.
        place: Place,
        /// Name of the property.
        property: String,
        /// The length that the file gives.
        length: i64,
        /// Bytes after the length (of the line, in an ascii file).
        left: usize,
    },
    /// Something that is no number.
    #[error(
        "line {line}: \"{text}\" is not a number that property \"{property}\" ({kind}) can hold; \
         correct it"
    )]
    NotANumber {
        /// Line, from 1.
        line: usize,
        /// The word.
        text: String,
        /// Name of the property.
        property: String,
        /// Type of the property.
        kind: &'static str,
    },
    /// A coordinate that is NaN or infinite.
    #[error("{place}: coordinate {axis} is {value}; every coordinate must be a finite number")]
    NotFinite {
        /// The vertex.
        place: Place,
        /// "x", "y" or "z".
        axis: &'static str,
        /// The value.
        value: String,
    },
    /// A coordinate too large for f32.
    #[error(
        "{place}: coordinate {axis} lies outside the range of 32-bit floats (3.4e38); scale the \
         mesh down"
    )]
    OutOfRange {
        /// The vertex.
        place: Place,
        /// "x", "y" or "z".
        axis: &'static str,
    },
    /// A corner that names no vertex.
    #[error(
        "{place}: corner {corner} names vertex {index}, but {}; export the mesh again",
        vertices_exist(*.vertices)
    )]
    IndexOutOfRange {
        /// The face or strip.
        place: Place,
        /// Which of its corners, from 0.
        corner: usize,
        /// The index.
        index: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A corner that is no whole number.
    #[error(
        "{place}: corner {corner} is {value}, which is no exact whole number; store the indices as \
         integers"
    )]
    IndexNotWhole {
        /// The face or strip.
        place: Place,
        /// Which of its corners, from 0.
        corner: usize,
        /// The value.
        value: f64,
    },
    /// A concave polygon too large to be cut in acceptable time.
    #[error(
        "{place}: a concave polygon with {corners} corners is too large to be cut into triangles \
         here (at most {limit}); triangulate the mesh in the program that made it"
    )]
    PolygonTooLarge {
        /// The face.
        place: Place,
        /// How many corners it has.
        corners: usize,
        /// How many it may have.
        limit: usize,
    },
    /// The parser's own complaint, for what none of the checks before it has caught.
    #[error("{place}: the data cannot be parsed ({reason}); export the mesh again")]
    Parser {
        /// The element.
        place: Place,
        /// The first line of what ply-rs says.
        reason: String,
    },
}

fn vertices_exist(vertices: usize) -> String {
    match vertices {
        0 => "there are no vertices".to_owned(),
        1 => "there is only vertex 0".to_owned(),
        _ => format!("the vertices are 0 to {}", vertices - 1),
    }
}
