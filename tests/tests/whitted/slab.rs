//! Glass shifts what is behind it, and water in a glass does so by the sum of its layers.

use super::layers::{Layer, through};
use glam::{DVec3, Vec3, vec3};
use oktant::scene::Scene;
use oktant_shared::frame::Frame;
use oktant_shared::ray::Ray;
use oktant_tests::meshes::block;
use oktant_tests::stage::{Stage, camera, clear, frame, glowing, leaves_towards, see};
use std::sync::Arc;

/// Depth of the wall behind the slab, which tells where it is seen.
const WALL: f32 = -0.5;
/// What the wall's texture repeats after; its middle is where rays enter the slab.
const PERIOD: f32 = 32.0;

fn scene(thickness: Option<f32>, ior: f32) -> (Arc<Scene>, Frame) {
    let mut stage = Stage::default();
    let texture = stage.position_texture(PERIOD);
    let wall = stage.material(glowing(texture));
    let glass = stage.material(clear(ior));
    stage.plane(Vec3::Z * WALL, Vec3::Z, wall);
    if let Some(thickness) = thickness {
        let (middle, half) = (PERIOD / 2.0, 1.0 + 2.0 * thickness);
        let (low, high) = (middle - half, middle + half);
        stage.mesh(&block(vec3(low, low, 0.0), vec3(high, high, thickness)), glass);
    }
    stage.model.ambient = Vec3::ONE;
    let scene = stage.build();
    let frame = frame(&scene, camera(Vec3::Z * 9.0, Vec3::ZERO, 40.0, 8, 8));
    (scene, frame)
}

/// Oracle: the shift `thickness * sin a * (1 - cos a / sqrt(ior^2 - sin^2 a))` across the ray, read as a distance along
/// the wall. Tolerance: 1e-5 units and as much for each half of the thickness: roundings on the wall at 16 units, and of places on
/// the slab's triangles.
#[test]
fn a_slab_shifts_rays_by_the_analytic_amount() {
    let mut largest = 0.0_f64;
    for ior in [1.33_f32, 1.5, 2.42] {
        for thickness in [0.01_f32, 0.25, 1.0, 2.0] {
            let (with, frame_with) = scene(Some(thickness), ior);
            let (without, frame_without) = scene(None, ior);
            for degrees in [0.0_f32, 5.0, 20.0, 45.0, 60.0, 70.0] {
                for turn in [0.0_f32, 0.9, 4.0] {
                    let (sin, cos) = degrees.to_radians().sin_cos();
                    let aside = vec3(turn.cos(), turn.sin(), 0.0);
                    let direction = (aside * sin - Vec3::Z * cos).normalize();
                    let entry = vec3(PERIOD / 2.0, PERIOD / 2.0, thickness);
                    let ray = Ray::new(entry - direction * 3.0, direction);
                    let place = |scene: &Scene, frame: &Frame| {
                        let [x, y] = Stage::position(see(scene, frame, &ray).color, PERIOD);
                        DVec3::new(x, y, 0.0)
                    };
                    let shift = place(&without, &frame_without) - place(&with, &frame_with);
                    let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
                    let across = f64::from(thickness) * sin * (1.0 - cos / (f64::from(ior).powi(2) - sin * sin).sqrt());
                    let expected = aside.as_dvec3() * (across / cos);
                    assert!(
                        shift.distance(expected) <= 1e-5 * (1.0 + 2.0 * f64::from(thickness)),
                        "ior {ior}, thickness {thickness}, {degrees} degrees: {shift} and {expected}"
                    );
                    largest = largest.max(expected.length());
                }
            }
        }
    }
    assert!(largest > 2.0, "the shifts are large against the tolerance");
}

/// Oracle: what leaves a slab goes on as it came. Tolerance: 2e-6, as of reading a direction.
#[test]
fn a_slab_turns_no_ray() {
    let mut stage = Stage::default();
    stage.material(clear(1.5));
    stage.mesh(&block(vec3(-90.0, -90.0, 0.0), vec3(100.0, 100.0, 1.0)), 0);
    let scene = stage.build();
    let frame = frame(&scene, camera(Vec3::Z * 9.0, Vec3::ZERO, 40.0, 8, 8));
    for tenths in 0..800 {
        let (sin, cos) = (tenths as f32 / 10.0).to_radians().sin_cos();
        let direction = vec3(sin * 0.6, sin * 0.8, -cos);
        let ray = Ray::new(vec3(1.0, 2.0, 4.0), direction);
        let away = leaves_towards(&scene, &frame, &ray).distance(direction.as_dvec3());
        assert!(away < 2e-6, "{tenths} tenths of a degree: off by {away}");
    }
}

/// The layers of the oracle of other tests, held against the formula for a slab.
#[test]
fn the_oracle_agrees_with_the_formula() {
    let direction = DVec3::new(0.6, 0.0, -0.8);
    let layer = |z: f64, from, to| Layer {
        point: DVec3::Z * z,
        normal: DVec3::Z,
        from,
        to,
    };
    let (origin, away) = through(DVec3::Z * 2.0, direction, &[layer(1.0, 1.0, 1.5), layer(0.0, 1.5, 1.0)]);
    let across = 0.6 * (1.0 - 0.8 / (1.5_f64 * 1.5 - 0.36).sqrt());
    // Where it would have been without the slab.
    let straight = DVec3::Z * 2.0 + direction * 2.5;
    assert!((straight.x - origin.x - across / 0.8).abs() < 1e-12);
    assert!(away.distance(direction) < 1e-12);
}
