//! From the faces of an OBJ file to triangles whose vertices have one normal and one texture coordinate each.

use super::fault::Fault;
use super::statements::{Corner, Face, NONE, Statements};
use crate::asset::Asset;
use crate::mesh::Mesh;
use crate::polygon::{Cutter, MOST_CORNERS, TooLarge};
use crate::shift::settle;
use glam::{DVec3, Vec2, Vec3};
use std::collections::HashMap;

/// The triangles of a file, with the index of its material's name for each, or [`NONE`], as its material. No materials yet.
pub(super) fn assemble(statements: &Statements) -> Result<Asset, Fault> {
    let cut = cut(statements)?;
    let positions_of: Vec<[u32; 3]> = cut
        .triangles
        .iter()
        .map(|corners| corners.map(|corner| statements.corners[corner as usize].position))
        .collect();
    let (positions, shift) = settle(&statements.positions, &positions_of).map_err(|index| Fault::TooFar(index + 1))?;
    let smooth = Smooth::new(statements, &cut, &positions);
    let mut mesh = if is_plain(statements) {
        Mesh {
            positions,
            triangles: positions_of,
            normals: smooth.normals,
            colors: statements.colors.clone(),
            ..Mesh::default()
        }
    } else {
        split(statements, &cut, &positions, &smooth)?
    };
    mesh.shift = shift;
    Ok(Asset {
        mesh,
        material_ids: cut
            .faces
            .iter()
            .map(|face| statements.faces[*face as usize].material)
            .collect(),
        ..Asset::default()
    })
}

/// Whether each position is one vertex: nothing but places is said, and all is in the first smoothing group.
fn is_plain(statements: &Statements) -> bool {
    let is_bare = |corner: &Corner| corner.coordinate == NONE && corner.normal == NONE;
    statements.corners.iter().all(is_bare) && statements.faces.iter().all(|face| face.group == 1)
}

/// Triangles of corners.
struct Cut {
    /// Indices of corners.
    triangles: Vec<[u32; 3]>,
    /// The face of each.
    faces: Vec<u32>,
}

fn cut(statements: &Statements) -> Result<Cut, Fault> {
    let count: usize = statements.faces.iter().map(|face| face.corners - 2).sum();
    if count >= NONE as usize {
        return Err(Fault::TooMany("triangles"));
    }
    let mut cut = Cut {
        triangles: vec![[0; 3]; count],
        faces: Vec::with_capacity(count),
    };
    let position =
        |corner: u32| -> DVec3 { statements.positions[statements.corners[corner as usize].position as usize] };
    let mut cutter = Cutter::default();
    let mut ring = Vec::new();
    let mut rest = cut.triangles.as_mut_slice();
    for (id, face) in (0..).zip(&statements.faces) {
        let (triangles, others) = rest.split_at_mut(face.corners - 2);
        rest = others;
        ring.clear();
        ring.extend((face.first as u32..).take(face.corners));
        cutter
            .cut(&ring, position, triangles)
            .map_err(|TooLarge| Fault::PolygonTooLarge {
                line: face.line,
                corners: face.corners,
                limit: MOST_CORNERS,
            })?;
        cut.faces.resize(cut.faces.len() + face.corners - 2, id);
    }
    Ok(cut)
}

/// Normals of corners for which the file has none.
struct Smooth {
    /// The vertex of each position in each smoothing group but the first, whose vertices are the positions.
    vertices: HashMap<(u32, u32), u32>,
    normals: Vec<Vec3>,
}

impl Smooth {
    fn new(statements: &Statements, cut: &Cut, positions: &[Vec3]) -> Self {
        let mut vertices = HashMap::new();
        let mut mesh = Mesh {
            positions: positions.to_vec(),
            ..Mesh::default()
        };
        for (triangle, face) in cut.triangles.iter().zip(&cut.faces) {
            let group = statements.faces[*face as usize].group;
            if group == 0 {
                continue;
            }
            let corners = triangle.map(|corner| {
                let position = statements.corners[corner as usize].position;
                if group == 1 {
                    return position;
                }
                *vertices.entry((position, group)).or_insert_with(|| {
                    mesh.positions.push(positions[position as usize]);
                    mesh.positions.len() as u32 - 1
                })
            });
            mesh.triangles.push(corners);
        }
        Smooth {
            vertices,
            normals: mesh.with_normals().normals,
        }
    }

    /// What tells the normal of a corner of a face from those of others at its position.
    fn key(&self, corner: &Corner, face: &Face) -> Normal {
        match (corner.normal, face.group) {
            (NONE, 0) => Normal::Flat,
            (NONE, 1) => Normal::Computed(corner.position),
            (NONE, group) => self
                .vertices
                .get(&(corner.position, group))
                .map_or(Normal::Flat, |vertex| Normal::Computed(*vertex)),
            (normal, _) => Normal::Given(normal),
        }
    }
}

/// Where a corner's normal comes from.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Normal {
    Flat,
    Computed(u32),
    Given(u32),
}

/// A mesh with a vertex for each position, texture coordinate and normal that occur together.
fn split(statements: &Statements, cut: &Cut, positions: &[Vec3], smooth: &Smooth) -> Result<Mesh, Fault> {
    let has_coordinates = statements.corners.iter().any(|corner| corner.coordinate != NONE);
    let mut mesh = Mesh::default();
    let mut known: HashMap<(u32, u32, Normal), u32> = HashMap::new();
    for (triangle, face) in cut.triangles.iter().zip(&cut.faces) {
        let face = &statements.faces[*face as usize];
        let mut vertices = [0; 3];
        for (vertex, corner) in vertices.iter_mut().zip(triangle) {
            let corner = &statements.corners[*corner as usize];
            let normal = smooth.key(corner, face);
            let next = u32::try_from(mesh.positions.len()).map_err(|_| Fault::TooMany("vertices"))?;
            let key = (corner.position, corner.coordinate, normal);
            *vertex = *known.entry(key).or_insert(next);
            if *vertex != next {
                continue;
            }
            let position = corner.position as usize;
            mesh.positions.push(positions[position]);
            mesh.normals.push(match normal {
                Normal::Flat => Vec3::ZERO,
                Normal::Computed(vertex) => smooth.normals[vertex as usize],
                Normal::Given(normal) => statements.normals[normal as usize],
            });
            if !statements.colors.is_empty() {
                mesh.colors.push(statements.colors[position]);
            }
            if has_coordinates {
                mesh.coordinates.push(match corner.coordinate {
                    NONE => Vec2::ZERO,
                    coordinate => statements.coordinates[coordinate as usize],
                });
            }
        }
        mesh.triangles.push(vertices);
    }
    Ok(mesh)
}
