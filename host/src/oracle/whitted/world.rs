//! What rays meet: triangles and planes.

use super::super::{Oracle, OracleHit, OracleRay};
use super::Reference;
use crate::model::Model;
use glam::DVec3;

/// Rays that leave a surface start this far from it, in parts of the coordinates and edges that the point was computed
/// from: some 2^14 roundings, for the plane of a needle is known less exactly than its corners.
const CLEARANCE: f64 = 1.0 / (1_u64 << 38) as f64;

/// A model with its oracle.
#[derive(Clone, Copy)]
pub(super) struct World<'a> {
    pub model: &'a Model,
    pub oracle: &'a Oracle,
    pub is_transparent: bool,
}

/// Where a ray meets something.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// Distance, for directions of length 1.
    pub t: f64,
    pub what: Met,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
pub(super) enum Met {
    /// A triangle, with the weights of its second and third corner.
    Triangle { id: u32, u: f64, v: f64 },
    /// A plane.
    Plane(u32),
}

/// A meeting as seen by who only goes through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub point: DVec3,
    /// Unit normal of the triangle or plane, on the side from which the ray came.
    pub side: DVec3,
    /// Whether that side is the front.
    pub from_front: bool,
    /// How far from the surface rays that leave it start.
    pub clearance: f64,
    pub material: u32,
}

impl Crossing {
    /// Where a ray starts that stays on the side from which this one came.
    pub fn before(&self) -> DVec3 {
        self.point + self.side * self.clearance
    }

    /// Where a ray starts that goes on behind the surface.
    pub fn behind(&self) -> DVec3 {
        self.point - self.side * self.clearance
    }
}

impl<'a> World<'a> {
    pub fn new(reference: &'a Reference) -> Self {
        World {
            model: &reference.model,
            oracle: &reference.oracle,
            is_transparent: reference.is_transparent,
        }
    }

    /// The nearest thing on a ray up to a distance; of equally near ones a triangle, and the first plane.
    pub fn closest(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Meeting> {
        let plane = self.nearest_plane(origin, direction, reach);
        let triangle = self.closest_triangle(origin, direction, plane.map_or(reach, |plane| plane.t));
        triangle.or(plane)
    }

    /// The nearest triangle on a ray up to a distance.
    pub fn closest_triangle(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Meeting> {
        let hit = self.oracle.closest(&ray(origin, direction, reach))?;
        let OracleHit { t, triangle, u, v } = hit;
        Some(Meeting {
            t,
            what: Met::Triangle { id: triangle, u, v },
        })
    }

    /// Whether there is anything on a ray up to a distance.
    pub fn is_met(&self, origin: DVec3, direction: DVec3, reach: f64) -> bool {
        self.nearest_plane(origin, direction, reach).is_some() || self.oracle.any(&ray(origin, direction, reach))
    }

    fn nearest_plane(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Meeting> {
        let mut nearest: Option<Meeting> = None;
        for (index, plane) in self.model.planes.iter().enumerate() {
            let normal = plane.normal.as_dvec3();
            let speed = normal.dot(direction);
            let t = (f64::from(plane.offset) - normal.dot(origin)) / speed;
            let is_nearer = nearest.is_none_or(|nearest| t < nearest.t);
            if speed != 0.0 && t >= 0.0 && t <= reach && is_nearer {
                nearest = Some(Meeting {
                    t,
                    what: Met::Plane(index as u32),
                });
            }
        }
        nearest
    }

    /// A meeting of a ray with a surface, as far as going through is concerned.
    pub fn crossing(&self, meeting: &Meeting, origin: DVec3, direction: DVec3) -> Crossing {
        let (point, front, size, material) = match meeting.what {
            Met::Triangle { id, u, v } => {
                let [a, b, c] = self.oracle.corners(id);
                let (ab, ac) = (b - a, c - a);
                let point = a + ab * u + ac * v;
                let size = point.abs().max_element() + ab.length() + ac.length();
                (point, ab.cross(ac).normalize(), size, self.material_of(id))
            }
            Met::Plane(index) => {
                let plane = &self.model.planes[index as usize];
                let length = plane.normal.as_dvec3().length();
                let (normal, offset) = (plane.normal.as_dvec3() / length, f64::from(plane.offset) / length);
                let near = origin + direction * meeting.t;
                let point = near - normal * (normal.dot(near) - offset);
                // A ray of any size must not start in the plane itself, even through the origin.
                let size = point.abs().max_element() + offset.abs() + meeting.t;
                (point, normal, size, plane.material)
            }
        };
        let from_front = front.dot(direction) <= 0.0;
        Crossing {
            point,
            side: if from_front { front } else { -front },
            from_front,
            clearance: size * CLEARANCE,
            material,
        }
    }

    fn material_of(&self, triangle: u32) -> u32 {
        self.model.material_ids.get(triangle as usize).copied().unwrap_or(0)
    }
}

fn ray(origin: DVec3, direction: DVec3, reach: f64) -> OracleRay {
    OracleRay {
        origin,
        direction,
        t_min: 0.0,
        t_max: reach,
    }
}
