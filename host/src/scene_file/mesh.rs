//! Triangle meshes.

use super::assembly::Assembly;
use super::fault::{Fault, Reason};
use super::number::{Each, Factor};
use super::place::Place;
use super::vector::Vector;
use crate::mesh_source::MeshSource;
use crate::transform::Transform;
use glam::DVec3;
use serde::Deserialize;
use std::path::PathBuf;

/// `[[mesh]]`: a triangle mesh, from a file or built in. It is scaled, then rotated, then translated.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mesh {
    /// A mesh file: docs/files.md says which. Either this or `name` is mandatory.
    pub file: Option<PathBuf>,
    /// A mesh that is part of the program: "bunny", "balls" or "stadium".
    pub name: Option<Name>,
    /// Name of its material. Default: its file's materials, else clay, or the colours of its vertices.
    pub material: Option<String>,
    /// Factor of its size, or three along x, y and z; negative mirrors. Default: 1.
    pub scale: Option<Each<Factor, 3>>,
    /// Degrees that it turns about the x, then the y, then the z axis. Default: [0, 0, 0].
    pub rotate: Vector,
    /// By how much it is moved, scene units. Default: [0, 0, 0].
    pub translate: Vector,
}

/// The meshes that are part of the program.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Name {
    /// The Stanford bunny, 69,451 triangles, 0.16 wide.
    Bunny,
    /// Seven balls, 4,032 triangles.
    Balls,
    /// A room 200 long with stands, 55,680 triangles.
    Stadium,
}

impl Mesh {
    /// Adds it to the scene.
    pub fn add_to(&self, assembly: &mut Assembly<'_>, place: &Place) -> Result<(), Fault> {
        let (source, key) = match (&self.file, self.name) {
            (Some(_), Some(_)) => return Err(Fault::new(&place.key("name"), Reason::Excludes("file"))),
            (None, None) => return Err(Fault::new(place, Reason::Lacks("a file or a name"))),
            (Some(file), None) => {
                let path = assembly.folder.path_of(file, &place.key("file"))?;
                (MeshSource::File(path), "file")
            }
            (None, Some(Name::Bunny)) => (MeshSource::Bunny, "name"),
            (None, Some(Name::Balls)) => (MeshSource::Balls, "name"),
            (None, Some(Name::Stadium)) => (MeshSource::Stadium, "name"),
        };
        let asset = assembly.load(source, &place.key(key))?;
        let scale = self
            .scale
            .map_or(DVec3::ONE, |scale| DVec3::from_array(scale.0.map(|factor| factor.0)));
        let transform = Transform::new(scale, self.rotate.0, self.translate.0);
        let mesh = asset.mesh.clone();
        if self.material.is_none() && !asset.materials.is_empty() {
            let ids = assembly.own_materials(&asset, &place.key(key))?;
            return assembly.add_mixed(place, mesh, &transform, &ids);
        }
        let has_colors = !mesh.colors.is_empty();
        let material = assembly
            .palette
            .id(self.material.as_deref(), has_colors, &place.key("material"))?;
        assembly.add(place, mesh, &transform, material)
    }
}
