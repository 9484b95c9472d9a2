//! One view that the mesh fills, in the order of the picture's rows.

use super::direction::{cosine_weighted, unit_interval};
use super::viewpoint::Viewpoint;
use super::{RaySet, Seen, Workload, pixels, sets};
use crate::mesh::Mesh;
use crate::oracle::{Oracle, OracleHit, OracleRay};
use glam::{DVec3, UVec2, Vec3, dvec3};

/// Part of the picture that the bounding box fills, and the picture's width by its height: whatever size is asked for, the
/// eye is where these put it.
const FILLED: f64 = 0.96;
const ASPECT: f64 = 1280.0 / 968.0;
/// Vertical field of view, degrees.
const FIELD_OF_VIEW: f64 = 40.0;
/// How far origins are moved off their surface, in diagonals of the bounding box.
const CLEARANCE: f64 = 1e-5;

struct Fitted {
    clearance: f64,
}

/// The four sets of a mesh for a picture of any size, R1 to R4.
///
/// The eye looks at the middle of the bounding box from (0.25, 0.3, 1) with y up and a vertical field of view of 40
/// degrees, from so far that the box, projected along the view, fills 0.96 of a picture of 1280 x 968. The light is 1.5
/// diagonals of the box from its middle along (-0.6, 0.9, 0.5). Secondary rays start 10^-5 diagonals off the surface;
/// ambient rays are unlimited and drawn by PCG (O'Neill 2014) from the pixel's index.
pub fn fitted(mesh: &Mesh, oracle: &Oracle, size: UVec2) -> [RaySet; 4] {
    let (low, high) = vertex_bounds(mesh);
    let workload = Fitted {
        clearance: CLEARANCE * (high - low).length(),
    };
    sets(&workload, &viewpoint(low, high), oracle, size)
}

/// The box of all vertices, also of those that no triangle uses.
fn vertex_bounds(mesh: &Mesh) -> (DVec3, DVec3) {
    let low = mesh.positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let high = mesh.positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    (low.as_dvec3(), high.as_dvec3())
}

fn viewpoint(low: DVec3, high: DVec3) -> Viewpoint {
    let (center, extent) = ((low + high) * 0.5, high - low);
    let back = dvec3(0.25, 0.3, 1.0).normalize();
    let light = center + dvec3(-0.6, 0.9, 0.5).normalize() * (1.5 * extent.length());
    let mut view = Viewpoint::new("fitted", center, -back, FIELD_OF_VIEW, light);
    // A box reaches equally far to both sides of its middle.
    let reach = |axis: DVec3| extent.dot(axis.abs()) * 0.5;
    let wanted = (reach(view.right) / ASPECT).max(reach(view.up));
    view.eye = center + back * (wanted / (FILLED * view.tangent));
    view
}

impl Workload for Fitted {
    const UNLIMITED: f32 = 1e30;

    fn pixels(&self, size: UVec2) -> Vec<UVec2> {
        pixels::rows(size)
    }

    fn point(&self, ray: &OracleRay, hit: &OracleHit, _corners: [DVec3; 3]) -> DVec3 {
        ray.origin + ray.direction * hit.t
    }

    fn clearance(&self) -> f64 {
        self.clearance
    }

    fn to_light(&self, distance: f64) -> f32 {
        (distance * 0.9999) as f32
    }

    fn ambient(&self, seen: &Seen) -> (DVec3, f32) {
        let normal = seen.normal;
        let across = if normal.x.abs() > 0.9 { DVec3::Y } else { DVec3::X };
        let radius_squared = unit_interval(pcg(seen.pixel));
        let turn = unit_interval(pcg(seen.pixel ^ 0x9e37_79b9));
        let direction = cosine_weighted(normal, normal.cross(across), radius_squared, turn);
        (direction, Self::UNLIMITED)
    }
}

/// The output function RXS-M-XS of PCG after one step of its generator (O'Neill 2014; as a hash: Jarzynski and Olano,
/// "Hash Functions for GPU Rendering", 2020).
fn pcg(input: u32) -> u32 {
    let state = input.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}
