//! Loading meshes from STL files (3D Systems, "StereoLithography Interface Specification", 1989), binary and text.
//!
//! Triangles come in file order. Corners at the same place become one vertex, which has no normal: the format says that its
//! facets are flat. Their normals in the file are skipped, since they follow from the corners; so are the two bytes behind
//! each binary facet, in which programs keep colours in ways of their own. A file is binary if its length is what its count
//! of facets asks for, whatever its first word, else text if it begins with `solid`.
//!
//! Own code, where stl_io 0.11 is at hand: that reads text into f32 at once, so that a facet far from the origin loses its
//! form, and does not say in which line an error is.

mod binary;
mod fault;
mod text;
mod welder;

pub use fault::{Fault, StlError};

use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::shift::settle;
use crate::whole_file;
use glam::Vec3;
use std::path::Path;
use welder::Welder;

/// Loads a file; `progress` hears of the stage "reading".
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn read(path: &Path, progress: Progress<'_>) -> Result<Mesh, StlError> {
    let name = path.display().to_string();
    match whole_file::read(path, u64::MAX) {
        Ok(bytes) => parse(&bytes, &name, progress),
        Err(fault) => Err(StlError {
            file: name,
            fault: fault.into(),
        }),
    }
}

/// Loads a file that is in memory; `name` is what errors call it. All normals are zero, which is how flat triangles are said.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn parse(bytes: &[u8], name: &str, progress: Progress<'_>) -> Result<Mesh, StlError> {
    parse_file(bytes, name, progress).map_err(|fault| StlError {
        file: name.to_owned(),
        fault,
    })
}

fn parse_file(bytes: &[u8], name: &str, progress: Progress<'_>) -> Result<Mesh, Fault> {
    let mut welder = Welder::default();
    let report = |fraction| progress("reading", fraction);
    if binary::is_exact(bytes) || !text::begins(bytes) {
        binary::read(bytes, name, &mut welder, report)?;
    } else {
        text::read(bytes, &mut welder, report)?;
    }
    if welder.triangles.is_empty() {
        return Err(Fault::NoTriangles);
    }
    let (positions, shift) = settle(&welder.positions, &welder.triangles).map_err(|_| Fault::TooFar)?;
    Ok(Mesh {
        normals: vec![Vec3::ZERO; positions.len()],
        positions,
        triangles: welder.triangles,
        shift,
        ..Mesh::default()
    })
}
