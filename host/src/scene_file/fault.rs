//! What is wrong with a scene file, or another one in TOML, and where.

use super::place::{Place, Step};
use crate::mesh_source::MeshError;
use crate::nearest::nearest;
use crate::texels::{ImageFault, TooManyTexels};
use crate::toml_file::Subject;
use serde::de::{Error, Expected, Unexpected};
use std::borrow::Cow;
use std::fmt::{self, Display};

/// At most so many names that somebody gave are listed.
const MOST_NAMES: usize = 12;
/// Characters of a name that are shown.
const LONGEST_NAME: usize = 40;

/// Something wrong at a place of a file.
#[derive(Debug)]
pub struct Fault {
    /// Where.
    pub place: Place,
    /// What.
    pub reason: Reason,
}

/// What is wrong with the thing at a place. Each is said as a predicate, whose subject is the place.
#[derive(Debug, thiserror::Error)]
pub enum Reason {
    /// A value of another type, or out of range.
    #[error("is {found}; give {expected}")]
    Unexpected {
        /// The value as it stands in the file; filled in by whoever has the file.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// A field that there is not.
    #[error("has no field \"{}\"; {}", shortened(name), advice(name, valid, valid.len()))]
    UnknownField {
        /// As written.
        name: String,
        /// All that there are.
        valid: Vec<String>,
    },
    /// A name of nothing.
    #[error(
        "is \"{}\", but there is no such {what}; {}",
        shortened(name),
        advice(name, valid, MOST_NAMES)
    )]
    UnknownName {
        /// As written.
        name: String,
        /// Of what it should be the name.
        what: &'static str,
        /// All names that there are.
        valid: Vec<String>,
    },
    /// Nothing says what only a person can.
    #[error("lacks {0}; add it")]
    Lacks(&'static str),
    /// Two fields that say the same.
    #[error("does not go together with {0}; leave one of them out")]
    Excludes(&'static str),
    /// A field of something else.
    #[error("means nothing for {0}; leave it out")]
    Inapplicable(&'static str),
    /// More light leaves a surface than arrives.
    #[error(
        "reflects and transmits {part} of the light in {channel} (diffuse * base + mirror + transmission); \
         lower them to 1 in all"
    )]
    Energy {
        /// Above 1.
        part: f32,
        /// "red", "green" or "blue".
        channel: &'static str,
    },
    /// The camera looks at itself.
    #[error("is also what the camera looks at; move one of them")]
    NoDirection,
    /// A time that is not after the one before.
    #[error("is not later than the key before it; put the keys in the order of their times")]
    NotLater,
    /// A vector without length, or edges along each other.
    #[error("has no area; let its edges point in different directions")]
    NoArea,
    /// A box inside out.
    #[error("is not below high in every coordinate; exchange them")]
    NotBelow,
    /// An outline beyond its axis.
    #[error("has a radius below 0; give 0 and up")]
    NegativeRadius,
    /// An outline that stands still.
    #[error("has the same point twice in a row; leave one of them out")]
    SamePoint,
    /// A picture that does not fit into memory.
    #[error("makes a picture of more than {0} pixels; make it smaller")]
    TooManyPixels(u64),
    /// A picture that cannot be cut into halves.
    #[error("is {0}, but pictures side by side are equally wide; give an even number")]
    OddWidth(u32),
    /// Nothing to see.
    #[error("has nothing to see; add a [[mesh]], [[sphere]], [[box]] or another shape")]
    Empty,
    /// A texture on nothing to hold it by.
    #[error("has no texture coordinates, which the texture of material \"{0}\" needs; take another material")]
    NoCoordinates(String),
    /// Coordinates that lead to overflow.
    #[error("reaches further than 1e15 from the origin; bring it nearer or make it smaller")]
    TooLarge,
    /// A mesh that f32 cannot hold where it lies.
    #[error(
        "lies too far from the origin for single precision; bring it nearer with translate = {0}, and all that belongs \
         to it by as much"
    )]
    MeshTooFar(String),
    /// A shape that f32 cannot hold where it lies.
    #[error("lies too far from the origin for single precision; move it and all that belongs to it by {0}")]
    ShapeTooFar(String),
    /// More than ids can count.
    #[error("makes more than {0} triangles or vertices in all; leave something out")]
    TooMany(usize),
    /// A file beside a scene that lies nowhere.
    #[error("names a file, but a scene that is in memory has no files beside it; save it, and give its path")]
    NoFolder,
    /// A mesh that cannot be read.
    #[error("cannot be used: {0}")]
    Mesh(Box<MeshError>),
    /// An image that cannot be had.
    #[error("cannot be used: {0}")]
    Image(#[from] ImageFault),
    /// Images larger than a GPU takes.
    #[error("has too many pixels: all images together may have {0}; make it smaller")]
    TooManyTexels(usize),
    /// Anything that serde says.
    #[error("cannot be used: {0}")]
    Other(String),
}

