//! The light of a point falls off with the square of the distance.

use glam::{DVec3, Vec3, vec3};
use oktant_shared::frame::Frame;
use oktant_shared::light::Light;
use oktant_shared::ray::Ray;
use oktant_tests::meshes::quad;
use oktant_tests::stage::{Stage, camera, frame, matte, point_light, see};

/// A lit floor, as a plane and as triangles. Oracle: Lambert's cosine over the squared distance, bounded near the light;
/// or the cosine alone for a light without falloff. Tolerance: 1e-5 relative.
#[test]
fn light_on_a_floor_falls_off_with_the_square_of_the_distance() {
    const LEAST: f32 = 0.05;
    let mut plane = Stage::default();
    plane.material(matte(Vec3::ONE));
    plane.plane(Vec3::ZERO, Vec3::Y, 0);
    let mut triangles = Stage::default();
    triangles.material(matte(Vec3::ONE));
    triangles.mesh(&quad(vec3(-2.0, 0.0, 2.0), Vec3::X * 4.0, Vec3::Z * -4.0), 0);
    for stage in [plane, triangles] {
        let scene = stage.build();
        let eye = vec3(0.3, 0.8, -0.6);
        let target = vec3(0.2, 0.0, 0.1);
        let dark = frame(&scene, camera(eye, target, 40.0, 8, 8));
        for distance in [0.01_f32, 0.05, 0.3, 1.0, 7.0, 100.0, 3e4] {
            for degrees in [0.0_f32, 40.0, 80.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let position = target + vec3(sin * 0.6, cos, sin * 0.8) * distance;
                let offset = (position - target).as_dvec3();
                let cosine = offset.normalize().dot(DVec3::Y);
                let color = vec3(1.0, 20.0, 0.003);
                let shown = |falloff_radius| {
                    let light = Light {
                        falloff_radius,
                        ..point_light(position, color)
                    };
                    let frame = Frame { light, ..dark };
                    see(&scene, &frame, &Ray::new(eye, target - eye)).color.as_dvec3()
                };
                let squared = offset.length_squared().max(f64::from(LEAST).powi(2));
                for (seen, expected) in [
                    (shown(LEAST), color.as_dvec3() * (cosine / squared)),
                    (shown(0.0), color.as_dvec3() * cosine),
                ] {
                    // Rays start up to 6e-6 off the floor of 4 units, which counts where the light is low.
                    let tolerance = expected * (1e-5 + 6e-6 / offset.y);
                    assert!(
                        (seen - expected).abs().cmple(tolerance).all(),
                        "{distance} away at {degrees} degrees: {seen} and {expected}"
                    );
                }
            }
        }
    }
}
