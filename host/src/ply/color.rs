//! Colours, and the vertices that faces of different colours share.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use ply_rs::ply::Property;

use crate::mesh::Mesh;

use super::check_count;
use super::fault::Fault;

/// White: what has no colour in a mesh that has colours, and the start of what has, so that alpha defaults to 255.
pub(super) const OPAQUE: [u8; 4] = [255; 4];

/// A channel of an sRGB-encoded colour.
///
/// 16-bit unsigned integers count from 0 to 65535, floats from 0 to 1, all others from 0 to 255.
pub(super) fn channel(property: &Property) -> u8 {
    match *property {
        Property::UChar(value) => value,
        Property::Char(value) => clamp(i64::from(value)),
        Property::Short(value) => clamp(i64::from(value)),
        Property::Int(value) => clamp(i64::from(value)),
        Property::UInt(value) => clamp(i64::from(value)),
        Property::UShort(value) => clamp((i64::from(value) + 128) / 257),
        Property::Float(value) => unorm(f64::from(value)),
        Property::Double(value) => unorm(value),
        // Roles of numbers are only given to numbers.
        _ => 0,
    }
}

fn clamp(value: i64) -> u8 {
    value.clamp(0, 255) as u8
}

fn unorm(value: f64) -> u8 {
    // The cast saturates and takes NaN for 0.
    (value * 255.0).round() as u8
}

/// Gives the corners of each triangle the triangle's colour, where it has one.
///
/// A vertex whose triangles have several colours is split into one for each, which keep its position, its normal and
/// its texture coordinate; the first keeps its index, the others come after all vertices of the file.
pub(super) fn paint(mesh: &mut Mesh, colors: &[Option<[u8; 4]>]) -> Result<(), Fault> {
    let own = if mesh.colors.is_empty() {
        vec![OPAQUE; mesh.positions.len()]
    } else {
        std::mem::take(&mut mesh.colors)
    };
    mesh.colors.clone_from(&own);
    let mut taken = vec![false; own.len()];
    let mut copies: HashMap<(u32, [u8; 4]), u32> = HashMap::new();
    for (triangle, color) in mesh.triangles.iter_mut().zip(colors) {
        for corner in triangle {
            let vertex = *corner as usize;
            let color = color.unwrap_or(own[vertex]);
            if !taken[vertex] {
                taken[vertex] = true;
                mesh.colors[vertex] = color;
            } else if mesh.colors[vertex] != color {
                *corner = match copies.entry((*corner, color)) {
                    Entry::Occupied(copy) => *copy.get(),
                    Entry::Vacant(entry) => {
                        let copy = mesh.positions.len();
                        check_count(copy + 1, "vertices")?;
                        mesh.positions.push(mesh.positions[vertex]);
                        if !mesh.normals.is_empty() {
                            mesh.normals.push(mesh.normals[vertex]);
                        }
                        if !mesh.coordinates.is_empty() {
                            mesh.coordinates.push(mesh.coordinates[vertex]);
                        }
                        mesh.colors.push(color);
                        *entry.insert(copy as u32)
                    }
                };
            }
        }
    }
    Ok(())
}
