//! Everything that rays meet, and what it looks like.

use crate::buffer::load;
use crate::hit::Hit;
use crate::light::Light;
use crate::material::Material;
use crate::octree::Root;
use crate::plane::Plane;
use crate::texture::Texture;
use crate::triangle::Vertex;
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
    /// Slots of triangles, leaf by leaf, where a structure refers to a triangle more than once.
    pub references: &'a [u32],
    /// The triangles by slot, in rows (see [`crate::triangle::Triangle::at`]).
    pub triangles: &'a [Vec4],
    /// The triangles' ids by slot.
    pub ids: &'a [u32],
    /// What [`crate::general::General`] is to be, see [`crate::parts::Parts::number`].
    pub parts: u32,
}

impl Scene<'_> {
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
    /// What the triangles' corners carry.
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
