//! Everything that rays meet, and what it looks like.

use crate::light::Light;
use crate::material::Material;
use crate::octree::{Node, Root};
use crate::plane::Plane;
use crate::texture::Texture;
use crate::triangle::{Triangle, Vertex};
use glam::Vec2;

/// What a traversal reads; on the GPU each array is a storage buffer.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The octree's cube.
    pub root: Root,
    /// The octree's cells, the root first.
    pub nodes: &'a [Node],
    /// Ids of triangles, leaf by leaf.
    pub references: &'a [u32],
    /// The triangles by id.
    pub triangles: &'a [Triangle],
}

/// What shading reads. On the GPU no array is empty; how many lights and planes there are, says the frame.
#[derive(Clone, Copy)]
pub struct Appearance<'a> {
    /// What the triangles' corners carry.
    pub vertices: &'a [Vertex],
    /// Texture coordinates by vertex; a single one where no mesh has any.
    pub coordinates: &'a [Vec2],
    /// Index of the material by triangle; a single one where only one plain material is.
    pub material_ids: &'a [u32],
    /// The materials.
    pub materials: &'a [Material],
    /// The lights beside the frame's.
    pub lights: &'a [Light],
    /// The planes.
    pub planes: &'a [Plane],
    /// The textures.
    pub textures: &'a [Texture],
    /// The texels of all images.
    pub texels: &'a [u32],
}

/// Both.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// What rays meet.
    pub scene: Scene<'a>,
    /// What it looks like.
    pub appearance: Appearance<'a>,
}
