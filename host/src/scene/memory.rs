//! How much memory a scene takes, array by array.

use super::Scene;
use oktant_shared::triangle::Vertex;

/// Bytes of a scene's arrays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    /// The structure's nodes.
    pub nodes: usize,
    /// Slots of triangles, leaf by leaf.
    pub references: usize,
    /// The triangles; indexed ones with the corners that they share, and those' normals.
    pub triangles: usize,
    /// The triangles' ids by slot.
    pub ids: usize,
    /// Normals by vertex, where they have an array.
    pub normals: usize,
    /// Colours by vertex.
    pub colors: usize,
    /// Texture coordinates by vertex.
    pub coordinates: usize,
    /// The triangles' materials by slot, and the materials.
    pub materials: usize,
    /// Lights, planes, textures and their texels.
    pub others: usize,
}

impl Memory {
    /// All of them with their names, for people.
    pub fn arrays(&self) -> [(&'static str, usize); 9] {
        [
            ("nodes", self.nodes),
            ("references", self.references),
            ("triangles", self.triangles),
            ("ids", self.ids),
            ("normals", self.normals),
            ("colours", self.colors),
            ("coordinates", self.coordinates),
            ("materials", self.materials),
            ("others", self.others),
        ]
    }

    /// Of a scene. An array that nothing refers to counts with its one element.
    pub fn of(scene: &Scene) -> Self {
        let references = size_of_val(scene.references.as_slice());
        let rows = size_of_val(scene.rows());
        let (references, triangles) = if scene.parts.traversal.is_indexed() {
            (0, references + rows)
        } else {
            (references, rows)
        };
        let colors = scene.vertices.len() * size_of::<u32>();
        Memory {
            nodes: size_of_val(scene.nodes.as_slice()),
            references,
            triangles,
            ids: size_of_val(scene.ids.as_slice()),
            normals: scene.vertices.len() * size_of::<Vertex>() - colors,
            colors,
            coordinates: size_of_val(scene.coordinates.as_slice()),
            materials: size_of_val(scene.material_ids.as_slice()) + size_of_val(scene.materials.as_slice()),
            others: size_of_val(scene.lights.as_slice())
                + size_of_val(scene.planes.as_slice())
                + size_of_val(scene.textures.as_slice())
                + size_of_val(scene.texels.as_slice()),
        }
    }

    /// What rays are traced through: all but what surfaces look like.
    pub fn traced(&self) -> usize {
        self.nodes + self.references + self.triangles + self.ids
    }

    /// All of it.
    pub fn total(&self) -> usize {
        self.traced() + self.normals + self.colors + self.coordinates + self.materials + self.others
    }
}
