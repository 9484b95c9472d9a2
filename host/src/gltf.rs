//! Loading glTF 2.0 (Khronos Group, ISO/IEC 12113:2022): `.gltf` with its buffers and images, and `.glb`.
//!
//! The triangles of all nodes of the scene come in the order in which its tree is walked, moved to where they are in f64 and
//! brought near the origin together where that is far away. docs/files.md says what is read, and how materials become
//! those of Whitted's model.
//!
//! Own code, where the crate gltf 1.4 is at hand: its numbers are f32, so that a node far from the origin ends up beside
//! its place, and it panics on files that are broken, such as one whose POSITION has an index out of range.

mod accessor;
mod buffers;
mod container;
mod document;
mod fault;
mod images;
mod light;
mod material;
mod nodes;
mod notices;
mod primitive;
mod triangles;
mod uri;

pub use fault::{Fault, GltfError, Place};

use crate::asset::Asset;
use crate::progress::Progress;
use crate::whole_file;
use buffers::Buffers;
use container::Container;
use document::Document;
use images::Images;
use material::Palette;
use nodes::Walk;
use notices::Notices;
use std::path::{Path, PathBuf};
use triangles::Triangles;

/// Triangles and vertices that a small file may make by showing its meshes many times.
const LEAST_MOST: usize = 1 << 21;
/// Triangles and vertices that each byte of a larger file may make.
const MOST_PER_BYTE: usize = 16;

/// Loads a file and the buffers and images that it mentions; `progress` hears of the stage "reading". Images that cannot be
/// read, and what has no equal in Whitted's model, are warned of, and done without.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn read(path: &Path, progress: Progress<'_>) -> Result<Asset, GltfError> {
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
        Err(fault) => Err(GltfError { file: name, fault }),
    }
}

/// Loads a file that is in memory, and no other; `name` is what errors call it.
///
/// # Errors
/// Says in one sentence what is wrong with the file: see [`Fault`].
pub fn parse(bytes: &[u8], name: &str, progress: Progress<'_>) -> Result<Asset, GltfError> {
    parse_file(bytes, name, None, progress).map_err(|fault| GltfError {
        file: name.to_owned(),
        fault,
    })
}

/// The files that a file mentions, there or not.
pub(crate) fn mentions(bytes: &[u8], folder: &Path) -> Vec<PathBuf> {
    let document = Container::split(bytes).and_then(|container| Document::parse(container.json));
    let Ok(document) = document else {
        return Vec::new();
    };
    let buffers = document.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
    let images = document.images.iter().filter_map(|image| image.uri.as_deref());
    buffers.chain(images).filter_map(|uri| uri::path(uri, folder)).collect()
}

fn parse_file(bytes: &[u8], name: &str, folder: Option<&Path>, progress: Progress<'_>) -> Result<Asset, Fault> {
    let container = Container::split(bytes)?;
    let document = Document::parse(container.json)?;
    let mut notices = Notices::default();
    notices.whole(&document)?;
    let mut files = Vec::new();
    let buffers = Buffers::read(&document, container.binary, folder, &mut files)?;
    progress("reading", 0.25);
    let most = LEAST_MOST.max(MOST_PER_BYTE.saturating_mul(bytes.len() + buffers.bytes()));
    let walk = Walk::new(&document)?;
    let mut images = Images::new(&document, &buffers, folder);
    let mut palette = Palette::default();
    let mut triangles = Triangles::new(most);
    for (i, place) in walk.meshes.iter().enumerate() {
        let mesh = document.mesh(place.id)?;
        for (j, primitive) in mesh.primitives.iter().enumerate() {
            let at = Place::of("meshes", place.id).field("primitives").index(j);
            let Some(part) = primitive::read(&document, &buffers, primitive, &at, &mut notices)? else {
                continue;
            };
            let material = palette.id(&document, primitive.material, &mut images, &mut notices)?;
            triangles.add(part, &place.transform, material, palette.placement(material), &at)?;
        }
        progress("reading", 0.25 + 0.75 * (i + 1) as f32 / walk.meshes.len() as f32);
    }
    let mut asset = triangles.into_asset()?;
    let shift = asset.mesh.shift;
    for place in &walk.lights {
        asset.lights.push(light::light(&document, place, shift, &mut notices)?);
    }
    if let Some(place) = &walk.camera {
        asset.camera = nodes::camera(&document, place, shift, &mut notices)?;
    }
    files.extend(images.files);
    asset.files = files;
    asset.textures = images.textures;
    asset.texels = images.texels;
    asset.materials = palette.materials;
    asset.names.materials = palette.names;
    asset.complete_coordinates();
    notices.tell(name);
    Ok(asset)
}
