//! What a scene consists of, before its octree is built.

use crate::mesh::Mesh;
use glam::Vec3;
use oktant_shared::environment::Environment;
use oktant_shared::light::{Light, POINT};
use oktant_shared::material::{Material, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::plane::Plane;
use oktant_shared::texture::{NO_TEXTURE, Texture};

/// A sphere around what is looked at: where a view's camera and light circle, and how far away they are, is counted in
/// it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Focus {
    /// Its centre, scene units.
    pub center: Vec3,
    /// Its radius, scene units, above 0.
    pub radius: f32,
}

/// Triangles and planes, what they are made of, and what shines on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// All triangles.
    pub mesh: Mesh,
    /// Empty, or the index of its material for each triangle; all have the first one otherwise.
    pub material_ids: Vec<u32>,
    /// At least one.
    pub materials: Vec<Material>,
    /// Planes without end.
    pub planes: Vec<Plane>,
    /// The first one is the one that a hand can move.
    pub lights: Vec<Light>,
    /// What materials and the environment refer to.
    pub textures: Vec<Texture>,
    /// The texels of all images.
    pub texels: Vec<u32>,
    /// What surrounds everything.
    pub environment: Environment,
    /// Ambient light, linear RGB.
    pub ambient: Vec3,
    /// What is looked at; the mesh's bounding sphere where it is not said.
    pub focus: Option<Focus>,
}

/// An opaque material with a soft highlight that takes everything from the mesh that it has.
pub fn plain_material() -> Material {
    Material {
        base: Vec3::ONE,
        ambient: 1.0,
        specular: Vec3::splat(0.22),
        exponent: 40.0,
        mirror: Vec3::ZERO,
        diffuse: 0.85,
        transmission: Vec3::ZERO,
        ior: 1.0,
        absorption: Vec3::ZERO,
        priority: 0,
        texture: NO_TEXTURE,
        bump: NO_TEXTURE,
        bump_height: 0.0,
        flags: VERTEX_COLORS | SMOOTH_NORMALS,
    }
}

/// Whether something of a material lies at places that texture coordinates say.
pub fn needs_coordinates(material: &Material) -> bool {
    material.texture != NO_TEXTURE || material.bump != NO_TEXTURE
}

/// A material whose textures begin with the index `first`.
pub(crate) fn retextured(material: &Material, first: u32) -> Material {
    let moved = |texture: u32| match texture {
        NO_TEXTURE => NO_TEXTURE,
        texture => texture + first,
    };
    Material {
        texture: moved(material.texture),
        bump: moved(material.bump),
        ..*material
    }
}

/// The colour of meshes that have none, linear RGB.
pub const CLAY: Vec3 = Vec3::new(0.62, 0.58, 0.53);

/// What is around meshes alone, linear RGB.
pub const DARK: Vec3 = Vec3::new(0.045, 0.06, 0.085);

/// Ambient light where nobody says how much, linear RGB.
pub const AMBIENT: Vec3 = Vec3::splat(0.12);

impl Model {
    /// A mesh alone: of clay unless it has colours, before a dark background, with one light.
    pub fn of_mesh(mesh: Mesh) -> Self {
        let base = if mesh.colors.is_empty() { CLAY } else { Vec3::ONE };
        Model {
            mesh,
            material_ids: Vec::new(),
            materials: vec![Material {
                base,
                ..plain_material()
            }],
            planes: Vec::new(),
            lights: vec![white_light()],
            textures: Vec::new(),
            texels: Vec::new(),
            environment: Environment::constant(DARK),
            ambient: AMBIENT,
            focus: None,
        }
    }
}

/// A point light without falloff; a view says where.
pub fn white_light() -> Light {
    Light {
        position: Vec3::ZERO,
        kind: POINT,
        color: Vec3::ONE,
        falloff_radius: 0.0,
        edge_u: Vec3::ZERO,
        samples_per_side: 1,
        edge_v: Vec3::ZERO,
        range: 0.0,
    }
}
