//! Loading meshes from PLY files (Turk 1994), ascii and binary of either byte order.
//!
//! Values are read by ply-rs, one element at a time (`reader`), after the header (`header`) and the length of every
//! list (`data`) have been checked against the size of the file. So time and memory are bounded by what is in the
//! file, not by what it claims.
//!
//! Used are `x`, `y`, `z`, `nx`, `ny`, `nz`, the colours (`red`, `green`, `blue` and `alpha`, also with `diffuse_`
//! before them or as initials) and the texture coordinates (the first complete pair of `s t`, `u v`,
//! `texture_u texture_v` and `texture_s texture_t`) of `vertex`, the list `vertex_indices` or `vertex_index` and the
//! colours of `face`, and the list of `tristrips`. All else is skipped, texture coordinates of faces (`texcoord`) too.

mod color;
mod data;
mod element;
mod face;
mod fault;
mod header;
mod layout;
mod lines;
mod number;
mod polygon;
mod reader;
mod role;
mod shift;
mod vertex;
mod words;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use ply_rs::ply::Encoding;
use rayon::prelude::*;

use crate::mesh::Mesh;
use crate::progress::Progress;

use data::{Chunk, Data};
use element::Element;
use face::{Faces, Kind};
pub use fault::{Fault, Place, PlyError};
use header::Header;
use reader::Reader;
use vertex::Vertices;

/// Loads a file; `progress` hears of the stage "reading".
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn read(path: &Path, progress: Progress<'_>) -> Result<Mesh, PlyError> {
    let name = path.display().to_string();
    match load(path) {
        Ok(file) => parse(&file, &name, progress),
        Err(fault) => Err(PlyError { file: name, fault }),
    }
}

/// Loads a file that is in memory; `name` is what errors call it.
///
/// Triangles are in file order, a polygon of n corners being n - 2 of them; those without area are kept. Faces with
/// fewer than three corners are left out, with a warning. If only some normals are valid, or if faces have colours but
/// vertices no normals, the missing normals are computed ([`Mesh::with_normals`]); without any, [`Mesh::normals`] stays
/// empty. A texture coordinate's NaN or infinity becomes zero.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn parse(bytes: &[u8], name: &str, progress: Progress<'_>) -> Result<Mesh, PlyError> {
    parse_file(bytes, name, progress).map_err(|fault| PlyError {
        file: name.to_owned(),
        fault,
    })
}

fn load(path: &Path) -> Result<Vec<u8>, Fault> {
    let unreadable = |reason: io::Error| match reason.kind() {
        io::ErrorKind::NotFound => Fault::Missing,
        io::ErrorKind::IsADirectory => Fault::Directory,
        _ => Fault::Unreadable { reason },
    };
    let mut file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(Fault::Directory);
    }
    // A device may have no end, and a film need not be read to its end to see that it is none.
    let mut bytes = Vec::new();
    let mut start = (&mut file).take(6);
    start.read_to_end(&mut bytes).map_err(unreadable)?;
    header::check_magic(&bytes)?;
    let size = usize::try_from(metadata.len()).unwrap_or(usize::MAX);
    bytes
        .try_reserve_exact(size.saturating_sub(bytes.len()))
        .map_err(|error| unreadable(error.into()))?;
    file.read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

fn parse_file(file: &[u8], name: &str, progress: Progress<'_>) -> Result<Mesh, Fault> {
    let mut header = Header::scan(file)?;
    let vertex = header.find("vertex")?.ok_or_else(|| Fault::NoVertices {
        found: header.summary(),
    })?;
    let shapes = find_shapes(&mut header)?;
    role::assign_to_vertex(&mut header.elements[vertex])?;

    let mut data = Data::new(file, &header);
    let chunks = header
        .elements
        .iter()
        .map(|element| data.take(element))
        .collect::<Result<Vec<_>, Fault>>()?;
    if data.surplus() > 0 {
        let bytes = data.surplus();
        tracing::warn!("{name}: {bytes} bytes after the last element are ignored");
    }
    let stage = Stage {
        progress,
        done: AtomicUsize::new(0),
        chunks: chunks[vertex].len() + shapes.iter().map(|&(i, _)| chunks[i].len()).sum::<usize>(),
    };

    let element = &header.elements[vertex];
    let mut vertices = stage.read_vertices(&header, element, &chunks[vertex], false)?;
    let mut faces = Vec::new();
    for &(shape, kind) in &shapes {
        let reader = Reader::new(&header, &header.elements[shape], false);
        let count = vertices.positions.len();
        faces.extend(stage.read(&chunks[shape], |chunk| Faces::read(&reader, chunk, kind, count))?);
    }
    warn_of_losses(name, &faces, vertices.surplus);
    let count = count_triangles(&faces)?;

    let mut shift = shift::shift(&vertices.positions, &faces);
    let is_text = header.encoding == Encoding::Ascii;
    if shift != DVec3::ZERO && is_text && element.is_single(header.encoding) {
        // The text may have more digits than the f32 that were made of it.
        vertices = stage.read_vertices(&header, element, &chunks[vertex], true)?;
        shift = shift::shift(&vertices.positions, &faces);
    }
    faces
        .par_iter_mut()
        .map(|faces| polygon::cut(faces, &vertices.positions))
        .collect::<Vec<_>>()
        .into_iter()
        .collect::<Result<(), Fault>>()?;
    assemble(vertices, faces, count, shift)
}

