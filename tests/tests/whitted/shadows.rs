//! The light that transmissive things let through to a surface: the rule of `shared/src/shadow.rs`.

use glam::{Vec3, vec3};
use oktant_shared::frame::Frame;
use oktant_shared::light::Light;
use oktant_shared::material::Material;
use oktant_shared::ray::Ray;
use oktant_shared::shadow::MAX_SHADOW_SURFACES;
use oktant_shared::whitted::Traced;
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
fn floor_under(stage: Stage, light: Light) -> Vec3 {
    traced_floor_under(stage, light).color
}

fn traced_floor_under(mut stage: Stage, light: Light) -> Traced {
    let floor = stage.material(matte(Vec3::ONE));
    stage.plane(Vec3::ZERO, Vec3::Y, floor);
    stage.model.lights.push(light);
    let scene = stage.build();
    let eye = vec3(0.02, 0.05, 0.01);
    let frame = Frame {
        depth: 0,
        ..frame(&scene, camera(eye, Vec3::ZERO, 40.0, 8, 8))
    };
    see(&scene, &frame, &Ray::new(eye, -eye))
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

/// Oracle: the rule, the transmission to the power of the surfaces, and nothing beyond [`MAX_SHADOW_SURFACES`], where what
/// is missing counts as cut. Open sheets, and planes that each begin another medium. Tolerance: 1e-5.
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
                        let medium = stage.material(Material {
                            priority: i,
                            ..tinted()
                        });
                        stage.plane(Vec3::Y * height, Vec3::NEG_Y, medium);
                    } else {
                        let corner = vec3(-1.0, height, 1.3);
                        stage.mesh(&quad(corner, Vec3::X * 2.3, Vec3::Z * -2.1), pane);
                    }
                }
                let behind = TINT.powf(count.min(MAX_SHADOW_SURFACES) as f32);
                let is_cut = count > MAX_SHADOW_SURFACES;
                let expected = if is_cut { Vec3::ZERO } else { behind };
                let traced = traced_floor_under(stage, light);
                let seen = traced.color;
                assert!(close(seen, expected), "{count} panes: {seen} and {expected}");
                let cut = if is_cut { behind } else { Vec3::ZERO };
                let off = (traced.cut - cut.max_element()).abs();
                assert!(off <= 1e-5, "{count} panes: {} cut", traced.cut);
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

/// Oracle: Beer-Lambert over the way through what fills it. A block of ink from 1 to 4 above the floor with a clear sheet
/// in it, which displaces the ink where its priority is the higher one and is not there where it is the lower one; and
/// ink that reaches from the floor, the eye in it, up to 1.
#[test]
fn overlapping_media_absorb_by_their_priority() {
    let absorption = vec3(0.3, 0.1, 0.5);
    let ink = |priority: u32| Material {
        absorption,
        priority,
        ..tinted()
    };
    let sheet = |priority: u32| Material { priority, ..clear(1.5) };
    let across = |low: f32, high: f32| block(vec3(-1.0, low, -1.3), vec3(1.2, high, 1.1));
    for light in lights() {
        for (ink_priority, sheet_priority, way) in [(0, 1, 2.8), (1, 0, 3.0)] {
            let mut stage = Stage::default();
            let (ink, sheet) = (stage.material(ink(ink_priority)), stage.material(sheet(sheet_priority)));
            stage.mesh(&across(1.0, 4.0), ink);
            stage.mesh(&across(3.6, 3.8), sheet);
            // Each boundary of the ink is multiplied with its own material's transmission, the sheet's with 1.
            let expected = TINT.powf(2.0) * (-absorption * way).exp();
            let seen = floor_under(stage, light);
            assert!(close(seen, expected), "{way} of ink: {seen} and {expected}");
        }
        let mut stage = Stage::default();
        let ink = stage.material(ink(0));
        stage.mesh(&across(-1.0, 1.0), ink);
        let seen = floor_under(stage, light);
        let eye = vec3(0.02, 0.05, 0.01).length();
        let expected = TINT * (-absorption * (1.0 + eye)).exp();
        assert!(close(seen, expected), "from within: {seen} and {expected}");
    }
}

/// A light that lies in a surface is not hidden by it. Oracle: the floor without the surface. At many distances and
/// sizes, lights and points at random, lamps flush with their ceiling.
#[test]
fn lights_in_surfaces_shine() {
    let mut random = fastrand::Rng::with_seed(5);
    let mut unit = move || random.f32() * 2.0 - 1.0;
    for i in 0..3_000 {
        let scale = 10.0_f32.powi(i % 7 - 3);
        let height = (unit() + 1.5) * scale;
        let offset = vec3(unit(), 0.0, unit()) * scale;
        let see_floor = |has_ceiling: bool, has_glass: bool| {
            let mut stage = Stage::default();
            let wall = stage.material(matte(Vec3::ONE));
            let pane = stage.material(tinted());
            // The floor is a mesh too: two large triangles.
            let far = 40.0 * scale;
            stage.mesh(
                &quad(vec3(-far, 0.0, far), Vec3::X * (2.0 * far), Vec3::Z * (-2.0 * far)),
                wall,
            );
            if has_ceiling {
                let corner = vec3(-far, height, -far);
                stage.mesh(&quad(corner, Vec3::X * (2.0 * far), Vec3::Z * (2.0 * far)), wall);
            }
            if has_glass {
                // Somewhere else: shadow rays then look at what they hit.
                stage.mesh(&quad(Vec3::splat(-far), Vec3::X * scale, Vec3::Y * scale), pane);
            }
            stage.model.lights.push(point_light(vec3(0.0, height, 0.0), Vec3::ONE));
            let scene = stage.build();
            let eye = offset + Vec3::Y * (0.4 * height);
            let frame = Frame {
                depth: 0,
                ..frame(&scene, camera(eye, offset, 40.0, 8, 8))
            };
            see(&scene, &frame, &Ray::new(eye, offset * 1.1 - eye)).color
        };
        let open = see_floor(false, false);
        assert!(open.x > 0.1);
        for has_glass in [false, true] {
            assert_eq!(see_floor(true, has_glass), open, "case {i}, glass {has_glass}");
        }
    }
}
