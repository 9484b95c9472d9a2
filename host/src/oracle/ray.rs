//! Rays and hits of the oracle.

use glam::{DVec3, Vec3};

/// A half-line `origin + t * direction`, searched for `t_min <= t <= t_max`, both ends included.
///
/// The direction need not have length 1: `t` counts in lengths of it. A ray hits nothing if a component of its origin
/// or direction is not finite, if its direction is zero, if an end is NaN, or if `t_min > t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OracleRay {
    /// Where the ray starts, scene units.
    pub origin: DVec3,
    /// Where the ray goes, scene units per `t`.
    pub direction: DVec3,
    /// Smallest `t` that counts as a hit, in lengths of `direction`.
    pub t_min: f64,
    /// Largest `t` that counts as a hit, in lengths of `direction`; infinity where unbounded.
    pub t_max: f64,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OracleHit {
    /// Where along the ray, in lengths of its direction.
    pub t: f64,
    /// Index into the mesh's triangles.
    pub triangle: u32,
    /// Barycentric weight of the triangle's second corner, 0 to 1.
    pub u: f64,
    /// Barycentric weight of the triangle's third corner, 0 to 1.
    pub v: f64,
}

impl OracleRay {
    /// The ray that an f32 tracer was given: every f32 is exact in f64.
    pub fn new(origin: Vec3, direction: Vec3, t_min: f32, t_max: f32) -> Self {
        OracleRay {
            origin: origin.as_dvec3(),
            direction: direction.as_dvec3(),
            t_min: f64::from(t_min),
            t_max: f64::from(t_max),
        }
    }

    /// Whether `t` counts as a hit.
    pub fn contains(&self, t: f64) -> bool {
        self.t_min <= t && t <= self.t_max
    }

    /// Whether the ray can hit anything at all.
    pub fn is_valid(&self) -> bool {
        self.origin.is_finite()
            && self.direction.is_finite()
            && self.direction != DVec3::ZERO
            && self.t_min <= self.t_max
    }

    /// The axis along which the ray goes fastest.
    pub(super) fn dominant_axis(&self) -> usize {
        self.direction.abs().max_position()
    }

    /// The part of `point - origin` that is perpendicular to the ray.
    pub(super) fn offset_of(&self, point: DVec3) -> DVec3 {
        // Scaled first, so that neither tiny nor huge directions leave the range of f64 when squared.
        let direction = (self.direction / self.direction.abs().max_element()).normalize();
        let from_origin = point - self.origin;
        from_origin - direction * direction.dot(from_origin)
    }
}

/// The lesser hit: the nearer one, of equal `t` the one with the lower triangle id.
pub(super) fn nearer(a: Option<OracleHit>, b: Option<OracleHit>) -> Option<OracleHit> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if (b.t, b.triangle) < (a.t, a.triangle) { b } else { a }),
        (a, b) => a.or(b),
    }
}
