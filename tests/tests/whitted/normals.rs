//! Interpolated normals: nothing is reflected into the surface, and no shadow shows its triangles.

use glam::{Vec3, vec3};
use oktant::mesh::Mesh;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant_shared::environment::Environment;
use oktant_shared::frame::Frame;
use oktant_shared::material::{Material, SMOOTH_NORMALS};
use oktant_shared::medium::Media;
use oktant_shared::optics::reflected;
use oktant_shared::ray::Ray;
use oktant_shared::shading::{Viewer, shade};
use oktant_shared::surface::Surface;
use oktant_shared::texture::{Texture, WAVES};
use oktant_shared::trace::closest_hit;
use oktant_shared::traversal::Standard;
use oktant_shared::variant::EVERYTHING;
use oktant_shared::whitted::Traced;
use oktant_tests::meshes::{ball, turned_inside_out};
use oktant_tests::stage::{Stage, camera, directional_light, frame, matte, mirror, see};
use std::sync::Arc;

fn unit(random: &mut fastrand::Rng) -> Vec3 {
    loop {
        let v = Vec3::from_array(std::array::from_fn(|_| random.f32() * 2.0 - 1.0));
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// The coarse ball on which all of this shows: 16 slices, 8 stacks.
fn coarse() -> Mesh {
    ball(Vec3::ZERO, 1.0, 16, 8)
}

fn scene(mesh: &Mesh, material: Material) -> (Arc<Scene>, Frame) {
    let mut stage = Stage::default();
    stage.model.textures.push(Texture {
        first: 0,
        width: 0,
        height: 0,
        kind: WAVES,
        repeats: 5.0,
        reserved: [0; 3],
    });
    stage.material(material);
    stage.mesh(mesh, 0);
    let scene = stage.build();
    let frame = frame(&scene, camera(Vec3::Z * 3.0, Vec3::ZERO, 40.0, 8, 8));
    (scene, frame)
}

fn smooth() -> Material {
    Material {
        flags: SMOOTH_NORMALS,
        ..matte(Vec3::ONE)
    }
}

/// Oracle: the plane of the triangle. Of 100,000 random rays at each ball none is reflected below it, and no normal faces
/// away; with normals as they should be, against the order of the corners, at random, and with bumps steeper than walls.
#[test]
fn nothing_is_reflected_below_the_surface() {
    let mut random = fastrand::Rng::with_seed(6);
    let mut shaken = coarse();
    for normal in &mut shaken.normals {
        *normal = unit(&mut random);
    }
    let mut against = coarse();
    against.normals = against.normals.iter().map(|normal| -*normal).collect();
    let mut bumpy = coarse();
    bumpy.coordinates = bumpy.positions.iter().map(|p| p.truncate()).collect();
    let bumps = Material {
        bump: 0,
        bump_height: 3.0,
        ..smooth()
    };
    for (name, mesh, material) in [
        ("round", coarse(), smooth()),
        ("against the corners", against, smooth()),
        ("at random", shaken, smooth()),
        ("bumpy", bumpy, bumps),
    ] {
        let (scene, frame) = scene(&mesh, material);
        let world = scene.world();
        let mut hits = 0;
        let mut bent = 0;
        for _ in 0..100_000 {
            let eye = unit(&mut random) * 2.0;
            let ray = Ray::new(eye, unit(&mut random) * 0.99 - eye);
            let hit = closest_hit::<Standard, EVERYTHING>(&frame, &world, &ray);
            if !hit.is_hit() {
                continue;
            }
            let surface = Surface::new::<EVERYTHING>(&frame, &world, &ray, &hit);
            let view = -ray.direction.normalize();
            let onwards = reflected(-view, surface.normal);
            hits += 1;
            assert!(onwards.dot(surface.side) > 0.0, "{name}: {ray:?} goes below");
            assert!(
                surface.normal.dot(view) > 0.0,
                "{name}: {ray:?} sees the normal from behind"
            );
            assert!((surface.normal.length() - 1.0).abs() < 1e-5);
            bent += u32::from(onwards.dot(surface.side) < 1.1e-3);
        }
        println!("{name}: {hits} hits, {bent} normals bent");
        assert!(hits > 50_000 && bent > 10);
    }
}

/// What a point of the ball shows, and what it would where shadow rays started on the triangle.
struct Shown {
    triangle: u32,
    /// Lambert's cosine of the interpolated normal.
    cosine: f32,
    /// Lambert's cosine of a perfect sphere.
    round: f32,
    lifted: f32,
    flat: f32,
}

fn shown(mesh: &Mesh, seed: u64) -> Vec<Shown> {
    let (scene, dark) = scene(mesh, smooth());
    let world = scene.world();
    let mut random = fastrand::Rng::with_seed(seed);
    let mut all = Vec::new();
    for _ in 0..40 {
        let towards = unit(&mut random);
        let frame = Frame {
            light: directional_light(towards, Vec3::ONE),
            ..dark
        };
        for _ in 0..2_000 {
            let eye = unit(&mut random) * 4.0;
            let ray = Ray::new(eye, unit(&mut random) * 0.9 - eye);
            let hit = closest_hit::<Standard, EVERYTHING>(&frame, &world, &ray);
            if !hit.is_hit() {
                continue;
            }
            let surface = Surface::new::<EVERYTHING>(&frame, &world, &ray, &hit);
            let flat = Surface {
                shadow_origin: surface.front_origin(),
                is_lifted: false,
                ..surface
            };
            let viewer = Viewer {
                direction: -ray.direction.normalize(),
                weight: Vec3::ONE,
                media: Media::AIR,
                is_seen: false,
            };
            all.push(Shown {
                triangle: hit.triangle,
                cosine: surface.normal.dot(towards),
                round: surface.point.normalize().dot(towards).max(0.0),
                lifted: see(&scene, &frame, &ray).color.x,
                flat: shade::<Standard, EVERYTHING>(&frame, &world, &flat, &viewer, &mut { Traced::NOTHING }).x,
            });
        }
    }
    all
}

/// Oracle: a sphere, which casts no shadow on what faces the light. No point whose normal faces the light by more than
/// 0.05 is black, which without lifting the origins of shadow rays many are; and the mean error against a perfect sphere
/// falls. With normals turned against the order of the corners, the same.
#[test]
fn no_triangle_of_a_coarse_ball_is_black() {
    let mut against = coarse();
    against.normals = against.normals.iter().map(|normal| -*normal).collect();
    let mut inverted = turned_inside_out(coarse());
    inverted.normals = coarse().normals;
    for (name, mesh) in [
        ("round", coarse()),
        ("normals inwards", against),
        ("corners inwards", inverted),
    ] {
        let all = shown(&mesh, 7);
        let facing = all.iter().filter(|shown| shown.cosine > 0.05).count();
        let black = |value: fn(&Shown) -> f32| {
            let black: Vec<_> = all
                .iter()
                .filter(|shown| shown.cosine > 0.05 && value(shown) == 0.0)
                .collect();
            let mut triangles: Vec<u32> = black.iter().map(|shown| shown.triangle).collect();
            triangles.sort_unstable();
            triangles.dedup();
            (black.len(), triangles.len())
        };
        let error = |value: fn(&Shown) -> f32| {
            let sum: f32 = all.iter().map(|shown| (value(shown) - shown.round).abs()).sum();
            sum / all.len() as f32
        };
        let (lifted, flat) = (black(|shown| shown.lifted), black(|shown| shown.flat));
        let (error_lifted, error_flat) = (error(|shown| shown.lifted), error(|shown| shown.flat));
        println!(
            "{name}: of {facing} points that face the light {} are black, on {} triangles; without lifting {} on {}; \
             mean error {error_lifted:.5}, without lifting {error_flat:.5}",
            lifted.0, lifted.1, flat.0, flat.1
        );
        assert!(facing > 10_000);
        assert_eq!(lifted.0, 0);
        assert!(flat.0 > 100, "the test sees black triangles where they are");
        assert!(error_lifted < 0.9 * error_flat);
    }
}

/// Oracle: symmetry. A mesh whose normals point inwards is lit like one whose normals point outwards.
#[test]
fn normals_against_the_corners_shade_alike() {
    let mut against = coarse();
    against.normals = against.normals.iter().map(|normal| -*normal).collect();
    for (one, other) in shown(&coarse(), 8).iter().zip(shown(&against, 8)) {
        assert!((one.lifted - other.lifted).abs() < 1e-6);
    }
    let towards = vec3(0.3, 0.5, 1.0);
    let color = |mesh: &Mesh| {
        let (scene, dark) = scene(mesh, smooth());
        let frame = Frame {
            light: directional_light(towards, Vec3::ONE),
            ..dark
        };
        see(&scene, &frame, &Ray::new(Vec3::Z * 3.0, Vec3::NEG_Z)).color.x
    };
    assert!(color(&against) > 0.8);
}

/// Oracle: colours are numbers, finite and not negative, and a mirror under a white sky is white. Triangles so thin that
/// in f32 they have no area, or one that is lost where the length of their normal is squared; each alone, hit by rays
/// that are aimed at points of it.
#[test]
fn needles_have_a_normal() {
    let mut random = fastrand::Rng::with_seed(9);
    let mut hits = 0;
    for i in 0..3_000 {
        let (a, along) = (unit(&mut random) * 0.5, unit(&mut random));
        let corners = if i % 2 == 0 {
            // Off the line by what rounding leaves.
            [a, a + along, a + along * random.f32()]
        } else {
            [Vec3::ZERO, Vec3::X, vec3(0.5, 10.0_f32.powi(-random.i32(8..18)), 0.0)]
        };
        let mesh = Mesh {
            positions: corners.to_vec(),
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let mut stage = Stage::default();
        stage.material(mirror());
        stage.mesh(&mesh, 0);
        stage.model.environment = Environment::constant(Vec3::ONE);
        let model = stage.model;
        let Ok(scene) = Scene::of_model(model, &StructureOptions::default(), &silent) else {
            // No area in f64 either.
            continue;
        };
        let frame = frame(&scene, camera(Vec3::Z * 3.0, Vec3::ZERO, 40.0, 8, 8));
        for _ in 0..4 {
            let (u, v) = (random.f32() / 2.0, random.f32() / 2.0);
            let target = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            let eye = if i % 2 == 0 {
                target + unit(&mut random)
            } else {
                target + Vec3::Z
            };
            let traced = see(&scene, &frame, &Ray::new(eye, target - eye));
            assert_eq!(traced.color, Vec3::ONE, "{corners:?}");
            hits += u32::from(traced.rays > 1);
        }
    }
    println!("{hits} hits of needles");
    assert!(hits > 3_000);
}
