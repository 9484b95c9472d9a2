//! The mesh `stadium`: a very large room.

use crate::mesh::Mesh;
use glam::{Vec2, Vec3, vec2, vec3};

/// Steps of the stands, their depth and height, metres.
const STEPS: u32 = 60;
const DEPTH: f32 = 0.8;
const RISE: f32 = 0.4;
/// Half the length and width of the field, metres; the room is as much longer and wider as the stands are deep.
const FIELD: Vec2 = vec2(52.0, 34.0);
/// The ceiling, metres above the field.
const HEIGHT: f32 = 42.0;
/// Parts along each side; all that meets at an edge has the same ones, so that nothing leaks.
const PARTS: u32 = 48;

/// Colours, sRGB.
const GRASS: [[u8; 3]; 2] = [[92, 122, 74], [108, 138, 86]];
const SEATS: [[u8; 3]; 3] = [[176, 52, 48], [205, 198, 184], [52, 84, 140]];
const CONCRETE: [u8; 3] = [150, 148, 144];
const WALL: [u8; 3] = [196, 190, 178];
const CEILING: [u8; 3] = [120, 124, 132];

/// A room 200 m long and 164 m wide, about the origin, with y up and a field at y = 0 that stands of 60 steps surround:
/// 55,680 triangles with colours, a closed surface whose front is inside. One unit is a metre.
pub fn stadium() -> Mesh {
    let mut mesh = Mesh::default();
    // The field, its stripes across its length; and the ceiling, turned over.
    add_level(&mut mesh, 0.0, FIELD, Vec3::Y, |column| {
        GRASS[(column / 3 % 2) as usize]
    });
    let outer = half_size(STEPS);
    add_level(&mut mesh, HEIGHT, outer, Vec3::NEG_Y, |_| CEILING);
    for side in 0..4 {
        for part in 0..PARTS {
            for step in 0..STEPS {
                let (low, top) = (height(step), height(step + 1));
                let (inner, outer) = (half_size(step), half_size(step + 1));
                let ends = |size, at| [0, 1].map(|end| corner(side, part + end, size, at));
                add_quad(&mut mesh, ends(inner, low), ends(inner, top), seat(side, part, step));
                add_quad(&mut mesh, ends(inner, top), ends(outer, top), seat(side, part, step));
            }
            let ends = |at| [0, 1].map(|end| corner(side, part + end, outer, at));
            add_quad(&mut mesh, ends(height(STEPS)), ends(HEIGHT), WALL);
        }
    }
    mesh.with_normals()
}

/// Half the length and width of the rectangle where a step begins.
fn half_size(step: u32) -> Vec2 {
    FIELD + Vec2::splat(DEPTH * step as f32)
}

/// How far along a side a part begins, -1 to 1; from both ends alike, to the last bit.
fn along(part: u32) -> f32 {
    (2.0 * part as f32 - PARTS as f32) / PARTS as f32
}

/// The height of a step above the field, metres.
fn height(step: u32) -> f32 {
    RISE * step as f32
}

/// Where a part of a side begins: side 0 is at the back, the others follow clockwise seen from above.
fn corner(side: u32, part: u32, size: Vec2, height: f32) -> Vec3 {
    let along = along(part);
    let at = match side {
        0 => vec2(along, -1.0),
        1 => vec2(1.0, along),
        2 => vec2(-along, 1.0),
        _ => vec2(-1.0, -along),
    };
    vec3(at.x * size.x, height, at.y * size.y)
}

/// The colour of a step: aisles between blocks of seats.
fn seat(side: u32, part: u32, step: u32) -> [u8; 3] {
    if part.is_multiple_of(8) || step % 20 == 19 {
        CONCRETE
    } else {
        SEATS[((part / 8 + step / 20 + side) % 3) as usize]
    }
}

/// A level rectangle in parts.
fn add_level(mesh: &mut Mesh, height: f32, size: Vec2, normal: Vec3, color: impl Fn(u32) -> [u8; 3]) {
    for row in 0..PARTS {
        for column in 0..PARTS {
            let at = |column, row| vec3(along(column) * size.x, height, along(row) * size.y);
            let near = [at(column, row + 1), at(column + 1, row + 1)];
            let far = [at(column, row), at(column + 1, row)];
            if normal.y > 0.0 {
                add_quad(mesh, near, far, color(column));
            } else {
                add_quad(mesh, far, near, color(column));
            }
        }
    }
}

/// Two triangles between a lower and an upper edge, both from left to right as seen from the front.
fn add_quad(mesh: &mut Mesh, low: [Vec3; 2], high: [Vec3; 2], [red, green, blue]: [u8; 3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([low[0], low[1], high[1], high[0]]);
    mesh.colors.extend([[red, green, blue, 255]; 4]);
    mesh.triangles
        .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
}
