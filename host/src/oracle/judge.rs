//! What the oracle says about the answers of an f32 tracer.
//!
//! The tracer may err by what f32 forces on it and by no more. All follows from one length, [`point_error`]: how far,
//! seen from the ray's origin `o`, f32 may displace a corner `p` of a triangle. It is [`POINT_ULPS`] times the rounding
//! `2^-24 * (|p| + |p - o|)`.
//! - A ray that passes within that error of an edge, measured perpendicular to the ray, may be given to either side of
//!   it ([`Excuse::Edge`]).
//! - The computed `t` may be off by [`RELATIVE_T`] of itself, plus that error divided by the length of the direction
//!   and by the cosine of incidence, and multiplied by how slender the triangle is ([`t_error`]); but by no more than
//!   the triangle reaches along the ray, plus the error itself.
//! - A hit that close to an end of the ray's `t` may be counted or not ([`Excuse::Limit`]).
//!
//! A watertight test in f32 (Woop, Benthin and Wald 2013) keeps within these bounds from any distance. Moller-Trumbore
//! does so for origins near the mesh; from far away, where it loses whole digits to cancellation, and at slender
//! triangles it may exceed them, and is then told so.

use glam::DVec3;

use super::{Oracle, OracleHit, OracleRay};

/// Relative error of `t` that is always allowed.
pub const RELATIVE_T: f64 = 1e-5;

/// How many roundings displace a corner: one each in `p - o`, in its product with the shear or direction, in their
/// difference, and in the planes of cells. Measured with a watertight test in f32 on 15 million rays of all classes:
/// at most 1.8 at edges, from any distance; and on half a million at most 1.8 in `t` (Moller-Trumbore: 2.6).
pub const POINT_ULPS: f64 = 4.0;

/// Largest relative error of one f32 rounding, 2^-24.
const F32_ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// A closest hit as a tracer reports it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Index into the mesh's triangles.
    pub triangle: u32,
    /// Where along the ray, in lengths of its direction.
    pub t: f64,
}

/// How an answer compares with the oracle's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// Both miss, or both hit at the same `t` within the tolerance: the same triangle or another one that is there.
    Agrees,
    /// The oracle hits something, the tracer nothing.
    Missed,
    /// The tracer hits something farther than the closest hit.
    Farther,
    /// The tracer hits something nearer than the oracle's closest hit.
    Nearer,
    /// The tracer hits something where the oracle hits nothing, or a triangle that is not where it says.
    False,
}

/// Whether f32 can be blamed for an answer that does not agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Excuse {
    /// It agrees and needs none, or it does not and there is none.
    None,
    /// The ray passes so close to an edge of every triangle concerned that f32 cannot tell.
    Edge,
    /// As before, but of the triangles concerned at least one is hit so close to an end of the ray's `t` instead.
    Limit,
}

/// The judgement of one answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Verdict {
    /// How it compares.
    pub outcome: Outcome,
    /// Whether f32 can be blamed.
    pub excuse: Excuse,
}

impl Verdict {
    const AGREES: Verdict = Verdict {
        outcome: Outcome::Agrees,
        excuse: Excuse::None,
    };

    /// Whether the answer disagrees only because the ray passes within the f32 error of an edge.
    pub fn near_edge(&self) -> bool {
        self.excuse == Excuse::Edge
    }

    /// Whether the answer is wrong and f32 cannot be blamed.
    pub fn is_wrong(&self) -> bool {
        self.outcome != Outcome::Agrees && self.excuse == Excuse::None
    }
}

/// Judges the closest hit of a tracer, `None` for a miss.
pub fn judge_closest(oracle: &Oracle, ray: &OracleRay, answer: Option<Answer>) -> Verdict {
    match (oracle.closest(ray), answer) {
        (None, None) => Verdict::AGREES,
        (Some(_), None) => Verdict {
            outcome: Outcome::Missed,
            excuse: excuse_of_skipped(oracle, ray, f64::INFINITY),
        },
        (None, Some(answer)) => Verdict {
            outcome: Outcome::False,
            excuse: claim(oracle, ray, answer).excuse(),
        },
        (Some(hit), Some(answer)) => judge_hit(oracle, ray, hit, answer),
    }
}

