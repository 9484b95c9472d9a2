//! The oracle: closest and any hit in f64, to judge f32 tracers by.
//!
//! It is written on its own and shares no line with `oktant-shared`: an error there cannot hide by being made twice.
//! Its conventions:
//! - Triangles are closed (edges and corners belong to them) and two-sided; both ends of the ray's `t` are included.
//! - Of equal `t` the lowest triangle id wins.
//! - A degenerate triangle (corners on one line) is never hit, and neither is one that contains the ray.
//! - No epsilon. Whether a ray hits a triangle, and whether it does between the ends of its `t`, is decided without any
//!   rounding where all of the ray's numbers are f32, as those of every tracer's rays are ([`Oracle::contact`] also tells
//!   whether they only touch). For other rays, what f64 leaves open (about 2^-50 of the distance to the ray's origin) is
//!   decided in favour of a hit. Either way no ray slips between two triangles that share an edge or a corner.
//! - Which of two hits is nearer is decided by their `t` in f64, whose error is about 2^-50 of the triangle's distance
//!   over the cosine of incidence. Hits that lie closer together are as good as equal: no f32 tracer can tell them apart,
//!   and [`judge`] takes either for right, for its tolerance is a million times wider.

mod bvh;
mod exact;
mod expansion;
pub mod judge;
mod ray;
mod triangle;
pub mod whitted;

use glam::DVec3;
use rayon::prelude::*;

use crate::mesh::Mesh;
use bvh::{Bounds, Bvh, Item};
pub use exact::Contact;
use exact::ExactRay;
use ray::nearer;
pub use ray::{OracleHit, OracleRay};
use triangle::{Shear, Triangle};

/// The triangles of a mesh in f64, and a plain hierarchy over them.
#[derive(Debug)]
pub struct Oracle {
    triangles: Vec<Triangle>,
    bvh: Bvh,
}

/// Where the line of a ray meets the plane of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneHit {
    /// Where along the ray, in lengths of its direction; may lie outside the ray's `t`.
    pub t: f64,
    /// Distance of the ray's origin from the plane, scene units; positive on the side that sees the corners
    /// counter-clockwise.
    pub distance: f64,
    /// Cosine of the angle between the line and the plane's normal, above 0 and up to 1.
    pub cosine: f64,
}

impl Oracle {
    /// Takes over the triangles of `mesh` and builds the hierarchy, on all of rayon's threads.
    pub fn new(mesh: &Mesh) -> Self {
        let triangles: Vec<Triangle> = mesh
            .triangles
            .par_iter()
            .map(|corners| Triangle::new(corners.map(|corner| mesh.positions[corner as usize].as_dvec3())))
            .collect();
        let items = triangles
            .par_iter()
            .enumerate()
            .filter(|(_, triangle)| !triangle.is_degenerate())
            .map(|(id, triangle)| Item {
                bounds: Bounds::of(&triangle.corners),
                triangle: id as u32,
            })
            .collect();
        Oracle {
            triangles,
            bvh: Bvh::new(items),
        }
    }

    /// How many triangles the mesh has, degenerate ones included.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The closest hit, by the hierarchy; `None` for a miss.
    pub fn closest(&self, ray: &OracleRay) -> Option<OracleHit> {
        let line = Shear::new(ray);
        let mut best = None;
        self.bvh.visit(ray, 0.0, |triangle| {
            best = nearer(best, self.hit(triangle, ray, &line));
            best.map_or(ray.t_max, |hit| hit.t)
        });
        best
    }

    /// Whether the ray hits anything, by the hierarchy.
    pub fn any(&self, ray: &OracleRay) -> bool {
        let line = Shear::new(ray);
        let mut found = false;
        self.bvh.visit(ray, 0.0, |triangle| {
            found = self.hit(triangle, ray, &line).is_some();
            if found { f64::NEG_INFINITY } else { ray.t_max }
        });
        found
    }

    /// The closest hit, by testing every triangle: the same as [`Oracle::closest`], bit for bit.
    pub fn closest_brute(&self, ray: &OracleRay) -> Option<OracleHit> {
        self.hits_brute(ray).fold(None, |best, hit| nearer(best, Some(hit)))
    }

    /// Whether the ray hits anything, by testing every triangle: the same as [`Oracle::any`].
    pub fn any_brute(&self, ray: &OracleRay) -> bool {
        self.hits_brute(ray).next().is_some()
    }

