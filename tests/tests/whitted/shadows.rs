//! The light that transmissive things let through to a surface: the rule of `shared/src/shadow.rs`.

use glam::{Vec3, vec3};
use oktant_shared::frame::Frame;
use oktant_shared::light::Light;
use oktant_shared::material::Material;
use oktant_shared::ray::Ray;
use oktant_shared::shadow::MAX_SHADOW_SURFACES;
use oktant_tests::meshes::{block, icosphere, quad};
use oktant_tests::stage::{Stage, black, camera, clear, directional_light, frame, matte, point_light, see};

const TINT: Vec3 = vec3(0.9, 0.5, 0.99);

fn tinted() -> Material {
    Material {
        transmission: TINT,
        ..clear(1.5)
    }
}

/// The colour of a white floor at the origin, below what the stage holds.
fn floor_under(mut stage: Stage, light: Light) -> Vec3 {
    let floor = stage.material(matte(Vec3::ONE));
    stage.plane(Vec3::ZERO, Vec3::Y, floor);
    stage.model.lights.push(light);
    let scene = stage.build();
    let eye = vec3(0.02, 0.05, 0.01);
    let frame = Frame {
        depth: 0,
        ..frame(&scene, camera(eye, Vec3::ZERO, 40.0, 8, 8))
    };
    see(&scene, &frame, &Ray::new(eye, -eye)).color
}

fn lights() -> [Light; 2] {
    [
        directional_light(Vec3::Y, Vec3::ONE),
        point_light(vec3(0.0, 50.0, 0.0), Vec3::ONE),
    ]
}

fn close(seen: Vec3, expected: Vec3) -> bool {
    (seen - expected).abs().max_element() <= 1e-5
}

/// Oracle: the rule, the transmission to the power of the surfaces, and nothing beyond [`MAX_SHADOW_SURFACES`].
/// Tolerance: 1e-5.
#[test]
fn each_surface_leaves_its_part() {
    for count in 0..=MAX_SHADOW_SURFACES + 2 {
        for as_planes in [false, true] {
            for light in lights() {
                let mut stage = Stage::default();
                let pane = stage.material(tinted());
                for i in 0..count {
                    let height = 0.5 + i as f32 * 0.25;
                    if as_planes {
                        // Some face up and some down.
                        let normal = if i % 3 == 0 { Vec3::NEG_Y } else { Vec3::Y };
                        stage.plane(Vec3::Y * height, normal, pane);
                    } else {
                        let corner = vec3(-1.0, height, 1.3);
                        stage.mesh(&quad(corner, Vec3::X * 2.3, Vec3::Z * -2.1), pane);
                    }
                }
                let expected = if count > MAX_SHADOW_SURFACES {
                    Vec3::ZERO
                } else {
                    TINT.powf(count as f32)
                };
                let seen = floor_under(stage, light);
                assert!(close(seen, expected), "{count} panes: {seen} and {expected}");
            }
        }
    }
}

/// Oracle: as above, with Beer-Lambert over the chord of each body. A ball and a block, one above the other.
#[test]
fn bodies_absorb_and_do_not_bend() {
    let absorption = vec3(0.3, 0.1, 1.0);
    for light in lights() {
        let mut stage = Stage::default();
        let glass = stage.material(Material { absorption, ..tinted() });
        stage.mesh(&block(vec3(-1.0, 1.0, -1.3), vec3(1.2, 1.7, 1.1)), glass);
        let mut sphere = icosphere(3);
        for position in &mut sphere.positions {
            *position += vec3(0.03, 3.5, 0.02);
        }
        // Where the y axis meets the planes of the upper and of the lower half first, it meets the ball.
        let height = |sign: f32| {
            let on_axis = |[a, b, c]: [Vec3; 3]| {
                let normal = (b - a).cross(c - a);
                (normal.y * sign > 0.0).then(|| normal.dot(a) / normal.y)
            };
            let corners = sphere
                .triangles
                .iter()
                .map(|t| t.map(|corner| sphere.positions[corner as usize]));
            let heights = corners.filter_map(on_axis).map(|height| (height - 3.5) * sign);
            heights.fold(f32::INFINITY, f32::min)
        };
        let chord = height(1.0) + height(-1.0);
        assert!((1.9..2.0).contains(&chord));
        stage.mesh(&sphere, glass);
        let expected = TINT.powf(4.0) * (-absorption * (0.7 + chord)).exp();
        let seen = floor_under(stage, light);
        assert!(close(seen, expected), "{seen} and {expected}");
    }
}

/// Oracle: what is opaque casts a full shadow, behind glass too; what is behind the light casts none.
#[test]
fn only_what_is_in_between_counts() {
    let pane = |stage: &mut Stage, height: f32, material: u32| {
        stage.mesh(&quad(vec3(-1.0, height, 1.3), Vec3::X * 2.3, Vec3::Z * -2.1), material);
    };
    let stage = |opaque_at: f32| {
        let mut stage = Stage::default();
        let glass = stage.material(tinted());
        let wall = stage.material(black());
        pane(&mut stage, 0.5, glass);
        pane(&mut stage, 0.8, glass);
        pane(&mut stage, opaque_at, wall);
        stage
    };
    for light in lights() {
        assert_eq!(floor_under(stage(0.65), light), Vec3::ZERO);
        assert_eq!(floor_under(stage(2.0), light), Vec3::ZERO);
    }
    let light = |height: f32| point_light(Vec3::Y * height, Vec3::ONE);
    for (height, surfaces) in [(0.3, 0), (0.6, 1), (1.1, 2), (1.999, 2)] {
        let seen = floor_under(stage(2.0), light(height));
        assert!(close(seen, TINT.powf(surfaces as f32)), "light at {height}: {seen}");
    }
}
