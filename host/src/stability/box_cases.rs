//! Rays and boxes.

use super::meshes::of_corners;
use crate::oracle::{Oracle, OracleRay};
use glam::Vec3;
use oktant_shared::aabb::Aabb;
use oktant_shared::ray::Ray;

/// A ray, a box, and whether they meet.
pub struct Case {
    /// The ray.
    pub ray: Ray,
    /// The box.
    pub aabb: Aabb,
    /// Whether they meet.
    pub meets: bool,
}

/// From 0 to 1.
pub const UNIT: Aabb = Aabb {
    low: Vec3::ZERO,
    high: Vec3::ONE,
};

/// Rays that meet [`UNIT`].
pub fn hits(rays: &[(Vec3, Vec3)]) -> Vec<Case> {
    let case = |(origin, direction): &(Vec3, Vec3)| Case {
        ray: Ray::new(*origin, *direction),
        aabb: UNIT,
        meets: true,
    };
    rays.iter().map(case).collect()
}

/// Half of the rays meet their box; the others pass it, by more than rounding, or have it behind them.
pub fn beside(count: usize) -> Vec<Case> {
    let mut random = fastrand::Rng::with_seed(21);
    let mut point = move || Vec3::from_array([(); 3].map(|()| 2.0 * random.f32() - 1.0));
    let mut cases = Vec::with_capacity(count);
    while cases.len() < count {
        let (low, high) = (point(), point());
        let aabb = Aabb {
            low: low.min(high),
            high: low.max(high),
        };
        let (origin, target) = (point(), point());
        let ray = Ray::new(origin, target - origin);
        // In f64, with a margin that leaves out what is close.
        let meets = |margin: f64| {
            let (mut enter, mut exit) = (0.0_f64, f64::INFINITY);
            for axis in 0..3 {
                let (from, along) = (f64::from(ray.origin[axis]), f64::from(ray.direction[axis]));
                let a = (f64::from(aabb.low[axis]) - margin - from) / along;
                let b = (f64::from(aabb.high[axis]) + margin - from) / along;
                enter = enter.max(a.min(b));
                exit = exit.min(a.max(b));
            }
            enter <= exit
        };
        if meets(-1e-5) == meets(1e-5) {
            cases.push(Case {
                ray,
                aabb,
                meets: meets(0.0),
            });
        }
    }
    cases
}

/// Which of the rays meet their box, the oracle decides exactly, of two triangles in its place.
pub fn edges_of_flat_boxes(count: usize) -> Vec<Case> {
    let mut random = fastrand::Rng::with_seed(22);
    let mut point = move || Vec3::from_array([(); 3].map(|()| 2.0 * random.f32() - 1.0));
    let case = || {
        let (a, b, along) = (point(), point(), point());
        let (low, high) = (a.min(b).with_z(a.z), a.max(b).with_z(a.z));
        let target = Vec3::new(low.x, low.y + (high.y - low.y) * (0.5 + 0.5 * along.y), low.z);
        let origin = point() * 100.0_f32.powf(along.x.abs());
        // Scaled, else the difference of plane and origin is the direction itself, and all quotients are 1.
        let ray = Ray::new(origin, (target - origin).normalize());
        let corner = |x: f32, y: f32| [x, y, low.z];
        let [a, b, c, d] =
            [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)].map(|(x, y)| corner(x, y));
        let oracle = Oracle::new(&of_corners(&[[a, b, c], [a, c, d]]));
        let exact = OracleRay::new(ray.origin, ray.direction, 0.0, f32::INFINITY);
        oracle.any(&exact).then_some(Case {
            ray,
            aabb: Aabb { low, high },
            meets: true,
        })
    };
    std::iter::repeat_with(case).take(count).flatten().collect()
}
