//! Everything that rays meet, and what it looks like.

use crate::buffer::load;
use crate::hit::Hit;
use crate::light::Light;
use crate::material::Material;
use crate::octahedral;
use crate::octree::Root;
use crate::parts::TraversalKind;
use crate::plane::Plane;
use crate::texture::Texture;
use crate::triangle::{Triangle, Vertex};
use glam::{UVec4, Vec2, Vec4};

/// What a traversal reads; on the GPU each array is a storage buffer.
///
/// Triangles have slots, in the order that suits the structure; a mesh's own order are their ids.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The cube around everything.
    pub root: Root,
    /// The structure's nodes, as its traversal reads them.
    pub nodes: &'a [UVec4],
    /// Slots of triangles, leaf by leaf, where a structure refers to a triangle more than once; where triangles are indexed,
    /// the three corners of each slot.
    pub references: &'a [u32],
    /// The triangles by slot, in rows (see [`Triangle::at`]); where they are indexed, the vertices (see
    /// [`Triangle::indexed`]).
    pub triangles: &'a [Vec4],
    /// The triangles' ids by slot.
    pub ids: &'a [u32],
    /// What [`crate::general::General`] is to be, see [`crate::parts::Parts::number`].
    pub parts: u32,
}

impl Scene<'_> {
    /// Whether triangles are three indices each, see [`TraversalKind::is_indexed`].
    #[inline(always)]
    pub fn is_indexed(&self) -> bool {
        self.parts & 7 == TraversalKind::Compact as u32
    }

    /// The triangle at a slot, however triangles are stored for the parts.
    #[inline(always)]
    pub fn triangle(&self, slot: u32) -> Triangle {
        if self.is_indexed() {
            Triangle::indexed(self.references, self.triangles, slot)
        } else {
            Triangle::at(self.triangles, slot)
        }
    }

    /// A hit with the triangle's id in place of its slot; misses stay.
    #[inline]
    pub fn identified(&self, hit: Hit) -> Hit {
        if hit.is_hit() {
            Hit {
                triangle: load(self.ids, hit.triangle),
                ..hit
            }
        } else {
            hit
        }
    }
}

/// What shading reads. On the GPU no array is empty; how many lights and planes there are, says the frame.
#[derive(Clone, Copy)]
pub struct Appearance<'a> {
    /// What the triangles' corners carry; a single one where nothing is carried, or where triangles are indexed and the
    /// normals beside their corners do.
    pub vertices: &'a [Vertex],
    /// Texture coordinates by vertex; a single one where no mesh has any.
    pub coordinates: &'a [Vec2],
    /// Index of the material by the triangle's slot; a single one where the scene is plain.
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

impl World<'_> {
    /// What a vertex carries.
    #[inline(always)]
    pub fn vertex(&self, index: u32) -> Vertex {
        if !self.scene.is_indexed() | (self.appearance.vertices.len() > 1) {
            return load(self.appearance.vertices, index);
        }
        Vertex {
            normal: octahedral::direction(load(self.scene.triangles, index).w.to_bits()),
            color: u32::MAX,
        }
    }
}
