//! Which format a mesh file has.

use crate::array_file::ArrayFile;
use std::path::Path;

/// What reads a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// [`crate::ply`]; also of files of no known format, since it says best what they are not.
    Ply,
    /// [`crate::binary_mesh`].
    Binary,
    /// [`crate::stl`].
    Stl,
    /// [`crate::obj`].
    Obj,
    /// [`crate::gltf`].
    Gltf,
}

impl MeshFormat {
    /// The format of a file: by its first bytes, where a format has some of its own, else by how its name ends.
    pub fn of(path: &Path) -> Self {
        Self::of_content(path)
            .or_else(|| Self::of_name(path))
            .unwrap_or(MeshFormat::Ply)
    }

    fn of_content(path: &Path) -> Option<Self> {
        // A pipe can be read only once.
        if !path.is_file() {
            return None;
        }
        let magic = ArrayFile::open(path).and_then(|mut file| file.head(4)).ok()?;
        match magic.as_slice() {
            b"PTRI" | b"MSH1" => Some(MeshFormat::Binary),
            b"glTF" => Some(MeshFormat::Gltf),
            [b'p', b'l', b'y', end] if end.is_ascii_whitespace() => Some(MeshFormat::Ply),
            _ => None,
        }
    }

    fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "stl" => Some(MeshFormat::Stl),
            "obj" => Some(MeshFormat::Obj),
            "gltf" | "glb" => Some(MeshFormat::Gltf),
            _ => None,
        }
    }
}
