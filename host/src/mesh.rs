//! A triangle mesh as it comes from a file or a generator.

use std::f64::consts::PI;

use crate::model::Focus;
use glam::{DVec3, Vec2, Vec3};
use oktant_shared::plane::PLANE;
use oktant_shared::triangle::Triangle;
use rayon::prelude::*;

/// Triangles and vertices have at most so many ids.
pub const MOST: usize = PLANE as usize;

/// Indexed triangles with optional normals, colours and texture coordinates per vertex.
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
    /// Empty, or one texture coordinate per vertex; (0, 0) is the lower left corner of an image, (1, 1) the upper right
    /// one. All finite.
    pub coordinates: Vec<Vec2>,
    /// What was subtracted from every position of the file, in f64, before rounding to f32; zero for most files.
    pub shift: DVec3,
}

impl Mesh {
    /// The corners of a triangle, scene units.
    #[inline]
    pub fn corners(&self, [a, b, c]: &[u32; 3]) -> [Vec3; 3] {
        // `map` of an array is a call.
        [
            self.positions[*a as usize],
            self.positions[*b as usize],
            self.positions[*c as usize],
        ]
    }

    /// A triangle as the kernel reads it.
    pub fn triangle(&self, id: u32) -> Triangle {
        let [a, b, c] = self.triangles[id as usize];
        Triangle {
            a: self.positions[a as usize],
            vertex_a: a,
            b: self.positions[b as usize],
            vertex_b: b,
            c: self.positions[c as usize],
            vertex_c: c,
        }
    }

    /// Smallest and largest coordinates of the vertices that triangles use; `None` without triangles.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.triangles
            .par_chunks(BLOCK)
            .map(|triangles| {
                let corners = triangles.as_flattened().iter();
                corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &corner| {
                    let position = self.positions[corner as usize];
                    (min.min(position), max.max(position))
                })
            })
            .reduce_with(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// A sphere around the box of [`Mesh::bounds`]; the unit sphere where there is none.
    pub fn bounding_sphere(&self) -> Focus {
        let (low, high) = self.bounds().unwrap_or((Vec3::NEG_ONE, Vec3::ONE));
        let radius = (high - low).length() / 2.0;
        Focus {
            center: (low + high) / 2.0,
            radius: if radius > 0.0 { radius } else { 1.0 },
        }
    }

    /// Adds another mesh with normals to one that has some. Where only one of them has colours or texture coordinates, the
    /// vertices of the other one are white, or at (0, 0). Both must have the same [`Mesh::shift`], and no more than
    /// [`MOST`] vertices together.
    pub(crate) fn append(&mut self, mesh: Mesh) {
        let first = self.positions.len();
        let count = first + mesh.positions.len();
        if !mesh.colors.is_empty() || !self.colors.is_empty() {
            self.colors.resize(first, [255; 4]);
            self.colors.extend(mesh.colors);
            self.colors.resize(count, [255; 4]);
        }
        if !mesh.coordinates.is_empty() || !self.coordinates.is_empty() {
            self.coordinates.resize(first, Vec2::ZERO);
            self.coordinates.extend(mesh.coordinates);
            self.coordinates.resize(count, Vec2::ZERO);
        }
        self.positions.extend(mesh.positions);
        self.normals.extend(mesh.normals);
        // Ids beyond the range are refused by who asked for this.
        let first = first as u32;
        self.triangles.extend(
            mesh.triangles
                .iter()
                .map(|corners| corners.map(|corner| corner.wrapping_add(first))),
        );
    }

    /// Computes the vertex normals that are missing: all if [`Mesh::normals`] is empty, else those that are zero.
    ///
    /// A normal is the sum of the unit normals of the triangles round the vertex, each weighted by its angle there
    /// (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998), so that it does not depend on how
    /// polygons were cut. The sums are taken in f64 and in file order, whatever the number of threads.
    ///
    /// [`Vec3::ZERO`] remains where no direction is better than another: at vertices that no triangle with an area uses,
    /// and where the sum is shorter than 1e-12, as at the common vertex of two triangles back to back. Shading takes
    /// the triangle's own normal there.
    #[must_use]
    pub fn with_normals(mut self) -> Self {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        // In blocks, so that the triangles' normals need not all be kept.
        let mut weighted = Vec::with_capacity(BLOCK);
        for triangles in self.triangles.chunks(BLOCK) {
            triangles
                .par_iter()
                .map(|&triangle| weighted_normals(triangle.map(|v| self.positions[v as usize])))
                .collect_into_vec(&mut weighted);
            for (triangle, normals) in triangles.iter().zip(&weighted) {
                for (&corner, &normal) in triangle.iter().zip(normals) {
                    sums[corner as usize] += normal;
                }
            }
        }
        self.normals.resize(self.positions.len(), Vec3::ZERO);
        self.normals
            .par_iter_mut()
            .zip(&sums)
            .filter(|(normal, _)| **normal == Vec3::ZERO)
            .for_each(|(normal, &sum)| *normal = direction(sum));
        self
    }
}

/// Triangles that are worked on at a time.
const BLOCK: usize = 1 << 16;

/// The triangle's unit normal times its angle, for each corner; zero if the triangle has no area.
fn weighted_normals([a, b, c]: [Vec3; 3]) -> [DVec3; 3] {
    let [a, b, c] = [a.as_dvec3(), b.as_dvec3(), c.as_dvec3()];
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let normal = ab.cross(-ca);
    // Twice the area is the same at all three corners. In f64, edges that f32 holds make it neither overflow nor vanish.
    let twice_area = normal.length();
    if twice_area == 0.0 {
        return [DVec3::ZERO; 3];
    }
    let normal = normal / twice_area;
    // Two angles suffice, for the sum of the three is known.
    let (length_ab, length_bc, length_ca) = (ab.length(), bc.length(), ca.length());
    let at_a = angle(twice_area, length_ab * length_ca - ab.dot(ca));
    let at_b = angle(twice_area, length_ab * length_bc - ab.dot(bc));
    let at_c = (PI - at_a - at_b).max(0.0);
    [normal * at_a, normal * at_b, normal * at_c]
}

/// The angle between two vectors, 0 to pi, from the length of their cross product and from the product of their lengths
/// plus their dot product.
///
/// By the half-angle formula: accurate for small angles, where acos is not, and cheaper than atan2.
fn angle(cross: f64, lengths_and_dot: f64) -> f64 {
    // Rounding may make the sum negative at an angle of pi.
    2.0 * (cross / lengths_and_dot.max(0.0)).atan()
}

fn direction(sum: DVec3) -> Vec3 {
    const SHORTEST: f64 = 1e-12;
    let length = sum.length();
    if length < SHORTEST {
        Vec3::ZERO
    } else {
        (sum / length).as_vec3()
    }
}
