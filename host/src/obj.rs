//! Loading meshes from OBJ files (Wavefront, "The Advanced Visualizer: Object Files", 1992) with their MTL files.
//!
//! Read are `v` (also with a colour behind the place, sRGB-encoded, 0 to 1), `vt`, `vn`, `f`, `s`, `usemtl` and `mtllib`, with
//! indices from either end and lines that go on after a backslash; all else is skipped. Numbers are read as f64, and what
//! lies far away is brought near the origin before it is rounded to f32.
//!
//! A vertex without a normal gets one of the faces round it that are in its smoothing group, whatever their materials and
//! texture coordinates; in group 0 (`s off`) it has none, and the triangles are flat. Where the file never says `s`, all is
//! one group.
//!
//! Own code, where tobj 4.0 is at hand: that does not say in which line an error is, cuts polygons into fans, also where
//! they are concave, knows no smoothing groups, and gives each material vertices of its own, which shows as an edge where
//! normals are computed.

mod assembly;
mod fault;
mod lines;
mod material;
mod mtl;
mod statements;

pub use fault::{Fault, ObjError};

use crate::asset::Asset;
use crate::progress::Progress;
use crate::whole_file;
use std::path::{Path, PathBuf};

/// Loads a file and the files that it mentions; `progress` hears of the stage "reading". MTL files and images that cannot be
/// read are warned of, and done without.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn read(path: &Path, progress: Progress<'_>) -> Result<Asset, ObjError> {
    let name = path.display().to_string();
    let folder = path.parent().unwrap_or(Path::new(""));
    let asset = whole_file::read(path, u64::MAX)
        .map_err(Fault::from)
        .and_then(|bytes| parse_file(&bytes, &name, Some(folder), progress));
    match asset {
        Ok(mut asset) => {
            asset.files.insert(0, path.to_path_buf());
            Ok(asset)
        }
        Err(fault) => Err(ObjError { file: name, fault }),
    }
}

/// Loads a file that is in memory, and no other; `name` is what errors call it.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn parse(bytes: &[u8], name: &str, progress: Progress<'_>) -> Result<Asset, ObjError> {
    parse_file(bytes, name, None, progress).map_err(|fault| ObjError {
        file: name.to_owned(),
        fault,
    })
}

/// The files that an OBJ file and its MTL files mention, there or not.
pub(crate) fn mentions(bytes: &[u8], folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for library in statements::libraries(bytes) {
        for path in mtl::candidates(&library, folder) {
            if let Ok(bytes) = whole_file::read(&path, mtl::LARGEST) {
                let folder = path.parent().unwrap_or(Path::new(""));
                files.extend(mtl::images(&bytes).iter().map(|image| folder.join(image)));
            }
            files.push(path);
        }
    }
    files
}

fn parse_file(bytes: &[u8], name: &str, folder: Option<&Path>, progress: Progress<'_>) -> Result<Asset, Fault> {
    let statements = statements::read(bytes, &|fraction| progress("reading", fraction))?;
    if statements.skipped > 0 {
        tracing::warn!(
            "{name}: {} faces with fewer than 3 corners are left out",
            statements.skipped
        );
    }
    let mut asset = assembly::assemble(&statements)?;
    material::furnish(&mut asset, &statements, name, folder)?;
    asset.complete_coordinates();
    Ok(asset)
}
