//! The surface where a ray meets it.

use super::optics::mirrored;
use super::texture;
use super::world::{Crossing, Meeting, Met, World};
use crate::model::Model;
use crate::view::Shading;
use glam::{DMat2, DVec2, DVec3};
use oktant_shared::material::{Material, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::texture::NO_TEXTURE;

/// Tilted normals reflect rays at least so far above the surface, as a part of the ray's length.
const LEAST_ELEVATION: f64 = 1e-3;
/// Sums of normals are no direction whose squared length is not above this.
const SHORTEST_SQUARED: f64 = 1e-20;

/// A surface as seen by a ray.
pub(super) struct Surface<'a> {
    pub crossing: Crossing,
    pub material: &'a Material,
    /// Unit normal that shades, on the side from which the ray came.
    pub normal: DVec3,
    /// Where shadow rays start.
    pub shadow_origin: DVec3,
    /// Whether they start above the surface, where a rounder one would be.
    pub is_lifted: bool,
    /// Colour under white light, linear RGB.
    pub base: DVec3,
}

/// What the corners of a triangle say about a point of it.
struct Corners {
    places: [DVec3; 3],
    vertices: [usize; 3],
    weights: [f64; 3],
}

impl Corners {
    fn interpolated(&self, of: impl Fn(usize) -> DVec3) -> DVec3 {
        let terms = self.vertices.iter().zip(&self.weights);
        terms.map(|(vertex, weight)| of(*vertex) * *weight).sum()
    }
}

impl<'a> Surface<'a> {
    /// What a ray with a unit direction met.
    pub fn new(world: &World<'a>, shading: Shading, meeting: &Meeting, origin: DVec3, direction: DVec3) -> Self {
        let crossing = world.crossing(meeting, origin, direction);
        let material = &world.model.materials[crossing.material as usize];
        let mut surface = Surface {
            crossing,
            material,
            normal: crossing.side,
            shadow_origin: crossing.before(),
            is_lifted: false,
            base: material.base.as_dvec3(),
        };
        match meeting.what {
            Met::Plane(index) => surface.lies_on_plane(world.model, index),
            Met::Triangle { id, u, v } => {
                let corners = Corners {
                    places: world.oracle.corners(id),
                    vertices: world.model.mesh.triangles[id as usize].map(|vertex| vertex as usize),
                    weights: [1.0 - u - v, u, v],
                };
                surface.lies_on_triangle(world.model, shading, &corners);
            }
        }
        if surface.normal != crossing.side {
            surface.normal = bent(surface.normal, crossing.side, direction);
        }
        surface
    }

    fn lies_on_plane(&mut self, model: &Model, index: u32) {
        let plane = &model.planes[index as usize];
        let normal = plane.normal.as_dvec3().normalize();
        let along = plane.tangent.as_dvec3().normalize();
        let aside = normal.cross(along);
        let at = DVec2::new(self.crossing.point.dot(along), self.crossing.point.dot(aside));
        self.lies_under_textures(model, at, [along, aside]);
    }

    fn lies_on_triangle(&mut self, model: &Model, shading: Shading, corners: &Corners) {
        let (mesh, side) = (&model.mesh, self.crossing.side);
        let [a, b, c] = corners.places;
        if self.material.flags & SMOOTH_NORMALS != 0 && shading == Shading::Phong && !mesh.normals.is_empty() {
            let normal = |vertex: usize| mesh.normals[vertex].as_dvec3();
            let sum = corners.interpolated(normal);
            if sum.length_squared() > SHORTEST_SQUARED {
                self.normal = facing(sum.normalize(), side);
            }
            let lift = lift(corners, self.crossing.point, |vertex| facing(normal(vertex), side));
            self.is_lifted = lift != DVec3::ZERO;
            self.shadow_origin += lift;
        }
        if self.material.flags & VERTEX_COLORS != 0 && !mesh.colors.is_empty() {
            self.base *= corners.interpolated(|vertex| {
                let [red, green, blue, _] = mesh.colors[vertex];
                texture::light_of([red, green, blue])
            });
        }
        if !mesh.coordinates.is_empty() {
            let [at_a, at_b, at_c] = corners.vertices.map(|vertex| mesh.coordinates[vertex].as_dvec2());
            let [weight_a, weight_b, weight_c] = corners.weights;
            let at = at_a * weight_a + at_b * weight_b + at_c * weight_c;
            // How the point moves with the coordinates: the inverse of how they change along the edges.
            let along_edges = DMat2::from_cols(at_b - at_a, at_c - at_a);
            let tangents = if along_edges.determinant() == 0.0 {
                [DVec3::ZERO; 2]
            } else {
                let inverse = along_edges.inverse();
                [inverse.x_axis, inverse.y_axis].map(|edges| (b - a) * edges.x + (c - a) * edges.y)
            };
            self.lies_under_textures(model, at, tangents);
        }
    }

    /// The colour and the bumps at texture coordinates; `tangents` say how the point moves with them, and are zero where it
    /// does not.
    fn lies_under_textures(&mut self, model: &Model, at: DVec2, tangents: [DVec3; 2]) {
        if self.material.texture != NO_TEXTURE {
            self.base *= texture::color(model, self.material.texture, at);
        }
        let area = tangents[0].cross(tangents[1]);
        if self.material.bump == NO_TEXTURE || area == DVec3::ZERO {
            return;
        }
        // J. F. Blinn, "Simulation of wrinkled surfaces" (SIGGRAPH 1978), about the front's normal.
        let front = if self.crossing.from_front { 1.0 } else { -1.0 };
        let normal = self.normal * front;
        let [rise_u, rise_v] =
            (texture::slope(model, self.material.bump, at) * f64::from(self.material.bump_height)).into();
        let tilt = normal.cross(tangents[1]) * rise_u - normal.cross(tangents[0]) * rise_v;
        let handedness = if area.dot(normal) < 0.0 { -1.0 } else { 1.0 };
        let bumpy = normal + tilt * (handedness / area.length());
        if bumpy.length_squared() > SHORTEST_SQUARED {
            self.normal = facing(bumpy.normalize() * front, self.crossing.side);
        }
    }
}

/// The vector or its opposite, whichever is on that side.
fn facing(vector: DVec3, side: DVec3) -> DVec3 {
    if vector.dot(side) < 0.0 { -vector } else { vector }
}

/// A tilted normal, turned back as far as needed for the mirror image of the ray to stay above the surface.
fn bent(normal: DVec3, side: DVec3, direction: DVec3) -> DVec3 {
    let out = mirrored(direction, normal);
    let elevation = out.dot(side);
    if elevation >= LEAST_ELEVATION {
        return normal;
    }
    let raised = out + side * (LEAST_ELEVATION - elevation);
    (raised.normalize_or_zero() - direction).normalize()
}

/// By how much a point of a triangle is below where the surface would be if it were as round as its normals say (J. Hanika,
/// "Hacking the shadow terminator", Ray Tracing Gems II, 2021).
fn lift(corners: &Corners, point: DVec3, normal: impl Fn(usize) -> DVec3) -> DVec3 {
    let terms = (0..3).map(|corner| {
        let normal = normal(corners.vertices[corner]);
        let below = (corners.places[corner] - point).dot(normal).max(0.0);
        normal * (below * corners.weights[corner])
    });
    terms.sum()
}
