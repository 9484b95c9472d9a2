//! The kernel's variants.

use super::{SCENES, farthest, gpu, model, rendered, scene, steps};
use glam::{Vec3, uvec2, vec3};
use oktant::backend::Backend;
use oktant::backend::gpu::GpuBackend;
use oktant::progress::silent;
use oktant::sampling::Samples;
use oktant::scene::Scene;
use oktant::view::View;
use oktant_shared::material::Material;
use oktant_shared::variant::{GLASS, IMAGE, LIGHTS, MATERIALS, MIRRORS, PLANES, TEXTURES, Variant};
use oktant_tests::meshes::{block, quad};
use oktant_tests::stage::{Stage, camera, clear, frame, matte, mirror, point_light};
use std::sync::Arc;

/// The variants that suffice a scene, the least first.
fn sufficient(scene: &Scene) -> Vec<Variant> {
    let all = Variant::ALL.into_iter();
    all.filter(|variant| variant.suffices(scene.needs)).collect()
}

/// Oracle: the variant that can everything, bit by bit.
#[test]
fn every_variant_renders_the_same_picture() {
    let mut rendered_by = [0; 4];
    for name in SCENES {
        let (model, view) = model(name);
        let scene = scene(model);
        let variants = sufficient(&scene);
        assert_eq!(variants[0], scene.variant, "{name}");
        rendered_by[scene.variant as usize] += 1;
        let frame = view.frame(&scene, 96, 72);
        let general = scene
            .clone()
            .rendered_by(Variant::Everything)
            .expect("it can everything");
        let wanted = rendered(&Arc::new(general), &frame);
        for variant in variants {
            let special = scene.clone().rendered_by(variant).expect("it suffices");
            let picture = rendered(&Arc::new(special), &frame);
            assert!(picture == wanted, "{name} by {variant}");
        }
    }
    assert!(
        rendered_by.iter().all(|scenes| *scenes > 0),
        "{rendered_by:?}: a variant without a scene"
    );
}

/// A scene with one kind of thing beside what a plain one has, and what that needs.
fn needing(add: impl FnOnce(&mut Stage), needs: u32) -> (Arc<Scene>, u32) {
    let mut stage = Stage::default();
    let plain = stage.material(matte(vec3(0.9, 0.6, 0.3)));
    stage.mesh(&block(vec3(-0.6, 0.1, -0.5), vec3(0.5, 1.3, 0.7)), plain);
    stage.model.lights = vec![point_light(vec3(3.0, 5.0, 4.0), Vec3::ONE)];
    add(&mut stage);
    (stage.build(), needs)
}

/// Oracle: the variant that can everything, bit by bit. Each need alone is seen, and no variant that lacks it is taken; what is
/// black, or declared and used nowhere, needs nothing.
#[test]
fn each_need_is_seen_and_rendered_alike() {
    let image = |stage: &mut Stage| stage.model.environment.texture = stage.position_texture(1.0);
    let texture = |stage: &mut Stage| stage.model.materials[0].texture = stage.position_texture(1.0);
    let cases = [
        ("nothing", needing(|_| {}, 0)),
        (
            "a black light",
            needing(|stage| stage.model.lights.push(point_light(Vec3::ONE, Vec3::ZERO)), 0),
        ),
        ("an unused mirror", needing(|stage| _ = stage.material(mirror()), 0)),
        (
            "two materials",
            needing(|stage| another(stage, matte(Vec3::X)), MATERIALS),
        ),
        (
            "two lights",
            needing(
                |stage| stage.model.lights.push(point_light(Vec3::Y * 9.0, Vec3::ONE)),
                LIGHTS,
            ),
        ),
        (
            "a plane",
            needing(|stage| stage.plane(Vec3::Y * -9.0, Vec3::Y, 0), PLANES),
        ),
        ("a texture", needing(texture, TEXTURES)),
        ("an image around", needing(image, IMAGE)),
        (
            "a mirror",
            needing(|stage| another(stage, mirror()), MATERIALS | MIRRORS),
        ),
        ("glass", needing(|stage| another(stage, clear(1.5)), MATERIALS | GLASS)),
    ];
    for (name, (scene, needs)) in cases {
        assert_eq!(scene.needs, needs, "{name}");
        assert_eq!(scene.variant, Variant::least(needs), "{name}");
        let frame = frame(&scene, camera(vec3(2.0, 3.0, 6.0), Vec3::ZERO, 60.0, 96, 72));
        let by = |variant| {
            let special = Scene::clone(&scene).rendered_by(variant).expect("it suffices");
            rendered(&Arc::new(special), &frame)
        };
        let wanted = by(Variant::Everything);
        for variant in sufficient(&scene) {
            assert!(by(variant).sums == wanted.sums, "{name} by {variant}");
        }
    }
}

/// A square of another material before the block.
fn another(stage: &mut Stage, material: Material) {
    let material = stage.material(material);
    stage.mesh(&quad(vec3(-0.5, 1.2, 0.5), Vec3::X, Vec3::Y), material);
}

/// What does not suffice is refused, and a need that is there is seen.
#[test]
fn what_a_scene_needs_is_seen() {
    let needs = |name: &str| scene(model(name).0).variant;
    assert_eq!(needs("bunny"), Variant::Plain);
    assert_eq!(needs("cornell"), Variant::Opaque);
    assert_eq!(needs("bumps"), Variant::Mirrors);
    assert_eq!(needs("mirrors"), Variant::Everything);
    assert!(scene(model("bumps").0).rendered_by(Variant::Opaque).is_none());
}

/// Oracle: the variant that can everything, on the same device: its driver contracts differently.
#[test]
#[ignore = "needs a Vulkan driver"]
fn every_variant_renders_the_same_picture_on_a_gpu() {
    let gpu = gpu();
    let size = if gpu.is_software() {
        uvec2(160, 121)
    } else {
        uvec2(1280, 968)
    };
    for name in SCENES {
        let (model, view) = model(name);
        let view = View {
            samples: Samples::One,
            depth: view.depth.min(5),
            ..view
        };
        let scene = scene(model);
        let frame = view.frame(&scene, size.x, size.y);
        let of = |variant| {
            let special = scene.clone().rendered_by(variant).expect("it suffices");
            let mut backend = GpuBackend::new(gpu.clone(), &special).expect("it fits");
            let picture = backend.render(&frame, &silent).expect("the device works");
            let ids: Vec<u32> = backend
                .hits(&frame)
                .expect("it does")
                .iter()
                .map(|hit| hit.triangle)
                .collect();
            (steps(&picture, &view), ids)
        };
        let (wanted, wanted_ids) = of(Variant::Everything);
        for variant in sufficient(&scene) {
            let (is, ids) = of(variant);
            assert!(ids == wanted_ids, "{name} by {variant}: other triangles");
            let off = is
                .chunks(3)
                .zip(wanted.chunks(3))
                .enumerate()
                .filter(|(_, (a, b))| farthest(a, b) > 1);
            let off: Vec<usize> = off.map(|(index, _)| index).collect();
            println!(
                "{name} by {variant}: {} pixels are off by more than 1: {off:?}",
                off.len()
            );
            assert!(
                off.len() as f64 <= 1e-5 * f64::from(size.x * size.y),
                "{name} by {variant}"
            );
        }
    }
}