/// What to do about a name that there is not; lists at most so many that there are.
fn advice(name: &str, valid: &[String], most: usize) -> String {
    let valid: Vec<_> = valid.iter().map(String::as_str).collect();
    if let Some(near) = nearest(name, &valid) {
        return format!("did you mean \"{}\"?", shortened(near));
    }
    let shown: Vec<_> = valid.iter().take(most).map(|name| shortened(name)).collect();
    match (shown.as_slice(), valid.len() - shown.len()) {
        ([], _) => "there are none".into(),
        ([only], _) => format!("there is only \"{only}\""),
        ([first @ .., last], 0) => format!("there are {} and {last}", first.join(", ")),
        (first, rest) => format!("there are {} and {rest} more", first.join(", ")),
    }
}

/// A name of which no more is shown than helps.
fn shortened(name: &str) -> Cow<'_, str> {
    match name.char_indices().nth(LONGEST_NAME) {
        Some((end, _)) => format!("{}...", &name[..end]).into(),
        None => name.into(),
    }
}

impl From<TooManyTexels> for Reason {
    fn from(TooManyTexels(most): TooManyTexels) -> Self {
        Reason::TooManyTexels(most)
    }
}

impl Fault {
    /// A fault at a place.
    pub fn new(place: &Place, reason: Reason) -> Self {
        Fault {
            place: place.clone(),
            reason,
        }
    }

    /// A value that is not what it should be.
    pub fn unexpected(expected: impl Display) -> Self {
        Fault {
            place: Place::ROOT,
            reason: Reason::Unexpected {
                found: String::new(),
                expected: expected.to_string(),
            },
        }
    }

    /// What is wrong in a file about a subject, and what to do.
    pub fn sentence(&self, subject: &Subject) -> String {
        let place = self.place.name(subject.whole);
        match &self.reason {
            // What is appended to a file becomes part of its last table.
            Reason::UnknownField { name, .. }
                if !self.place.steps().is_empty() && subject.top_fields.contains(&name.as_str()) =>
            {
                format!("{place} has no field \"{name}\"; it belongs at the top, before the first [table]")
            }
            reason => format!("{place} {reason}"),
        }
    }

    /// The same fault, seen from one step further up.
    pub fn inside(mut self, step: Step) -> Self {
        self.place.prepend(step);
        self
    }
}

/// Without what the file describes; [`Fault::sentence`] says more.
impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.reason.fmt(f)
    }
}

impl std::error::Error for Fault {}

impl Error for Fault {
    fn custom<T: Display>(message: T) -> Self {
        Fault::new(&Place::ROOT, Reason::Other(message.to_string()))
    }

    fn invalid_type(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Fault::unexpected(expected)
    }

    fn invalid_value(_: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Fault::unexpected(expected)
    }

    fn invalid_length(_: usize, expected: &dyn Expected) -> Self {
        Fault::unexpected(expected)
    }

    fn unknown_variant(variant: &str, expected: &'static [&'static str]) -> Self {
        let reason = Reason::UnknownName {
            name: variant.into(),
            what: "choice",
            valid: expected.iter().map(|name| (*name).into()).collect(),
        };
        Fault::new(&Place::ROOT, reason)
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        let reason = Reason::UnknownField {
            name: field.into(),
            valid: expected.iter().map(|name| (*name).into()).collect(),
        };
        Fault::new(&Place::ROOT, reason)
    }

    fn missing_field(field: &'static str) -> Self {
        Fault::new(&Place::ROOT, Reason::Lacks(field))
    }
}
