//! How much memory a scene takes, array by array.

use super::Scene;

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
    /// Normals by vertex, where they have an array: in rows of four numbers, as GPUs have them.
    pub normals: usize,
    /// Colours by vertex: the fourth number of those rows, or the rows where there are no normals.
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
        let vertices = size_of_val(scene.vertices.as_slice());
        let colors = match (scene.has_normals, scene.has_colors) {
            (_, false) => 0,
            (false, true) => vertices,
            (true, true) => scene.vertices.len() * size_of::<u32>(),
        };
        Memory {
            nodes: size_of_val(scene.nodes.as_slice()),
            references,
            triangles,
            ids: size_of_val(scene.ids.as_slice()),
            normals: vertices - colors,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::progress::silent;
    use crate::structure::StructureOptions;
    use glam::Vec3;

    #[test]
    fn normals_and_colors_take_memory_where_there_are_some() {
        let colored = [9, 99, 199, 255];
        // White is a colour as any other.
        let white = [255; 4];
        for (has_normals, color, wanted) in [
            (false, None, (16, 0)),
            (true, None, (48, 0)),
            (false, Some(colored), (0, 48)),
            (true, Some(colored), (36, 12)),
            (false, Some(white), (0, 48)),
            (true, Some(white), (36, 12)),
        ] {
            let mesh = Mesh {
                positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
                normals: if has_normals { vec![Vec3::Z; 3] } else { Vec::new() },
                colors: color.map_or_else(Vec::new, |color| vec![color; 3]),
                triangles: vec![[0, 1, 2]],
                ..Mesh::default()
            };
            let scene = Scene::new(&mesh, &StructureOptions::default(), &silent).expect("it has a triangle");
            let memory = Memory::of(&scene);
            assert_eq!((memory.normals, memory.colors), wanted, "{color:?}");
            let arrays: usize = memory.arrays().iter().map(|(_, bytes)| bytes).sum();
            assert_eq!(arrays, memory.total());
        }
    }
}
