//! Sets of rays to measure tracers with: what a camera sends out, and what follows from where that hits.
//!
//! | set | rays | query |
//! |---|---|---|
//! | [`SetKind::Primary`] (R1) | one through the middle of each pixel | closest |
//! | [`SetKind::Shadow`] (R2) | one per R1 hit, to a point light | any |
//! | [`SetKind::Mirror`] (R3) | one per R1 hit, mirrored at the face normal | closest |
//! | [`SetKind::Ambient`] (R4) | one per R1 hit, cosine-weighted about the face normal | any |
//!
//! All is computed in f64 with the hits of the oracle and rounded to f32 at the end, so that the sets depend on no tracer
//! that is to be measured. Two workloads differ in their details: [`fitted`] has one view that the mesh fills and keeps the
//! rows of the picture, as a GPU gets them; [`outer`] has three views and goes tile by tile, as SIMD on a CPU likes it, and
//! [`inner`] one more from inside.

mod direction;
mod fitted;
mod outer;
mod pixels;
mod viewpoint;

pub use fitted::fitted;
pub use outer::{inner, outer};

use crate::backend::Query;
use crate::oracle::{Oracle, OracleHit, OracleRay};
use direction::reflected;
use glam::{DVec3, UVec2, Vec3};
use oktant_shared::ray::Ray;
use rayon::prelude::*;
use viewpoint::Viewpoint;

/// What the rays of a set are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SetKind {
    /// Through the pixels.
    Primary,
    /// To a light.
    Shadow,
    /// Mirrored.
    Mirror,
    /// Into the surroundings, for ambient occlusion.
    Ambient,
}

impl SetKind {
    /// All kinds, R1 to R4.
    pub const ALL: [SetKind; 4] = [SetKind::Primary, SetKind::Shadow, SetKind::Mirror, SetKind::Ambient];

    /// R1 to R4.
    pub fn name(self) -> &'static str {
        ["R1", "R2", "R3", "R4"][self as usize]
    }

    /// What its rays ask for.
    pub fn query(self) -> Query {
        match self {
            SetKind::Primary | SetKind::Mirror => Query::Closest,
            SetKind::Shadow | SetKind::Ambient => Query::Any,
        }
    }
}

/// Rays of one kind from one view, in the order of the pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct RaySet {
    /// Name of the view.
    pub view: &'static str,
    /// What the rays are for.
    pub kind: SetKind,
    /// The rays.
    pub rays: Vec<Ray>,
}

/// A surface that a primary ray sees, from which the others start.
struct Seen {
    /// Direction of the primary ray.
    direction: DVec3,
    /// Unit normal of the triangle on the viewer's side.
    normal: DVec3,
    /// The hit, moved off the surface and rounded to f32.
    origin: Vec3,
    /// Index of the pixel in rows from the upper left.
    pixel: u32,
}

/// What a workload leaves open.
trait Workload: Sync {
    /// `t_max` of rays that nothing limits.
    const UNLIMITED: f32;

    /// The pixels of a picture in the order of the rays.
    fn pixels(&self, size: UVec2) -> Vec<UVec2>;

    /// Where a primary ray hit, before rounding to f32.
    fn point(&self, ray: &OracleRay, hit: &OracleHit, corners: [DVec3; 3]) -> DVec3;

    /// How far origins are moved along the normal, scene units.
    fn clearance(&self) -> f64;

    /// `t_max` of a shadow ray to a light at this distance.
    fn to_light(&self, distance: f64) -> f32;

    /// Direction and `t_max` of an ambient ray.
    fn ambient(&self, seen: &Seen) -> (DVec3, f32);
}

/// The four sets of a view, R1 to R4.
fn sets<W: Workload>(workload: &W, view: &Viewpoint, oracle: &Oracle, size: UVec2) -> [RaySet; 4] {
    let pixels = workload.pixels(size);
    let ray = |origin: Vec3, direction: DVec3, t_max: f32| Ray {
        origin,
        t_min: 0.0,
        direction: direction.normalize().as_vec3(),
        t_max,
    };
    let eye = view.eye.as_vec3();
    let primary: Vec<Ray> = pixels
        .par_iter()
        .map(|&pixel| ray(eye, view.direction(pixel, size), W::UNLIMITED))
        .collect();
    let seen: Vec<Seen> = primary
        .par_iter()
        .zip(&pixels)
        .filter_map(|(ray, pixel)| see(workload, oracle, ray, pixel.y * size.x + pixel.x))
        .collect();
    let of_each = |make: &(dyn Fn(&Seen) -> Ray + Sync)| seen.par_iter().map(make).collect::<Vec<Ray>>();
    let shadow = of_each(&|seen| {
        let to_light = view.light - seen.origin.as_dvec3();
        ray(seen.origin, to_light, workload.to_light(to_light.length()))
    });
    let mirror = of_each(&|seen| ray(seen.origin, reflected(seen.direction, seen.normal), W::UNLIMITED));
    let ambient = of_each(&|seen| {
        let (direction, t_max) = workload.ambient(seen);
        ray(seen.origin, direction, t_max)
    });
    let mut rays = [primary, shadow, mirror, ambient].into_iter();
    SetKind::ALL.map(|kind| RaySet {
        view: view.name,
        kind,
        rays: rays.next().unwrap_or_default(),
    })
}

/// What a primary ray sees; nothing where it misses.
fn see<W: Workload>(workload: &W, oracle: &Oracle, ray: &Ray, pixel: u32) -> Option<Seen> {
    let ray = OracleRay::new(ray.origin, ray.direction, 0.0, f32::INFINITY);
    let hit = oracle.closest(&ray)?;
    let corners = oracle.corners(hit.triangle);
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).normalize();
    let normal = if normal.dot(ray.direction) > 0.0 {
        -normal
    } else {
        normal
    };
    let point = workload.point(&ray, &hit, corners) + normal * workload.clearance();
    Some(Seen {
        direction: ray.direction,
        normal,
        origin: point.as_vec3(),
        pixel,
    })
}

#[cfg(test)]
mod tests;
