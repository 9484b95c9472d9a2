//! A model with the structure that rays are traced through, in the arrays that the kernel reads.

mod memory;
mod validate;

pub use memory::Memory;
pub use validate::InvalidModel;
pub(crate) use validate::validate as validate_model;

use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::model::{Focus, Model, needs_coordinates, white_light};
use crate::progress::Progress;
use crate::structure::{InvalidStructure, Structure, StructureOptions};
use bytemuck::Zeroable;
use glam::{UVec4, Vec2, Vec3, Vec4};
use oktant_shared::environment::Environment;
use oktant_shared::light::{AREA, Light};
use oktant_shared::material::{Material, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::octree::Root;
use oktant_shared::parts::Parts;
use oktant_shared::plane::Plane;
use oktant_shared::scene::{Appearance, World};
use oktant_shared::texture::{NO_TEXTURE, Texture};
use oktant_shared::triangle::{Triangle, Vertex};
use rayon::prelude::*;

/// Everything that rays meet, ready for a back end.
///
/// Arrays that nothing refers to hold one element that nobody reads, because a GPU allows no empty buffers.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What pictures are rendered with; the structure is built for it.
    pub parts: Parts,
    /// The cube around everything.
    pub root: Root,
    /// The structure's nodes.
    pub nodes: Vec<UVec4>,
    /// Slots of triangles, leaf by leaf; where triangles are indexed, the vertices of each slot.
    pub references: Vec<u32>,
    /// The triangles by slot; none where they are indexed.
    pub triangles: Vec<Triangle>,
    /// The corners of indexed triangles by vertex, in rows; else none.
    pub corners: Vec<Vec4>,
    /// The triangles' ids by slot.
    pub ids: Vec<u32>,
    /// Normals and colours by vertex; a single one where the mesh has neither.
    pub vertices: Vec<Vertex>,
    /// Texture coordinates by vertex; a single one where the mesh has none.
    pub coordinates: Vec<Vec2>,
    /// Index of the material by slot; a single one where the scene is plain.
    pub material_ids: Vec<u32>,
    /// The materials.
    pub materials: Vec<Material>,
    /// The light that a view moves; black where the model has none.
    pub light: Light,
    /// The others.
    pub lights: Vec<Light>,
    /// How many of those there are.
    pub light_count: u32,
    /// Planes without end.
    pub planes: Vec<Plane>,
    /// How many of those there are.
    pub plane_count: u32,
    /// What materials and the environment refer to.
    pub textures: Vec<Texture>,
    /// The texels of all images.
    pub texels: Vec<u32>,
    /// What surrounds everything.
    pub environment: Environment,
    /// Ambient light, linear RGB.
    pub ambient: Vec3,
    /// What is looked at.
    pub focus: Focus,
    /// Triangles left out of the structure because they have no area.
    pub degenerate: u32,
    /// Triangles left out of the structure because they lie exactly on one with a lower id.
    pub duplicates: u32,
    /// Corner of the mesh's bounding box with the smallest coordinates, scene units.
    pub low: Vec3,
    /// Corner of the mesh's bounding box with the largest coordinates, scene units.
    pub high: Vec3,
}

