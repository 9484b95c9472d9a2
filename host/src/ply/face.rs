//! Faces and triangle strips.

use ply_rs::ply::{Property, PropertyAccess};

use super::color::{OPAQUE, channel};
use super::data::Chunk;
use super::fault::Fault;
use super::polygon::Polygon;
use super::reader::{Item, Reader, Record};
use super::role::Role;

/// How the corners of an element make triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// One polygon each.
    Face,
    /// One or more strips each, which -1 separates.
    Strip,
}

/// One face or strip as it stands in the file.
struct Face {
    corners: Property,
    color: [u8; 4],
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self {
            corners: Property::ListInt(Vec::new()),
            color: OPAQUE,
        }
    }

    fn set_property(&mut self, key: String, property: Property) {
        match Role::of_key(&key) {
            Some(Role::Corners) => self.corners = property,
            Some(Role::Red) => self.color[0] = channel(&property),
            Some(Role::Green) => self.color[1] = channel(&property),
            Some(Role::Blue) => self.color[2] = channel(&property),
            Some(Role::Alpha) => self.color[3] = channel(&property),
            _ => {}
        }
    }
}

impl Record for Face {
    fn append(&mut self, rest: Self) {
        // Only ascii lists come in parts, and those are read as doubles.
        if let (Property::ListDouble(corners), Property::ListDouble(rest)) = (&mut self.corners, rest.corners) {
            corners.extend(rest);
        }
    }
}

/// The triangles of a file, or of a chunk of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Faces {
    /// In file order; those of [`Self::polygons`] are points until these are cut.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Empty, or one for each triangle.
    pub(super) colors: Vec<[u8; 4]>,
    /// Faces of more than three corners, in file order.
    pub(super) polygons: Vec<Polygon>,
    /// The corners of all [`Self::polygons`], one after the other.
    pub(super) polygon_corners: Vec<u32>,
    /// How many faces and strips have fewer than three corners.
    pub(super) skipped: usize,
    /// How many lines had more words than declared.
    pub(super) surplus: usize,
}

impl Faces {
    /// Reads one chunk of a mesh with so many vertices.
    pub(super) fn read(reader: &Reader<'_>, chunk: &Chunk<'_>, kind: Kind, vertices: usize) -> Result<Self, Fault> {
        let mut faces = Self {
            triangles: Vec::with_capacity(chunk.count),
            ..Self::default()
        };
        let has_colors = reader.element().has(Role::Red);
        let surplus = reader.read(chunk, |item: Item<Face>| {
            match &item.record.corners {
                Property::ListChar(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListUChar(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListShort(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListUShort(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListInt(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListUInt(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListFloat(corners) => faces.add(kind, corners, vertices, item.index),
                Property::ListDouble(corners) => faces.add(kind, corners, vertices, item.index),
                _ => unreachable!("the role of corners is only given to lists"),
            }
            .map_err(|bad| bad.fault(reader, &item, vertices))?;
            if has_colors {
                faces.colors.resize(faces.triangles.len(), item.record.color);
            }
            Ok(())
        })?;
        faces.surplus = surplus;
        Ok(faces)
    }

    fn add<I: Index>(&mut self, kind: Kind, corners: &[I], vertices: usize, index: usize) -> Result<(), BadCorner> {
        match kind {
            Kind::Face => self.add_polygon(corners, vertices, index),
            Kind::Strip => self.add_strips(corners, vertices),
        }
    }

    fn add_polygon<I: Index>(&mut self, corners: &[I], vertices: usize, index: usize) -> Result<(), BadCorner> {
        if let [a, b, c] = *corners {
            self.triangles.push([
                vertex(a, 0, vertices)?,
                vertex(b, 1, vertices)?,
                vertex(c, 2, vertices)?,
            ]);
            return Ok(());
        }
        let start = self.polygon_corners.len();
        for (corner, &index) in corners.iter().enumerate() {
            self.polygon_corners.push(vertex(index, corner, vertices)?);
        }
        if corners.len() < 3 {
            self.polygon_corners.truncate(start);
            self.skipped += 1;
            return Ok(());
        }
        self.polygons.push(Polygon {
            first_triangle: self.triangles.len(),
            corners: corners.len(),
            face: index,
        });
        let uncut = [self.polygon_corners[start]; 3];
        self.triangles.resize(self.triangles.len() + corners.len() - 2, uncut);
        Ok(())
    }

    fn add_strips<I: Index>(&mut self, corners: &[I], vertices: usize) -> Result<(), BadCorner> {
        let before = self.triangles.len();
        // The last two corners, and whether the next triangle is an odd one of its strip, which winds the other way.
        let (mut last, mut length) = ([0; 2], 0_usize);
        for (corner, &index) in corners.iter().enumerate() {
            if matches!(index.whole(), Some(-1 | RESTART)) {
                length = 0;
                continue;
            }
            let next = vertex(index, corner, vertices)?;
            if length >= 2 {
                self.triangles.push(if length.is_multiple_of(2) {
                    [last[0], last[1], next]
                } else {
                    [last[1], last[0], next]
                });
            }
            last = [last[1], next];
            length += 1;
        }
        self.skipped += usize::from(self.triangles.len() == before);
        Ok(())
    }
}

/// What -1 is as an unsigned 32-bit integer; no vertex has this index.
const RESTART: i64 = u32::MAX as i64;

/// A type that corners are stored in.
trait Index: Copy {
    /// The value, where it is a whole number and no other one rounds to it in this type.
    fn whole(self) -> Option<i64>;

    /// The value, for an error.
    fn value(self) -> f64;
}

macro_rules! index_of_integer {
    ($($integer:ty),*) => {$(
        impl Index for $integer {
            fn whole(self) -> Option<i64> {
                Some(i64::from(self))
            }

            fn value(self) -> f64 {
                f64::from(self)
            }
        }
    )*};
}

index_of_integer!(i8, u8, i16, u16, i32, u32);

impl Index for f32 {
    fn whole(self) -> Option<i64> {
        (self.fract() == 0.0 && self.abs() < 16_777_216.0).then_some(self as i64)
    }

    fn value(self) -> f64 {
        f64::from(self)
    }
}

impl Index for f64 {
    fn whole(self) -> Option<i64> {
        (self.fract() == 0.0 && self.abs() < 9_007_199_254_740_992.0).then_some(self as i64)
    }

    fn value(self) -> f64 {
        self
    }
}

/// A corner that names no vertex.
struct BadCorner {
    corner: usize,
    /// `Err` where the value is no whole number.
    index: Result<i64, f64>,
}

impl BadCorner {
    fn fault(&self, reader: &Reader<'_>, item: &Item<Face>, vertices: usize) -> Fault {
        let (place, corner) = (reader.place(item), self.corner);
        match self.index {
            Ok(index) => Fault::IndexOutOfRange {
                place,
                corner,
                index,
                vertices,
            },
            Err(value) => Fault::IndexNotWhole { place, corner, value },
        }
    }
}

#[inline]
fn vertex<I: Index>(index: I, corner: usize, vertices: usize) -> Result<u32, BadCorner> {
    let bad = |index| BadCorner { corner, index };
    let whole = index.whole().ok_or_else(|| bad(Err(index.value())))?;
    u32::try_from(whole)
        .ok()
        .filter(|&vertex| (vertex as usize) < vertices)
        .ok_or_else(|| bad(Ok(whole)))
}
