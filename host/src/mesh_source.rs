//! Where a mesh comes from: a file, or the program itself.

use crate::asset::Asset;
use crate::balls::balls;
use crate::binary_mesh::{self, BinaryMeshError};
use crate::gltf::{self, GltfError};
use crate::mesh::Mesh;
use crate::mesh_format::MeshFormat;
use crate::obj::{self, ObjError};
use crate::ply::{self, PlyError};
use crate::progress::Progress;
use crate::shapes::stadium;
use crate::stl::{self, StlError};
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
    /// A file of a [`MeshFormat`].
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
    /// An STL file.
    #[error(transparent)]
    Stl(#[from] StlError),
    /// An OBJ file.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// A glTF file.
    #[error(transparent)]
    Gltf(#[from] GltfError),
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

    /// What it is called where its folder does not matter.
    pub fn name(&self) -> String {
        match self {
            MeshSource::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into(),
            built_in => built_in.to_string(),
        }
    }

    /// Loads the mesh alone, without what its file says of materials, lights and cameras; where it has no normals, they are
    /// computed from its faces.
    ///
    /// # Errors
    /// As [`MeshSource::load_asset`].
    pub fn load(&self, progress: Progress<'_>) -> Result<Mesh, MeshError> {
        Ok(self.load_asset(progress)?.mesh)
    }

    /// Loads the mesh, which has normals then, and all that comes with it.
    ///
    /// # Errors
    /// What the reader of the file's format returns.
    pub fn load_asset(&self, progress: Progress<'_>) -> Result<Asset, MeshError> {
        let path = match self {
            MeshSource::Bunny => return Ok(Asset::of_mesh(ply::parse(BUNNY, "the built-in bunny", progress)?)),
            MeshSource::Balls => return Ok(Asset::of_mesh(balls())),
            MeshSource::Stadium => return Ok(Asset::of_mesh(stadium())),
            MeshSource::File(path) => path,
        };
        let alone = |mesh, path: &PathBuf| Asset {
            files: vec![path.clone()],
            ..Asset::of_mesh(mesh)
        };
        Ok(match MeshFormat::of(path) {
            MeshFormat::Ply => alone(ply::read(path, progress)?, path),
            MeshFormat::Binary => alone(binary_mesh::read(path, progress)?, path),
            // Its normals are zero, as its triangles are flat.
            MeshFormat::Stl => Asset {
                mesh: stl::read(path, progress)?,
                files: vec![path.clone()],
                ..Asset::default()
            },
            MeshFormat::Obj => obj::read(path, progress)?,
            MeshFormat::Gltf => gltf::read(path, progress)?,
        })
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
