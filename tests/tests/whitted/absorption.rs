//! Beer-Lambert: what a medium leaves of the light falls exponentially with the way through it.

use glam::{DVec3, Vec3, vec3};
use oktant::scene::Scene;
use oktant_shared::environment::Environment;
use oktant_shared::material::Material;
use oktant_shared::ray::Ray;
use oktant_tests::meshes::block;
use oktant_tests::stage::{Stage, camera, clear, directional_light, frame, matte, point_light, see};
use std::sync::Arc;

const THICKNESSES: [f32; 6] = [1e-3, 0.1, 0.7, 1.0, 3.5, 12.0];
const ABSORPTIONS: [Vec3; 4] = [
    vec3(0.1, 0.5, 2.0),
    vec3(0.0, 1.0, 0.0),
    vec3(1e-3, 0.02, 30.0),
    vec3(7.0, 0.3, 1e6),
];

/// A block whose top is at y = 0, four times as wide to each side as it is thick: rays start off the surface of its
/// triangles by some 1e-6 of their size, which is missing in their way.
fn slab(stage: &mut Stage, thickness: f32, absorption: Vec3, ior: f32) {
    let material = stage.material(Material {
        absorption,
        ..clear(ior)
    });
    let aside = 4.0 * thickness;
    stage.mesh(
        &block(vec3(-aside, -thickness, -aside), vec3(aside, 0.0, aside)),
        material,
    );
}

fn left(absorption: Vec3, way: f64) -> DVec3 {
    (-absorption.as_dvec3() * way).exp()
}

fn is_close(seen: Vec3, expected: DVec3) -> bool {
    (seen.as_dvec3() - expected).abs().max_element() <= 1e-5
}

fn in_white(thickness: f32, absorption: Vec3, ior: f32) -> Arc<Scene> {
    let mut stage = Stage::default();
    slab(&mut stage, thickness, absorption, ior);
    stage.model.environment = Environment::constant(Vec3::ONE);
    stage.build()
}

/// Oracle: `exp(-absorption * way)` in f64, the way by Snell's law. Tolerance: 1e-5 of full light.
#[test]
fn light_through_a_block_falls_exponentially() {
    for thickness in THICKNESSES {
        for absorption in ABSORPTIONS {
            for ior in [1.0_f32, 1.5] {
                let scene = in_white(thickness, absorption, ior);
                let frame = frame(&scene, camera(vec3(0.0, 40.0, 5.0), Vec3::ZERO, 40.0, 8, 8));
                for degrees in [0.0_f32, 30.0, 70.0] {
                    let (sin, cos) = degrees.to_radians().sin_cos();
                    let target = vec3(0.01, 0.0, 0.02) * thickness;
                    let direction = vec3(sin, -cos, 0.0);
                    let ray = Ray::new(target - direction * (2.0 * thickness), direction * 3.0);
                    let sine_inside = f64::from(degrees).to_radians().sin() / f64::from(ior);
                    let way = f64::from(thickness) / (1.0 - sine_inside * sine_inside).sqrt();
                    let seen = see(&scene, &frame, &ray).color;
                    let expected = left(absorption, way);
                    assert!(
                        is_close(seen, expected),
                        "thickness {thickness}, absorption {absorption}, {degrees} degrees: {seen} and {expected}"
                    );
                }
            }
        }
    }
}

/// The camera stands in the medium: what is left is counted from there. Oracle and tolerance as above.
#[test]
fn light_to_a_camera_inside_falls_exponentially() {
    for absorption in ABSORPTIONS {
        let scene = in_white(10.0, absorption, 1.5);
        for depth in [1e-3_f32, 0.4, 5.0] {
            let frame = frame(&scene, camera(Vec3::NEG_Y * depth, Vec3::ZERO, 40.0, 8, 8));
            for degrees in [0.0_f32, 20.0, 40.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let ray = Ray::new(frame.camera.eye, vec3(sin, cos, 0.0));
                let seen = see(&scene, &frame, &ray).color;
                let expected = left(absorption, f64::from(depth) / f64::from(degrees).to_radians().cos());
                assert!(
                    is_close(seen, expected),
                    "{depth} deep, absorption {absorption}, {degrees} degrees: {seen} and {expected}"
                );
            }
        }
    }
}

/// A floor lit through the block. Oracle: Lambert's cosine times `exp(-absorption * way)`, straight through; tolerance
/// as above.
#[test]
fn shadow_rays_are_absorbed_exponentially() {
    for thickness in THICKNESSES {
        for absorption in ABSORPTIONS {
            for degrees in [0.0_f32, 35.0, 60.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let towards = vec3(sin, cos, 0.0);
                let point = vec3(0.0, -thickness * 1.2, 0.1 * thickness);
                for light in [
                    directional_light(towards, Vec3::ONE),
                    point_light(point + towards * (4.0 * thickness / cos), Vec3::ONE),
                ] {
                    let mut stage = Stage::default();
                    slab(&mut stage, thickness, absorption, 1.5);
                    let floor = stage.material(matte(Vec3::ONE));
                    stage.plane(point, Vec3::Y, floor);
                    stage.model.lights.push(light);
                    let scene = stage.build();
                    let eye = point + vec3(0.0, 0.1, 0.05) * thickness;
                    let frame = frame(&scene, camera(eye, point, 40.0, 8, 8));
                    let seen = see(&scene, &frame, &Ray::new(eye, point - eye)).color;
                    let cosine = f64::from(degrees).to_radians().cos();
                    let expected = left(absorption, f64::from(thickness) / cosine) * cosine;
                    assert!(
                        is_close(seen, expected),
                        "thickness {thickness}, absorption {absorption}, {degrees} degrees: {seen} and {expected}"
                    );
                }
            }
        }
    }
}
