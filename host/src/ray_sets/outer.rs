//! Three views from outside and one from inside, tile by tile.

use super::direction::{cosine_weighted, unit_interval};
use super::viewpoint::Viewpoint;
use super::{RaySet, Seen, Workload, pixels, sets};
use crate::mesh::Mesh;
use crate::oracle::{Oracle, OracleHit, OracleRay};
use glam::{DVec3, UVec2, dvec3};

/// Where the eyes are, seen from the middle of the bounding box.
const EYES: [(&str, DVec3); 3] = [
    ("V1", dvec3(0.0, 0.25, 1.0)),
    ("V2", dvec3(1.0, 0.5, 0.6)),
    ("V3", dvec3(-0.7, 0.15, -0.9)),
];
/// Distance of the eyes from there, and of the light, in diagonals of the box.
const DISTANCE: f64 = 0.9;
const LIGHT: DVec3 = dvec3(0.8, 1.2, 0.7);
/// Vertical fields of view from outside and inside, degrees.
const OUTSIDE: f64 = 40.0;
const INSIDE: f64 = 60.0;
/// How far origins are moved off their surface, and the length of ambient rays, in diagonals of the box.
const CLEARANCE: f64 = 1e-4;
const AMBIENT: f64 = 0.25;

struct Outer {
    /// Diagonal of the bounding box, scene units.
    diagonal: f64,
    /// Which view it is, for the random numbers.
    index: u32,
}

/// The four sets of a mesh, R1 to R4, from each of three views at 0.9 diagonals of its bounding box.
///
/// The views look at the middle of the box with y up and a vertical field of view of 40 degrees; the light is (0.8, 1.2,
/// 0.7) diagonals from there. Secondary rays start 10^-4 diagonals off the surface; ambient rays reach 0.25 diagonals.
pub fn outer(mesh: &Mesh, oracle: &Oracle, size: UVec2) -> [[RaySet; 4]; 3] {
    let (center, diagonal) = frame(mesh);
    let mut index = 0;
    EYES.map(|(name, eye)| {
        let eye = center + eye * (DISTANCE * diagonal / eye.length());
        let view = Viewpoint::new(name, eye, center - eye, OUTSIDE, center + LIGHT * diagonal);
        let workload = Outer { diagonal, index };
        index += 1;
        sets(&workload, &view, oracle, size)
    })
}

/// As [`outer`], from one view inside the mesh: with a vertical field of view of 60 degrees, and the light halfway between
/// eye and target.
pub fn inner(mesh: &Mesh, oracle: &Oracle, [eye, target]: [DVec3; 2], size: UVec2) -> [RaySet; 4] {
    let (_, diagonal) = frame(mesh);
    let view = Viewpoint::new("V4", eye, target - eye, INSIDE, (eye + target) * 0.5);
    let index = EYES.len() as u32;
    sets(&Outer { diagonal, index }, &view, oracle, size)
}

/// Middle and diagonal of the box of all triangles.
fn frame(mesh: &Mesh) -> (DVec3, f64) {
    let (low, high) = mesh.bounds().unwrap_or_default();
    let (low, high) = (low.as_dvec3(), high.as_dvec3());
    ((low + high) * 0.5, (high - low).length())
}

impl Workload for Outer {
    const UNLIMITED: f32 = f32::INFINITY;

    fn pixels(&self, size: UVec2) -> Vec<UVec2> {
        pixels::tiles(size)
    }

    fn point(&self, _ray: &OracleRay, hit: &OracleHit, [a, b, c]: [DVec3; 3]) -> DVec3 {
        a + (b - a) * hit.u + (c - a) * hit.v
    }

    fn clearance(&self) -> f64 {
        CLEARANCE * self.diagonal
    }

    fn to_light(&self, distance: f64) -> f32 {
        distance as f32
    }

    fn ambient(&self, seen: &Seen) -> (DVec3, f32) {
        let normal = seen.normal;
        let across = if normal.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
        let seed = lowbias32(seen.pixel ^ self.index.wrapping_mul(0x85eb_ca6b));
        let random = |which: u32| unit_interval(lowbias32(seed ^ lowbias32(which.wrapping_add(0x9e37_79b9))));
        let direction = cosine_weighted(normal, across.cross(normal), random(0), random(1));
        (direction, (AMBIENT * self.diagonal) as f32)
    }
}

/// The hash `lowbias32` (Wellons, "Prospecting for Hash Functions", 2018).
fn lowbias32(input: u32) -> u32 {
    let mixed = (input ^ input >> 16).wrapping_mul(0x7feb_352d);
    let mixed = (mixed ^ mixed >> 15).wrapping_mul(0x846c_a68b);
    mixed ^ mixed >> 16
}
