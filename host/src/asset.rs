//! What a model file holds: a mesh, and what comes with it.

use crate::mesh::Mesh;
use crate::model::{CLAY, Model, needs_coordinates, plain_material};
use crate::names::Names;
use crate::projection::Projection;
use crate::source::Setting;
use crate::view::View;
use glam::{Vec2, Vec3};
use oktant_shared::light::Light;
use oktant_shared::material::Material;
use oktant_shared::texture::Texture;
use std::path::PathBuf;

/// A mesh with normals, with the materials, lights and the camera that its file gives it, if any. All places are in the
/// mesh's coordinates: [`Mesh::shift`] is subtracted from them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Asset {
    /// All triangles.
    pub mesh: Mesh,
    /// Empty where there are no materials, else the index of its material for each triangle.
    pub material_ids: Vec<u32>,
    /// Empty where the file gives none.
    pub materials: Vec<Material>,
    /// What the file calls them.
    pub names: Names,
    /// What materials refer to.
    pub textures: Vec<Texture>,
    /// The texels of all images.
    pub texels: Vec<u32>,
    /// Empty where the file has none.
    pub lights: Vec<Light>,
    /// From where the file wants to be seen.
    pub camera: Option<FileCamera>,
    /// The files that it was read from.
    pub files: Vec<PathBuf>,
}

/// A camera of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FileCamera {
    /// Where it is, scene units.
    pub eye: Vec3,
    /// Unit vector along which it looks.
    pub forward: Vec3,
    /// How much it sees.
    pub lens: Lens,
}

/// How much a camera of a file sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// In perspective: vertical field of view, degrees, 1 to 170.
    FieldOfView(f32),
    /// Without it: from the lower edge of the picture to the upper one, scene units, above 0.
    Height(f32),
}

impl Asset {
    /// A mesh alone, computing the normals that are missing.
    pub fn of_mesh(mesh: Mesh) -> Self {
        Asset {
            mesh: mesh.with_normals(),
            ..Asset::default()
        }
    }

    /// Gives a mesh without texture coordinates some, where a material needs them: (0, 0) for all vertices.
    pub(crate) fn complete_coordinates(&mut self) {
        if self.mesh.coordinates.is_empty() && self.materials.iter().any(needs_coordinates) {
            self.mesh.coordinates = vec![Vec2::ZERO; self.mesh.positions.len()];
        }
    }

    /// What there is to see, and from where: what the file does not say is as for a mesh alone.
    pub fn into_setting(self) -> Setting {
        self.into_setting_seen(View::default())
    }

    /// As [`Asset::into_setting`], with another view where the file does not say it.
    pub fn into_setting_seen(self, mut view: View) -> Setting {
        let whole = self.mesh.bounding_sphere();
        let lights = self.lights;
        let mut model = Model::of_mesh(self.mesh);
        if !self.materials.is_empty() {
            model.material_ids = if self.materials.len() > 1 {
                self.material_ids
            } else {
                Vec::new()
            };
            model.materials = self.materials;
            model.textures = self.textures;
            model.texels = self.texels;
        }
        if let Some(camera) = self.camera {
            match camera.lens {
                Lens::FieldOfView(degrees) => view.field_of_view = degrees,
                Lens::Height(_) => view.projection = Projection::Orthographic,
            }
            // Where it looks past everything, it circles what is as far away as the middle of all.
            let ahead = (whole.center - camera.eye).dot(camera.forward);
            let distance = if ahead > 0.0 { ahead } else { whole.radius };
            let focus = view.look(camera.eye + camera.forward * distance, camera.forward * -distance);
            model.focus = Some(match camera.lens {
                Lens::FieldOfView(_) => focus,
                Lens::Height(height) => view.show_height(focus, height),
            });
        }
        if let Some(first) = lights.first() {
            view.shine(first, model.focus.unwrap_or(whole));
            model.lights = lights;
        }
        Setting {
            model,
            view,
            names: self.names,
            size: None,
            files: self.files,
        }
    }
}

/// The material of triangles for which a file with materials names none.
pub(crate) fn clay() -> Material {
    Material {
        base: CLAY,
        ..plain_material()
    }
}
