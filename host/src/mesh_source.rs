//! Where a mesh comes from: a file, or the program itself.

use crate::balls::balls;
use crate::binary_mesh::{self, BinaryMeshError};
use crate::mesh::Mesh;
use crate::ply::{self, PlyError};
use crate::progress::Progress;
use crate::shapes::stadium;
use std::fmt;
use std::path::{Path, PathBuf};

/// The Stanford bunny, see `assets/README.md`.
const BUNNY: &[u8] = include_bytes!("../../assets/bunny.ply");

/// A mesh that can be loaded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum MeshSource {
    /// The Stanford bunny, 69,451 triangles, part of the program.
    #[default]
    Bunny,
    /// Seven balls, 4,032 triangles, made by code.
    Balls,
    /// A room 200 m long with stands, 55,680 triangles, made by code.
    Stadium,
    /// A PLY file, or one that [`binary_mesh`] reads.
    File(PathBuf),
}

/// Why a mesh cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// A PLY file, or one of no known format.
    #[error(transparent)]
    Ply(#[from] PlyError),
    /// A file of plain binary arrays.
    #[error(transparent)]
    Binary(#[from] BinaryMeshError),
}

impl MeshSource {
    /// What a person means who names a mesh on the command line, or none.
    pub fn from_argument(argument: Option<&Path>) -> Self {
        match argument {
            None => MeshSource::Bunny,
            Some(path) if path == Path::new("bunny") => MeshSource::Bunny,
            Some(path) if path == Path::new("balls") => MeshSource::Balls,
            Some(path) if path == Path::new("stadium") => MeshSource::Stadium,
            Some(path) => MeshSource::File(path.to_path_buf()),
        }
    }

    /// Loads the mesh; where it has no normals, they are computed from its faces.
    ///
    /// # Errors
    /// What [`ply::read`] and [`binary_mesh::read`] return.
    pub fn load(&self, progress: Progress<'_>) -> Result<Mesh, MeshError> {
        let mesh = match self {
            MeshSource::Bunny => ply::parse(BUNNY, "the built-in bunny", progress)?,
            MeshSource::Balls => balls(),
            MeshSource::Stadium => stadium(),
            MeshSource::File(path) if binary_mesh::is_binary_mesh(path) => binary_mesh::read(path, progress)?,
            MeshSource::File(path) => ply::read(path, progress)?,
        };
        Ok(mesh.with_normals())
    }
}

impl fmt::Display for MeshSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MeshSource::Bunny => f.write_str("bunny"),
            MeshSource::Balls => f.write_str("balls"),
            MeshSource::Stadium => f.write_str("stadium"),
            MeshSource::File(path) => write!(f, "{}", path.display()),
        }
    }
}