/// Why a model cannot become a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// There is nothing to build from.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The model breaks a rule.
    #[error(transparent)]
    Model(#[from] InvalidModel),
    /// The build went wrong.
    #[error(transparent)]
    Invalid(#[from] InvalidStructure),
}

impl Scene {
    /// A scene of a mesh alone, see [`Model::of_mesh`].
    ///
    /// # Errors
    /// [`SceneError::Build`] where the mesh has no triangle with an area.
    pub fn new(mesh: &Mesh, options: &StructureOptions, progress: Progress<'_>) -> Result<Self, SceneError> {
        Self::of_model(Model::of_mesh(mesh.clone()), options, progress)
    }

    /// Builds the structure over a model's triangles and lays out its arrays.
    ///
    /// # Errors
    /// [`SceneError::Build`] where there is neither a triangle with an area nor a plane; [`SceneError::Model`] where the
    /// model breaks a rule that a kernel relies on, such as an index out of range.
    pub fn of_model(model: Model, options: &StructureOptions, progress: Progress<'_>) -> Result<Self, SceneError> {
        validate::validate(&model)?;
        let structure = match Structure::build(&model.mesh, options, progress) {
            Err(BuildError::NoArea) if !model.planes.is_empty() => Structure::empty(options.parts.traversal),
            built => built?,
        };
        structure.validate(model.mesh.triangles.len())?;
        Ok(Self::of_structure(model, structure, options.parts))
    }

    /// Lays out the arrays of a model and its structure.
    fn of_structure(model: Model, structure: Structure, parts: Parts) -> Self {
        let mesh = &model.mesh;
        let has_normals = !mesh.normals.is_empty();
        let has_colors = !mesh.colors.is_empty();
        let is_indexed = parts.traversal.is_indexed();
        // Normals of indexed triangles lie beside their corners.
        let vertices = if (has_normals && !is_indexed) || has_colors {
            (0..mesh.positions.len())
                .into_par_iter()
                .map(|i| Vertex {
                    normal: if has_normals { mesh.normals[i] } else { Vec3::ZERO },
                    color: if has_colors {
                        u32::from_le_bytes(mesh.colors[i])
                    } else {
                        u32::MAX
                    },
                })
                .collect()
        } else {
            Vec::new()
        };
        let material_ids: Vec<u32> = if model.material_ids.is_empty() {
            Vec::new()
        } else {
            structure
                .ids
                .par_iter()
                .map(|id| model.material_ids[*id as usize])
                .collect()
        };
        let bounds = structure.bounds.or_else(|| mesh.bounds());
        let (low, high) = bounds.unwrap_or_default();
        let focus = model.focus.unwrap_or(Focus {
            center: (low + high) / 2.0,
            radius: bounds.map_or(1.0, |(low, high)| (high - low).length() / 2.0),
        });
        let mut materials = model.materials;
        // Materials that ask for either get what there is.
        for material in &mut materials {
            if !has_normals {
                material.flags &= !SMOOTH_NORMALS;
            }
            if !has_colors {
                material.flags &= !VERTEX_COLORS;
            }
        }
        let mut lights = model.lights.into_iter();
        let light = lights.next().unwrap_or(Light {
            color: Vec3::ZERO,
            ..white_light()
        });
        let lights: Vec<_> = lights.collect();
        let mut scene = Scene {
            parts,
            root: structure.root,
            nodes: structure.nodes,
            references: never_empty(structure.references),
            triangles: if is_indexed {
                Vec::new()
            } else {
                never_empty(structure.triangles)
            },
            corners: if is_indexed {
                never_empty(structure.corners)
            } else {
                Vec::new()
            },
            ids: never_empty(structure.ids),
            vertices: never_empty(vertices),
            coordinates: never_empty(model.mesh.coordinates),
            material_ids: never_empty(material_ids),
            materials,
            light,
            light_count: lights.len() as u32,
            lights: never_empty(lights),
            plane_count: model.planes.len() as u32,
            planes: never_empty(model.planes),
            textures: never_empty(model.textures),
            texels: never_empty(model.texels),
            environment: model.environment,
            ambient: model.ambient,
            focus,
            degenerate: structure.degenerate,
            duplicates: structure.duplicates,
            low,
            high,
        };
        let is_fast = scene.is_plain() && matches!(scene.parts, Parts::STANDARD | Parts::COMPACT);
        if scene.material_ids.len() < scene.ids.len() && !is_fast {
            // Only what renders plain scenes without the general parts does without, whatever the number of materials.
            scene.material_ids = vec![0; scene.ids.len()];
        }
        scene
    }

    /// What a traversal reads.
    pub fn view(&self) -> oktant_shared::scene::Scene<'_> {
        oktant_shared::scene::Scene {
            root: self.root,
            nodes: &self.nodes,
            references: &self.references,
            triangles: self.rows(),
            ids: &self.ids,
            parts: self.parts.number(),
        }
    }

    /// The rows that triangles are made of.
    pub fn rows(&self) -> &[Vec4] {
        if self.parts.traversal.is_indexed() {
            &self.corners
        } else {
            bytemuck::cast_slice(&self.triangles)
        }
    }

    /// The arrays as the shared code takes them.
    pub fn world(&self) -> World<'_> {
        World {
            scene: self.view(),
            appearance: Appearance {
                vertices: &self.vertices,
                coordinates: &self.coordinates,
                material_ids: &self.material_ids,
                materials: &self.materials,
                lights: &self.lights,
                planes: &self.planes,
                textures: &self.textures,
                texels: &self.texels,
            },
        }
    }

    /// Whether some material lets light through.
    pub fn is_transparent(&self) -> bool {
        self.materials.iter().any(Material::is_transmissive)
    }

    /// Whether the kernel's variant for scenes that need little renders this one: no more than one opaque material
    /// without mirror and textures, one light that is no area, no plane, no image around.
    pub fn is_plain(&self) -> bool {
        let material = &self.materials[0];
        self.materials.len() == 1
            && !material.is_transmissive()
            && material.mirror == Vec3::ZERO
            && !needs_coordinates(material)
            && self.light_count == 0
            && self.light.kind != AREA
            && self.plane_count == 0
            && self.environment.texture == NO_TEXTURE
    }

    /// Centre of the bounding box, scene units.
    pub fn center(&self) -> Vec3 {
        (self.low + self.high) / 2.0
    }

    /// Half the diagonal of the bounding box, scene units: the radius of a sphere around it.
    pub fn radius(&self) -> f32 {
        (self.high - self.low).length() / 2.0
    }
}

fn never_empty<T: Zeroable>(mut elements: Vec<T>) -> Vec<T> {
    if elements.is_empty() {
        elements.push(T::zeroed());
    }
    elements
}