/// Judges whether a tracer hits anything.
pub fn judge_any(oracle: &Oracle, ray: &OracleRay, answer: bool) -> Verdict {
    match (oracle.any(ray), answer) {
        (true, true) | (false, false) => Verdict::AGREES,
        (true, false) => Verdict {
            outcome: Outcome::Missed,
            excuse: excuse_of_skipped(oracle, ray, f64::INFINITY),
        },
        (false, true) => Verdict {
            outcome: Outcome::False,
            excuse: excuse_of_phantom(oracle, ray),
        },
    }
}

/// How far, in scene units, an f32 tracer may displace the triangle as seen from the ray's origin.
pub fn point_error(oracle: &Oracle, triangle: u32, ray: &OracleRay) -> f64 {
    let reach = |corner: DVec3| (corner - ray.origin).length() + corner.length();
    POINT_ULPS * F32_ROUNDING * oracle.corners(triangle).map(reach).into_iter().fold(0.0, f64::max)
}

/// Whether the ray passes so close to an edge of the triangle that f32 cannot tell on which side.
pub fn is_near_edge(oracle: &Oracle, triangle: u32, ray: &OracleRay) -> bool {
    oracle.edge_distance(triangle, ray) <= point_error(oracle, triangle, ray)
}

/// No triangle of the mesh has a larger [`point_error`].
fn largest_point_error(oracle: &Oracle, ray: &OracleRay) -> f64 {
    let (low, high) = oracle.bounds();
    let from_ray = (low - ray.origin).abs().max((high - ray.origin).abs());
    let from_zero = low.abs().max(high.abs());
    POINT_ULPS * F32_ROUNDING * (from_ray.length() + from_zero.length())
}

/// How far off an f32 tracer's `t` of this triangle may be beside the relative error, in lengths of the direction.
///
/// The point error moves the plane; the roundings of the barycentric weights count in proportion to the triangle's
/// longest edge over the height above it, as the weights vary over the height and `t` over the edge.
pub fn t_error(oracle: &Oracle, triangle: u32, ray: &OracleRay) -> f64 {
    let speed = ray.direction.length();
    let error = point_error(oracle, triangle, ray) / speed;
    let (low, high) = t_range(oracle, triangle, ray);
    let within_triangle = high - low + error;
    match oracle.plane_hit(triangle, ray) {
        Some(plane) => within_triangle.min(error * slenderness(oracle.corners(triangle)) / plane.cosine),
        None => within_triangle,
    }
}

/// Longest edge over the height above it: 1.15 for an equilateral triangle, infinite for a degenerate one.
fn slenderness([a, b, c]: [DVec3; 3]) -> f64 {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    longest * longest / (b - a).cross(c - a).length()
}

/// What is behind a triangle and `t` that a tracer reports.
enum Claim {
    /// The ray hits that triangle there.
    Hit,
    /// The ray passes within the f32 error of an edge of that triangle there.
    Edge,
    /// The ray meets that triangle there, beyond an end of its `t` but within the f32 error of it.
    Limit,
    /// Nothing.
    Unfounded,
}

impl Claim {
    fn excuse(self) -> Excuse {
        match self {
            Claim::Edge => Excuse::Edge,
            Claim::Limit => Excuse::Limit,
            Claim::Hit | Claim::Unfounded => Excuse::None,
        }
    }
}

