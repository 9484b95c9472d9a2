//! Parts of meshes: vertices and the triangles between them.

use super::accessor::{Wanted, indices, vectors};
use super::buffers::Buffers;
use super::document::{Document, Primitive};
use super::fault::{Fault, Place};
use super::notices::Notices;
use glam::Vec3;
use oktant_shared::color::srgb_from_linear;

/// The vertices of a primitive, in its mesh's coordinates, and its triangles.
pub(super) struct Part {
    /// All finite.
    pub(super) positions: Vec<Vec3>,
    /// Empty, or one for each position, of any length.
    pub(super) normals: Vec<Vec3>,
    /// Empty, or one for each position, sRGB-encoded.
    pub(super) colors: Vec<[u8; 4]>,
    /// Sets of texture coordinates, those that are there, by number; one for each position.
    pub(super) coordinates: [Vec<[f32; 2]>; SETS],
    /// All in range.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Sets of texture coordinates that are read.
pub(super) const SETS: usize = 4;

/// Reads a primitive at a place; none where it has no triangles.
pub(super) fn read(
    document: &Document,
    buffers: &Buffers<'_>,
    primitive: &Primitive,
    place: &Place,
    notices: &mut Notices,
) -> Result<Option<Part>, Fault> {
    let mode = primitive.mode.unwrap_or(TRIANGLES);
    if !(TRIANGLES..=FAN).contains(&mode) {
        notices.add("points and lines");
        return Ok(None);
    }
    if !primitive.targets.is_empty() {
        notices.add("morph targets");
    }
    let attribute = |name: &str| primitive.attributes.get(name).copied();
    let id = attribute("POSITION").ok_or_else(|| Fault::NoPositions(place.clone()))?;
    let vec3 = Wanted {
        kinds: &["VEC3"],
        words: "VEC3",
    };
    let positions: Vec<Vec3> = vectors::<3>(document, buffers, id, vec3, 0.0)?
        .into_iter()
        .map(Vec3::from_array)
        .collect();
    if let Some(vertex) = positions.iter().position(|position| !position.is_finite()) {
        return Err(Fault::NotFinite {
            place: place.clone(),
            vertex,
        });
    }
    let same_length = |name: &str, found: usize| {
        if found == positions.len() {
            Ok(())
        } else {
            Err(Fault::Length {
                place: place.field("attributes").field(name),
                found,
                wanted: positions.len(),
            })
        }
    };
    let mut normals = Vec::new();
    if let Some(id) = attribute("NORMAL") {
        normals = vectors::<3>(document, buffers, id, vec3, 0.0)?
            .into_iter()
            .map(Vec3::from_array)
            .collect();
        same_length("NORMAL", normals.len())?;
    }
    let mut colors = Vec::new();
    if let Some(id) = attribute("COLOR_0") {
        let wanted = Wanted {
            kinds: &["VEC3", "VEC4"],
            words: "VEC3 or VEC4",
        };
        colors = vectors::<4>(document, buffers, id, wanted, 1.0)?
            .into_iter()
            .map(encoded)
            .collect();
        same_length("COLOR_0", colors.len())?;
    }
    let mut coordinates: [Vec<[f32; 2]>; SETS] = Default::default();
    for (set, coordinates) in coordinates.iter_mut().enumerate() {
        let name = format!("TEXCOORD_{set}");
        if let Some(id) = attribute(&name) {
            let wanted = Wanted {
                kinds: &["VEC2"],
                words: "VEC2",
            };
            *coordinates = vectors::<2>(document, buffers, id, wanted, 0.0)?;
            same_length(&name, coordinates.len())?;
        }
    }
    let corners = match primitive.indices {
        Some(id) => indices(document, buffers, id)?,
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(corner) = corners.iter().find(|corner| **corner as usize >= positions.len()) {
        return Err(Fault::Corner {
            place: place.clone(),
            corner: *corner,
            vertices: positions.len(),
        });
    }
    Ok(Some(Part {
        positions,
        normals,
        colors,
        coordinates,
        triangles: triangles(&corners, mode),
    }))
}

const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;

fn triangles(corners: &[u32], mode: u32) -> Vec<[u32; 3]> {
    let windows = corners.array_windows::<3>();
    match mode {
        // Every other one runs the other way round.
        STRIP => windows
            .enumerate()
            .map(|(i, &[a, b, c])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] })
            .collect(),
        FAN => corners
            .get(1..)
            .unwrap_or_default()
            .array_windows::<2>()
            .map(|&[b, c]| [b, c, corners[0]])
            .collect(),
        _ => corners.as_chunks().0.to_vec(),
    }
}

/// A linear colour, sRGB-encoded.
fn encoded(color: [f32; 4]) -> [u8; 4] {
    let [red, green, blue, _] = color.map(|channel| {
        let channel = if channel > 0.0 { channel.min(1.0) } else { 0.0 };
        (srgb_from_linear(channel) * 255.0).round() as u8
    });
    [red, green, blue, 255]
}