    /// All hits of the ray, by the hierarchy, nearest first, of equal `t` lower ids first.
    pub fn hits(&self, ray: &OracleRay) -> Vec<OracleHit> {
        let line = Shear::new(ray);
        let mut hits = Vec::new();
        self.bvh.visit(ray, 0.0, |triangle| {
            hits.extend(self.hit(triangle, ray, &line));
            ray.t_max
        });
        hits.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
        hits
    }

    /// Ids of the triangles that the line of the ray meets or passes within `distance` (scene units), and possibly
    /// some others close by; degenerate ones are left out. In no particular order.
    pub fn triangles_within(&self, ray: &OracleRay, distance: f64) -> Vec<u32> {
        let mut near = Vec::new();
        let unlimited = OracleRay {
            t_min: f64::NEG_INFINITY,
            t_max: f64::INFINITY,
            ..*ray
        };
        self.bvh.visit(&unlimited, distance, |triangle| {
            near.push(triangle);
            f64::INFINITY
        });
        near
    }

    /// Where the line of the ray meets the closed triangle, whatever its `t`; `None` if it passes by.
    pub fn meet(&self, triangle: u32, ray: &OracleRay) -> Option<OracleHit> {
        let unlimited = OracleRay {
            t_min: f64::NEG_INFINITY,
            t_max: f64::INFINITY,
            ..*ray
        };
        if !unlimited.is_valid() {
            return None;
        }
        self.hit(triangle, &unlimited, &Shear::new(ray))
    }

    /// How the ray and the triangle lie to each other, exactly; `None` where a number of the ray is no f32.
    pub fn contact(&self, triangle: u32, ray: &OracleRay) -> Option<Contact> {
        let exact = ExactRay::of(ray)?;
        Some(if ray.is_valid() {
            exact.contact(self.corners(triangle), [ray.t_min, ray.t_max])
        } else {
            Contact::None
        })
    }

    /// Where the line of the ray meets the plane of the triangle, inside it or not; `None` if the triangle is
    /// degenerate or parallel to the ray.
    pub fn plane_hit(&self, triangle: u32, ray: &OracleRay) -> Option<PlaneHit> {
        let Triangle { corners, normal } = self.triangles[triangle as usize];
        let length = normal.length();
        let approach = normal.dot(ray.direction);
        if length == 0.0 || approach == 0.0 {
            return None;
        }
        // Measured from the corner nearest to the line, where the least cancels.
        let nearest = corners
            .into_iter()
            .min_by(|a, b| ray.offset_of(*a).length().total_cmp(&ray.offset_of(*b).length()))?;
        let above = normal.dot(ray.origin - nearest);
        Some(PlaneHit {
            t: -above / approach,
            distance: above / length,
            cosine: (approach / length / ray.direction.length()).abs(),
        })
    }

    /// Distance, perpendicular to the ray, between the line of the ray and the nearest edge of the triangle, scene
    /// units: how far the ray would have to be moved to touch that edge. Also defined for degenerate triangles.
    pub fn edge_distance(&self, triangle: u32, ray: &OracleRay) -> f64 {
        let [a, b, c] = self.triangles[triangle as usize]
            .corners
            .map(|corner| ray.offset_of(corner));
        [(a, b), (b, c), (c, a)]
            .map(|(from, to)| distance_to_segment(from, to))
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }

    /// Lowest and highest coordinates of all triangles that are not degenerate; reversed and infinite if there are
    /// none.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let Bounds { low, high } = self.bvh.bounds();
        (low, high)
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].corners
    }

    fn hits_brute<'a>(&'a self, ray: &'a OracleRay) -> impl Iterator<Item = OracleHit> + 'a {
        let line = Shear::new(ray);
        let ids = if ray.is_valid() {
            0..self.triangles.len() as u32
        } else {
            0..0
        };
        ids.filter_map(move |id| self.hit(id, ray, &line))
    }

    fn hit(&self, triangle: u32, ray: &OracleRay, line: &Shear) -> Option<OracleHit> {
        let corners = &self.triangles[triangle as usize];
        let meeting = corners.meet(line)?;
        corners.is_within(&meeting, line, ray).then_some(OracleHit {
            // Exactly it is between them.
            t: meeting.t.clamp(ray.t_min, ray.t_max),
            triangle,
            u: meeting.u,
            v: meeting.v,
        })
    }
}

/// Distance of the origin of coordinates from the segment between two points.
fn distance_to_segment(from: DVec3, to: DVec3) -> f64 {
    let edge = to - from;
    let length_squared = edge.length_squared();
    let along = if length_squared > 0.0 {
        (-from.dot(edge) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (from + along * edge).length()
}

#[cfg(test)]
mod tests;
