//! A triangle mesh as it comes from a file or a generator.

use glam::{DVec3, Vec3};

/// Indexed triangles with optional normals and colours per vertex.
///
/// Triangle ids everywhere in oktant are indices into [`Mesh::triangles`]: file order after polygons are cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, in the file's units, with [`Mesh::shift`] subtracted. All finite.
    pub positions: Vec<Vec3>,
    /// Corners of each triangle as indices into [`Mesh::positions`], counter-clockwise. All in range.
    pub triangles: Vec<[u32; 3]>,
    /// Empty, or one unit normal per vertex.
    pub normals: Vec<Vec3>,
    /// Empty, or one sRGB-encoded colour (red, green, blue, alpha) per vertex.
    pub colors: Vec<[u8; 4]>,
    /// What was subtracted from every position of the file, in f64, before rounding to f32; zero for most files.
    pub shift: DVec3,
}
