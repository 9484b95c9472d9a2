//! Glass as it is often written.

use super::rounding::Plain;
use super::triangle_tests::{MollerTrumbore, Slack};
use crate::scene::Scene;
use glam::Vec3;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::triangle_test::TriangleTest;

/// Snell's law without a look at what is below the root; `eta` is the index before over the index behind.
pub fn refracted(direction: Vec3, normal: Vec3, eta: f32) -> Vec3 {
    let cosine = -normal.dot(direction);
    let left = 1.0 - eta * eta * (1.0 - cosine * cosine);
    direction * eta + normal * (eta * cosine - left.sqrt())
}

/// How many triangles a ray crosses by a test that counts edges twice.
pub fn crossings(scene: &Scene, ray: &Ray) -> usize {
    let prepared = PreparedRay::new(ray);
    let test = MollerTrumbore::<Plain, Slack>::prepare(&prepared);
    let crosses = |triangle: &&oktant_shared::triangle::Triangle| {
        let crossing = test.crossing(triangle);
        crossing.crosses && crossing.t >= 0.0
    };
    scene.triangles.iter().filter(crosses).count()
}
