//! Vertices: positions, normals, colours, texture coordinates.

use glam::{DVec2, DVec3, Vec2, Vec3};
use ply_rs::ply::{Property, PropertyAccess};

use super::color::{OPAQUE, channel};
use super::data::Chunk;
use super::fault::Fault;
use super::reader::{Item, Reader, Record};
use super::role::Role;

/// One vertex as it stands in the file.
struct Vertex {
    position: DVec3,
    normal: DVec3,
    color: [u8; 4],
    coordinate: DVec2,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self {
            position: DVec3::ZERO,
            normal: DVec3::ZERO,
            color: OPAQUE,
            coordinate: DVec2::ZERO,
        }
    }

    fn set_property(&mut self, key: String, property: Property) {
        match Role::of_key(&key) {
            Some(Role::X) => self.position.x = scalar(&property),
            Some(Role::Y) => self.position.y = scalar(&property),
            Some(Role::Z) => self.position.z = scalar(&property),
            Some(Role::NormalX) => self.normal.x = scalar(&property),
            Some(Role::NormalY) => self.normal.y = scalar(&property),
            Some(Role::NormalZ) => self.normal.z = scalar(&property),
            Some(Role::Red) => self.color[0] = channel(&property),
            Some(Role::Green) => self.color[1] = channel(&property),
            Some(Role::Blue) => self.color[2] = channel(&property),
            Some(Role::Alpha) => self.color[3] = channel(&property),
            Some(Role::TextureS) => self.coordinate.x = scalar(&property),
            Some(Role::TextureT) => self.coordinate.y = scalar(&property),
            Some(Role::Corners) | None => {}
        }
    }
}

impl Record for Vertex {
    fn append(&mut self, _rest: Self) {}
}

/// Positions in the precision of the file.
#[derive(Clone, Debug)]
pub(super) enum Positions {
    /// Exact.
    Single(Vec<Vec3>),
    /// Not yet rounded.
    Double(Vec<DVec3>),
}

impl Positions {
    fn with_capacity(single: bool, count: usize) -> Self {
        if single {
            Self::Single(Vec::with_capacity(count))
        } else {
            Self::Double(Vec::with_capacity(count))
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::Single(positions) => positions.len(),
            Self::Double(positions) => positions.len(),
        }
    }

    /// One of them, which must exist.
    pub(super) fn get(&self, index: u32) -> DVec3 {
        match self {
            Self::Single(positions) => positions[index as usize].as_dvec3(),
            Self::Double(positions) => positions[index as usize],
        }
    }

    fn push(&mut self, position: DVec3) {
        match self {
            // Exact, since it was an f32 in the file.
            Self::Single(positions) => positions.push(position.as_vec3()),
            Self::Double(positions) => positions.push(position),
        }
    }

    fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Single(positions), Self::Single(more)) => positions.extend(more),
            (Self::Double(positions), Self::Double(more)) => positions.extend(more),
            _ => unreachable!("all chunks of an element have its precision"),
        }
    }
}

/// The vertices of a file, or of a chunk of it.
#[derive(Clone, Debug)]
pub(super) struct Vertices {
    pub(super) positions: Positions,
    /// Empty, or one for each vertex: of unit length, or zero where the file's is zero or not finite.
    pub(super) normals: Vec<Vec3>,
    /// Empty, or one for each vertex.
    pub(super) colors: Vec<[u8; 4]>,
    /// Empty, or one for each vertex, with zero for each number that is not finite.
    pub(super) coordinates: Vec<Vec2>,
    /// How many lines had more words than declared.
    pub(super) surplus: usize,
}

impl Vertices {
    /// None, with room for `count`.
    pub(super) fn with_capacity(single: bool, count: usize) -> Self {
        Self {
            positions: Positions::with_capacity(single, count),
            normals: Vec::new(),
            colors: Vec::new(),
            coordinates: Vec::new(),
            surplus: 0,
        }
    }

    /// Appends those of the next chunk.
    pub(super) fn append(&mut self, more: Self) {
        self.positions.append(more.positions);
        self.normals.extend(more.normals);
        self.colors.extend(more.colors);
        self.coordinates.extend(more.coordinates);
        self.surplus += more.surplus;
    }

    /// Reads one chunk.
    pub(super) fn read(reader: &Reader<'_>, chunk: &Chunk<'_>, single: bool) -> Result<Self, Fault> {
        let has_normals = reader.element().has(Role::NormalX);
        let has_colors = reader.element().has(Role::Red);
        let has_coordinates = reader.element().has(Role::TextureS);
        let mut vertices = Self::with_capacity(single, chunk.count);
        if has_normals {
            vertices.normals.reserve_exact(chunk.count);
        }
        if has_colors {
            vertices.colors.reserve_exact(chunk.count);
        }
        if has_coordinates {
            vertices.coordinates.reserve_exact(chunk.count);
        }
        let surplus = reader.read(chunk, |item: Item<Vertex>| {
            check_position(reader, &item)?;
            let vertex = item.record;
            vertices.positions.push(vertex.position);
            if has_normals {
                vertices.normals.push(unit_or_zero(vertex.normal));
            }
            if has_colors {
                vertices.colors.push(vertex.color);
            }
            if has_coordinates {
                vertices.coordinates.push(finite_or_zero(vertex.coordinate));
            }
            Ok(())
        })?;
        vertices.surplus = surplus;
        Ok(vertices)
    }
}

fn check_position(reader: &Reader<'_>, item: &Item<Vertex>) -> Result<(), Fault> {
    let position = item.record.position;
    if position.as_vec3().is_finite() {
        return Ok(());
    }
    for (axis, value) in ["x", "y", "z"].into_iter().zip(position.to_array()) {
        // An ascii file's own infinities are refused before; this one comes from a number that is too large.
        let too_large = value.is_finite() || value.is_infinite() && reader.is_ascii();
        if too_large && !(value as f32).is_finite() {
            return Err(Fault::OutOfRange {
                place: reader.place(item),
                axis,
            });
        }
        if !value.is_finite() {
            return Err(Fault::NotFinite {
                place: reader.place(item),
                axis,
                value: value.to_string(),
            });
        }
    }
    Ok(())
}

fn unit_or_zero(normal: DVec3) -> Vec3 {
    let length = normal.length();
    if length > 0.0 && length.is_finite() {
        (normal / length).as_vec3()
    } else {
        Vec3::ZERO
    }
}

/// Each number for itself, as in an ascii file, where NaN and infinity are read as zero.
fn finite_or_zero(coordinate: DVec2) -> Vec2 {
    coordinate
        .as_vec2()
        .map(|number| if number.is_finite() { number } else { 0.0 })
}

fn scalar(property: &Property) -> f64 {
    match *property {
        Property::Char(value) => f64::from(value),
        Property::UChar(value) => f64::from(value),
        Property::Short(value) => f64::from(value),
        Property::UShort(value) => f64::from(value),
        Property::Int(value) => f64::from(value),
        Property::UInt(value) => f64::from(value),
        Property::Float(value) => f64::from(value),
        Property::Double(value) => value,
        // Roles of numbers are only given to numbers.
        _ => f64::NAN,
    }
}
