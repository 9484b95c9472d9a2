//! A triangle of the oracle and its intersection with a line.

use glam::{DVec2, DVec3};

use super::exact::{self, ExactRay};
use super::ray::OracleRay;

/// A projected triangle whose area is below this many units in the last place of (its size times its distance from
/// the ray's origin) is seen edge-on.
///
/// Three roundings of 2^-53 displace each projected corner, six products make the area: 64 covers them with a margin
/// of about two.
const EDGE_ON_ULPS: f64 = 64.0 * f64::EPSILON;

/// Corners and normal in f64.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Corners, scene units. Exactly those of the mesh.
    pub corners: [DVec3; 3],
    /// Cross product of the edges; its length is twice the area. Zero if and only if the triangle is degenerate.
    pub normal: DVec3,
}

/// The line of a ray, sheared so that it becomes the third coordinate axis.
pub(super) struct Shear {
    /// The line as it is, where its numbers are f32.
    exact: Option<ExactRay>,
    origin: DVec3,
    axes: [usize; 3],
    shear: DVec2,
    direction: DVec3,
}

/// Where a line meets a triangle: `t`, and the weights of the second and the third corner.
pub(super) struct Meeting {
    pub t: f64,
    pub u: f64,
    pub v: f64,
    /// On which sides the line passes the edges, where that is known exactly.
    sides: Option<[f64; 3]>,
}

impl Shear {
    /// For a valid ray.
    pub fn new(ray: &OracleRay) -> Self {
        let z = ray.dominant_axis();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let speed = ray.direction[z];
        Shear {
            exact: ExactRay::of(ray),
            origin: ray.origin,
            axes,
            shear: DVec2::new(ray.direction[axes[0]], ray.direction[axes[1]]) / speed,
            direction: ray.direction,
        }
    }

    /// Across the line (two coordinates) and along its dominant axis, in scene units.
    fn apply(&self, point: DVec3) -> (DVec2, f64) {
        let from_origin = point - self.origin;
        let along = from_origin[self.axes[2]];
        let across = DVec2::new(from_origin[self.axes[0]], from_origin[self.axes[1]]) - self.shear * along;
        (across, along)
    }
}

impl Triangle {
    pub fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        Triangle {
            corners,
            // Where corners differ much in size, f64 may lose the area of a triangle that has one.
            normal: if normal == DVec3::ZERO {
                exact::normal(corners)
            } else {
                normal
            },
        }
    }

    /// Whether the corners lie on one line.
    pub fn is_degenerate(&self) -> bool {
        self.normal == DVec3::ZERO
    }

    /// Where the line meets the closed triangle, whatever its `t`; `None` if it passes by or lies in the triangle's plane,
    /// and if the triangle is degenerate.
    ///
    /// Whether it does is decided exactly where the ray's numbers are f32. Else by Woop, Benthin and Wald, "Watertight
    /// Ray/Triangle Intersection" (2013), in f64 and without their fall-back: all triangles round a corner see the same
    /// projected corner, and `b * c - d * e` in IEEE arithmetic is never of the wrong sign, at worst 0, which counts as
    /// inside. So no line slips between two triangles; one that exactly touches an edge may be given to either side, and
    /// one in the plane as far as f64 can tell is given to none.
    pub fn meet(&self, line: &Shear) -> Option<Meeting> {
        if self.is_degenerate() {
            return None;
        }
        let sides = match &line.exact {
            Some(exact) => Some(exact.sides(self.corners)?),
            None => None,
        };
        let [(a, a_along), (b, b_along), (c, c_along)] = self.corners.map(|corner| line.apply(corner));
        let weight_a = c.x * b.y - c.y * b.x;
        let weight_b = a.x * c.y - a.y * c.x;
        let weight_c = b.x * a.y - b.y * a.x;
        let area = weight_a + weight_b + weight_c;
        let size = a.abs().max(b.abs()).max(c.abs()).max_element();
        let distance = size.max(a_along.abs()).max(b_along.abs()).max(c_along.abs());
        let is_edge_on = area.abs() <= EDGE_ON_ULPS * size * distance;
        if sides.is_none() {
            let inside = (weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0)
                || (weight_a <= 0.0 && weight_b <= 0.0 && weight_c <= 0.0);
            if !inside || is_edge_on {
                return None;
            }
        }
        let [a_t, b_t, c_t] = [a_along, b_along, c_along].map(|along| along / line.direction[line.axes[2]]);
        let (first, last) = (a_t.min(b_t).min(c_t), a_t.max(b_t).max(c_t));
        if is_edge_on {
            // f64 cannot tell where along the ray; the beginning is as good as any place.
            return Some(Meeting {
                t: first,
                u: 0.0,
                v: 0.0,
                sides,
            });
        }
        // From the plane, which is exact where that is parallel to two axes, but not outside of the corners' range,
        // which the hierarchy relies on.
        let t = self.normal.dot(self.corners[0] - line.origin) / self.normal.dot(line.direction);
        Some(Meeting {
            t: t.clamp(first, last),
            u: (weight_b / area).clamp(0.0, 1.0),
            v: (weight_c / area).clamp(0.0, 1.0),
            sides,
        })
    }

    /// Whether a meeting with a line lies between the ends of its ray's `t`: exactly, where the ray's numbers are f32.
    pub fn is_within(&self, meeting: &Meeting, line: &Shear, ray: &OracleRay) -> bool {
        match (&line.exact, meeting.sides) {
            (Some(exact), Some(sides)) => {
                exact.compare_t(self.corners, sides, ray.t_min).is_ge()
                    && exact.compare_t(self.corners, sides, ray.t_max).is_le()
            }
            _ => ray.contains(meeting.t),
        }
    }
}