fn judge_hit(oracle: &Oracle, ray: &OracleRay, hit: OracleHit, answer: Answer) -> Verdict {
    let gap = answer.t - hit.t;
    let relative = RELATIVE_T * hit.t.abs();
    if answer.triangle == hit.triangle && gap.abs() <= relative {
        return Verdict::AGREES;
    }
    let claim = claim(oracle, ray, answer);
    let mut slack = relative + t_error(oracle, hit.triangle, ray);
    if answer.triangle != hit.triangle && !matches!(claim, Claim::Unfounded) {
        slack += t_error(oracle, answer.triangle, ray);
    }
    if gap > slack {
        Verdict {
            outcome: Outcome::Farther,
            excuse: match claim {
                Claim::Unfounded => Excuse::None,
                _ => excuse_of_skipped(oracle, ray, answer.t - slack),
            },
        }
    } else if gap < -slack {
        Verdict {
            outcome: Outcome::Nearer,
            excuse: claim.excuse(),
        }
    } else if matches!(claim, Claim::Unfounded) {
        Verdict {
            outcome: Outcome::False,
            excuse: Excuse::None,
        }
    } else {
        Verdict::AGREES
    }
}

fn claim(oracle: &Oracle, ray: &OracleRay, answer: Answer) -> Claim {
    let Answer { triangle, t } = answer;
    if triangle as usize >= oracle.triangle_count() {
        return Claim::Unfounded;
    }
    let error = t_error(oracle, triangle, ray);
    let slack = error + RELATIVE_T * t.abs();
    // The ends of `t` are exact, so whatever the error of a tracer's `t`, it must lie between them.
    if !ray.contains(t) {
        return Claim::Unfounded;
    }
    if let Some(met) = oracle.meet(triangle, ray) {
        return match (met.t - t).abs() <= slack {
            true if ray.contains(met.t) => Claim::Hit,
            true => Claim::Limit,
            false => Claim::Unfounded,
        };
    }
    let (low, high) = t_range(oracle, triangle, ray);
    let in_range = low - slack <= t && t <= high + slack;
    // Where the error spans the whole triangle, the plane says nothing more.
    let on_plane = oracle
        .plane_hit(triangle, ray)
        .is_none_or(|plane| (plane.t - t).abs() <= slack || slack >= high - low);
    if in_range && on_plane && is_near_edge(oracle, triangle, ray) {
        Claim::Edge
    } else {
        Claim::Unfounded
    }
}

/// Why a tracer may have passed over everything that the oracle hits before `t`.
fn excuse_of_skipped(oracle: &Oracle, ray: &OracleRay, t: f64) -> Excuse {
    let mut excuse = Excuse::Edge;
    for hit in oracle.hits(ray).into_iter().take_while(|hit| hit.t < t) {
        if is_near_edge(oracle, hit.triangle, ray) {
            continue;
        }
        let slack = t_error(oracle, hit.triangle, ray) + RELATIVE_T * hit.t.abs();
        if hit.t - ray.t_min > slack && ray.t_max - hit.t > slack {
            return Excuse::None;
        }
        excuse = Excuse::Limit;
    }
    excuse
}

/// Why a tracer may say that it hits something where the oracle hits nothing.
fn excuse_of_phantom(oracle: &Oracle, ray: &OracleRay) -> Excuse {
    let mut excuse = Excuse::None;
    for triangle in oracle.triangles_within(ray, largest_point_error(oracle, ray)) {
        let error = t_error(oracle, triangle, ray);
        let (low, high) = t_range(oracle, triangle, ray);
        if low - error > ray.t_max || high + error < ray.t_min {
            continue;
        }
        if is_near_edge(oracle, triangle, ray) {
            return Excuse::Edge;
        }
        if let Some(met) = oracle.meet(triangle, ray)
            && met.t >= ray.t_min - error
            && met.t <= ray.t_max + error
        {
            excuse = Excuse::Limit;
        }
    }
    excuse
}

/// Between which `t` the corners of the triangle lie along the ray.
fn t_range(oracle: &Oracle, triangle: u32, ray: &OracleRay) -> (f64, f64) {
    let along = ray.direction / ray.direction.length_squared();
    let [a, b, c] = oracle.corners(triangle).map(|corner| (corner - ray.origin).dot(along));
    (a.min(b).min(c), a.max(b).max(c))
}
