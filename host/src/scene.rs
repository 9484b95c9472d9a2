//! A model with the structure that rays are traced through, in the arrays that the kernel reads.

mod brightness;
mod features;
mod memory;
mod staging;
mod validate;

pub use features::Features;
pub use memory::Memory;
pub use staging::Staging;
pub use validate::InvalidModel;
pub(crate) use validate::validate as validate_model;

use crate::build_error::BuildError;
use crate::mesh::Mesh;
use crate::model::{Focus, Model, needs_coordinates, white_light};
use crate::progress::Progress;
use crate::structure::{InvalidStructure, Structure, StructureOptions};
use brightness::brightest_colors;
use bytemuck::Zeroable;
use glam::{UVec4, Vec2, Vec3, Vec4};
use oktant_shared::environment::Environment;
use oktant_shared::light::{AREA, Light};
use oktant_shared::material::{Material, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::medium::MAX_MATERIALS;
use oktant_shared::octree::Root;
use oktant_shared::parts::Parts;
use oktant_shared::plane::Plane;
use oktant_shared::scene::{Appearance, World};
use oktant_shared::texture::{NO_TEXTURE, Texture};
use oktant_shared::triangle::{Triangle, Vertex};
use oktant_shared::variant::{GLASS, IMAGE, LIGHTS, MATERIALS, MIRRORS, PLAIN, PLANES, TEXTURES, Variant};
use rayon::prelude::*;
use std::sync::Arc;

/// Everything that rays meet, ready for a back end.
///
/// Arrays that nothing refers to hold one element that nobody reads, because a GPU allows no empty buffers. Those that may be
/// large are shared between scenes that differ only in their [`Staging`].
#[derive(Clone, Debug)]
pub struct Scene {
    /// What pictures are rendered with; the structure is built for it.
    pub parts: Parts,
    /// The cube around everything.
    pub root: Root,
    /// The structure's nodes.
    pub nodes: Arc<Vec<UVec4>>,
    /// Slots of triangles, leaf by leaf; where triangles are indexed, the vertices of each slot.
    pub references: Arc<Vec<u32>>,
    /// The triangles by slot; none where they are indexed.
    pub triangles: Arc<Vec<Triangle>>,
    /// The corners of indexed triangles by vertex, in rows; else none.
    pub corners: Arc<Vec<Vec4>>,
    /// The triangles' ids by slot.
    pub ids: Arc<Vec<u32>>,
    /// Normals and colours by vertex; a single one where the mesh has neither, or normals of 32 bits beside its corners.
    pub vertices: Arc<Vec<Vertex>>,
    /// Whether the mesh has normals by vertex.
    pub has_normals: bool,
    /// Whether it has colours by vertex.
    pub has_colors: bool,
    /// Texture coordinates by vertex; a single one where the mesh has none or no material looks at them.
    pub coordinates: Arc<Vec<Vec2>>,
    /// Index of the material by slot; a single one where the scene is plain.
    pub material_ids: Arc<Vec<u32>>,
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
    pub texels: Arc<Vec<u32>>,
    /// What surrounds everything.
    pub environment: Environment,
    /// Ambient light, linear RGB.
    pub ambient: Vec3,
    /// The brightest colour of each texture, linear RGB.
    pub brightest_colors: Arc<Vec<Vec3>>,
    /// What it needs of a kernel: bits of [`oktant_shared::variant`].
    pub needs: u32,
    /// The variant of the kernel's body that renders it with the default parts, or on the CPU with the compact ones.
    pub variant: Variant,
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
    /// More materials than a ray can tell apart.
    #[error(
        "The scene has {0} materials, and at most {MAX_MATERIALS} are told apart: give those that look alike the same name."
    )]
    Materials(usize),
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
    /// model breaks a rule that a kernel relies on, such as an index out of range; [`SceneError::Materials`].
    pub fn of_model(model: Model, options: &StructureOptions, progress: Progress<'_>) -> Result<Self, SceneError> {
        validate::validate(&model)?;
        if model.materials.len() > MAX_MATERIALS as usize {
            return Err(SceneError::Materials(model.materials.len()));
        }
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
        // Normals of indexed triangles lie beside their corners, in 32 bits. What bends or bounces rays shows that rounding.
        let is_exact = !is_indexed || model.materials.iter().any(bends_rays);
        let vertices = if (has_normals && is_exact) || has_colors {
            (0..mesh.positions.len())
                .into_par_iter()
                .map(|i| Vertex {
                    normal: if has_normals { mesh.normals[i] } else { Vec3::ZERO },
                    // White where there is none.
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
        let brightest_colors = brightest_colors(&model.textures, &model.texels);
        let coordinates = if materials.iter().any(needs_coordinates) {
            model.mesh.coordinates
        } else {
            Vec::new()
        };
        let mut scene = Scene {
            parts,
            root: structure.root,
            nodes: Arc::new(structure.nodes),
            references: shared(structure.references),
            triangles: if is_indexed {
                Arc::default()
            } else {
                shared(structure.triangles)
            },
            corners: if is_indexed {
                shared(structure.corners)
            } else {
                Arc::default()
            },
            ids: shared(structure.ids),
            vertices: shared(vertices),
            has_normals,
            has_colors,
            coordinates: shared(coordinates),
            material_ids: shared(material_ids),
            materials,
            light: white_light(),
            light_count: 0,
            lights: Vec::new(),
            plane_count: model.planes.len() as u32,
            planes: never_empty(model.planes),
            textures: never_empty(model.textures),
            texels: shared(model.texels),
            environment: model.environment,
            ambient: model.ambient,
            brightest_colors: Arc::new(brightest_colors),
            needs: 0,
            variant: Variant::Everything,
            focus,
            degenerate: structure.degenerate,
            duplicates: structure.duplicates,
            low,
            high,
        };
        scene.set_lights(model.lights);
        scene.settle();
        scene
    }

    /// Finds out what it needs, and by which variant it is rendered.
    fn settle(&mut self) {
        self.needs = self.needs();
        self.variant = Variant::least(self.needs);
        self.lay_out_materials();
    }

    /// To be rendered by another variant than the least that suffices; none where it does not.
    pub fn rendered_by(mut self, variant: Variant) -> Option<Self> {
        if !variant.suffices(self.needs) {
            return None;
        }
        self.variant = variant;
        self.lay_out_materials();
        Some(self)
    }

    /// The variant that the CPU renders it with; none where that is the general body, which has everything and takes any parts.
    pub fn cpu_variant(&self) -> Option<Variant> {
        matches!(self.parts, Parts::STANDARD | Parts::COMPACT).then_some(self.variant)
    }

    /// The variant that a GPU renders it with, likewise.
    pub fn gpu_variant(&self) -> Option<Variant> {
        (self.parts == Parts::STANDARD).then_some(self.variant)
    }

    /// Only what looks at no more than the first material does without the material of each triangle.
    fn lay_out_materials(&mut self) {
        let looks = self.cpu_variant().is_none() || self.variant.offers() & MATERIALS != 0;
        if looks && self.material_ids.len() < self.ids.len() {
            self.material_ids = Arc::new(vec![0; self.ids.len()]);
        }
    }

    /// What is in it that takes more than one plain material and one light.
    fn needs(&self) -> u32 {
        let is_used = self.used_materials();
        let used = || self.materials.iter().zip(&is_used).filter(|(_, is_used)| **is_used);
        let any = |is: fn(&Material) -> bool| used().any(|(material, _)| is(material));
        let need = |is: bool, bit: u32| if is { bit } else { 0 };
        let shines = |light: &Light| light.color != Vec3::ZERO;
        let others = &self.lights[..self.light_count as usize];
        let is_area = self.light.kind == AREA && shines(&self.light);
        need(is_used[1..].contains(&true), MATERIALS)
            | need(others.iter().any(shines) || is_area, LIGHTS)
            | need(self.plane_count > 0, PLANES)
            | need(any(needs_coordinates), TEXTURES)
            | need(self.environment.texture != NO_TEXTURE, IMAGE)
            | need(any(|material| material.mirror != Vec3::ZERO), MIRRORS)
            | need(any(Material::is_transmissive), GLASS)
    }

    /// Which materials some triangle or plane has.
    fn used_materials(&self) -> Vec<bool> {
        let mut is_used = vec![false; self.materials.len()];
        if self.material_ids.len() < self.ids.len() {
            is_used[0] = true;
        } else {
            for id in self.material_ids.iter() {
                is_used[*id as usize] = true;
            }
        }
        for plane in &self.planes[..self.plane_count as usize] {
            is_used[plane.material as usize] = true;
        }
        is_used
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
        self.needs & GLASS != 0
    }

    /// Whether it needs nothing but what every variant has.
    pub fn is_plain(&self) -> bool {
        self.needs == PLAIN
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

/// Whether a picture shows where the normal of a surface is off by so little that no shading would.
fn bends_rays(material: &Material) -> bool {
    material.mirror != Vec3::ZERO || material.is_transmissive() || material.bump != NO_TEXTURE
}

fn never_empty<T: Zeroable>(mut elements: Vec<T>) -> Vec<T> {
    if elements.is_empty() {
        elements.push(T::zeroed());
    }
    elements
}

fn shared<T: Zeroable>(elements: Vec<T>) -> Arc<Vec<T>> {
    Arc::new(never_empty(elements))
}
