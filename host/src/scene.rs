//! A mesh with its octree, in the arrays that the kernel reads.

use crate::mesh::Mesh;
use crate::octree::{InvalidOctree, Octree, OctreeError, OctreeOptions};
use crate::progress::Progress;
use glam::Vec3;
use oktant_shared::frame::{SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::octree::{Node, Root};
use oktant_shared::triangle::{Triangle, Vertex};
use rayon::prelude::*;

/// Everything that rays meet, ready for a back end.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The octree's cube.
    pub root: Root,
    /// The octree's cells.
    pub nodes: Vec<Node>,
    /// Ids of triangles, leaf by leaf.
    pub references: Vec<u32>,
    /// The triangles by id.
    pub triangles: Vec<Triangle>,
    /// Normals and colours by vertex; a single one where the mesh has neither.
    pub vertices: Vec<Vertex>,
    /// Which of [`SMOOTH_NORMALS`] and [`VERTEX_COLORS`] the vertices can serve.
    pub features: u32,
    /// Triangles left out of the octree because they have no area.
    pub degenerate: u32,
    /// Triangles left out of the octree because they lie exactly on one with a lower id.
    pub duplicates: u32,
    /// Corner of the mesh's bounding box with the smallest coordinates, scene units.
    pub low: Vec3,
    /// Corner of the mesh's bounding box with the largest coordinates, scene units.
    pub high: Vec3,
}

/// Why a mesh cannot become a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// There is nothing to build from.
    #[error(transparent)]
    Octree(#[from] OctreeError),
    /// The build went wrong.
    #[error(transparent)]
    Invalid(#[from] InvalidOctree),
}

impl Scene {
    /// Builds the octree of a mesh and lays out its arrays.
    ///
    /// # Errors
    /// [`SceneError::Octree`] where the mesh has no triangle with an area.
    pub fn new(mesh: &Mesh, options: &OctreeOptions, progress: Progress<'_>) -> Result<Self, SceneError> {
        let octree = Octree::build(mesh, options, progress)?;
        octree.validate(mesh.triangles.len())?;
        Ok(Self::from_parts(mesh, octree))
    }

    /// Lays out the arrays of a mesh and its octree.
    pub fn from_parts(mesh: &Mesh, octree: Octree) -> Self {
        let has_normals = !mesh.normals.is_empty();
        let has_colors = !mesh.colors.is_empty();
        // A vertex that nobody reads keeps the buffer from being empty, which a GPU does not allow.
        let attributes = if has_normals || has_colors {
            mesh.positions.len()
        } else {
            1
        };
        let vertices = (0..attributes)
            .into_par_iter()
            .map(|i| Vertex {
                normal: if has_normals { mesh.normals[i] } else { Vec3::ZERO },
                color: if has_colors {
                    u32::from_le_bytes(mesh.colors[i])
                } else {
                    u32::MAX
                },
            })
            .collect();
        let (low, high) = mesh
            .triangles
            .par_iter()
            .flat_map_iter(|triangle| triangle.map(|i| mesh.positions[i as usize]))
            .map(|position| (position, position))
            .reduce_with(|a, b| (a.0.min(b.0), a.1.max(b.1)))
            .unwrap_or_default();
        Scene {
            root: octree.root,
            nodes: octree.nodes,
            references: octree.references,
            triangles: mesh
                .triangles
                .par_iter()
                .map(|&[a, b, c]| Triangle {
                    a: mesh.positions[a as usize],
                    vertex_a: a,
                    b: mesh.positions[b as usize],
                    vertex_b: b,
                    c: mesh.positions[c as usize],
                    vertex_c: c,
                })
                .collect(),
            vertices,
            features: if has_normals { SMOOTH_NORMALS } else { 0 } | if has_colors { VERTEX_COLORS } else { 0 },
            degenerate: octree.degenerate,
            duplicates: octree.duplicates,
            low,
            high,
        }
    }

    /// The arrays as the shared code takes them.
    pub fn view(&self) -> oktant_shared::scene::Scene<'_> {
        oktant_shared::scene::Scene {
            root: self.root,
            nodes: &self.nodes,
            references: &self.references,
            triangles: &self.triangles,
            vertices: &self.vertices,
        }
    }

    /// Centre of the bounding box, scene units.
    pub fn center(&self) -> Vec3 {
        (self.low + self.high) / 2.0
    }

    /// Half the diagonal of the bounding box, scene units: the radius of a sphere around it.
    pub fn radius(&self) -> f32 {
        (self.high - self.low).length() / 2.0
    }

    /// Bytes of all arrays.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.references.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.vertices.as_slice())
    }
}