/// The elements that make triangles, in file order, with their roles assigned.
fn find_shapes(header: &mut Header) -> Result<Vec<(usize, Kind)>, Fault> {
    let mut shapes = Vec::new();
    for (name, kind) in [("face", Kind::Face), ("tristrips", Kind::Strip)] {
        if let Some(shape) = header.find(name)?
            && header.elements[shape].count > 0
        {
            role::assign_to_face(&mut header.elements[shape])?;
            shapes.push((shape, kind));
        }
    }
    if shapes.is_empty() {
        return Err(Fault::NoFaces {
            found: header.summary(),
        });
    }
    shapes.sort_by_key(|&(shape, _)| shape);
    Ok(shapes)
}

/// How far the reading of a file is.
struct Stage<'a> {
    progress: Progress<'a>,
    done: AtomicUsize,
    chunks: usize,
}

impl Stage<'_> {
    /// Reads all chunks in parallel; of several faults, the first in the file counts.
    fn read<T: Send>(
        &self,
        chunks: &[Chunk<'_>],
        read: impl Fn(&Chunk<'_>) -> Result<T, Fault> + Sync,
    ) -> Result<Vec<T>, Fault> {
        let parts: Vec<Result<T, Fault>> = chunks
            .par_iter()
            .map(|chunk| {
                let part = read(chunk);
                let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
                (self.progress)("reading", (done as f32 / self.chunks as f32).min(1.0));
                part
            })
            .collect();
        parts.into_iter().collect()
    }

    fn read_vertices(
        &self,
        header: &Header,
        element: &Element,
        chunks: &[Chunk<'_>],
        exact: bool,
    ) -> Result<Vertices, Fault> {
        check_count(element.count, "vertices")?;
        let reader = Reader::new(header, element, exact);
        let single = element.is_single(header.encoding) && !exact;
        let parts = self.read(chunks, |chunk| Vertices::read(&reader, chunk, single))?;
        let mut vertices = Vertices::with_capacity(single, element.count);
        for part in parts {
            vertices.append(part);
        }
        Ok(vertices)
    }
}

fn check_count(count: usize, what: &'static str) -> Result<(), Fault> {
    match u32::try_from(count) {
        Ok(_) => Ok(()),
        Err(_) => Err(Fault::TooMany { count, what }),
    }
}

fn warn_of_losses(name: &str, faces: &[Faces], surplus: usize) {
    let skipped: usize = faces.iter().map(|faces| faces.skipped).sum();
    if skipped > 0 {
        tracing::warn!("{name}: {skipped} faces or strips with fewer than 3 corners are left out");
    }
    let surplus = surplus + faces.iter().map(|faces| faces.surplus).sum::<usize>();
    if surplus > 0 {
        tracing::warn!("{name}: {surplus} lines have more values than declared, which are ignored");
    }
}

fn count_triangles(faces: &[Faces]) -> Result<usize, Fault> {
    let count = faces.iter().map(|faces| faces.triangles.len()).sum();
    if count == 0 {
        return Err(Fault::NoTriangles {
            faces: faces.iter().map(|faces| faces.skipped).sum(),
        });
    }
    check_count(count, "triangles")?;
    Ok(count)
}

fn assemble(vertices: Vertices, faces: Vec<Faces>, count: usize, shift: DVec3) -> Result<Mesh, Fault> {
    let has_face_colors = faces.iter().any(|faces| !faces.colors.is_empty());
    let mut triangles = Vec::with_capacity(count);
    let mut colors = Vec::with_capacity(if has_face_colors { count } else { 0 });
    for faces in faces {
        if has_face_colors {
            colors.extend(faces.colors.iter().copied().map(Some));
            colors.resize(triangles.len() + faces.triangles.len(), None);
        }
        triangles.extend(faces.triangles);
    }
    let is_some_normal_missing = vertices.normals.contains(&Vec3::ZERO);
    let mut mesh = Mesh {
        positions: shift::apply(vertices.positions, shift)?,
        triangles,
        normals: vertices.normals,
        colors: vertices.colors,
        coordinates: vertices.coordinates,
        shift,
    };
    // Before vertices are split for their colours, which shall not make an edge.
    if is_some_normal_missing || has_face_colors {
        mesh = mesh.with_normals();
    }
    if has_face_colors {
        color::paint(&mut mesh, &colors)?;
    }
    Ok(mesh)
}
