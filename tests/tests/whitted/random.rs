//! Materials and shapes put together at random, evil ones among them: no pixel may be anything but a colour.

use fastrand::Rng;
use glam::{Vec2, Vec3, vec3};
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions, ModulePath};
use oktant::mesh::Mesh;
use oktant::picture::Picture;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant_shared::environment::Environment;
use oktant_shared::frame::Frame;
use oktant_shared::light::{AREA, DIRECTIONAL, Light, POINT};
use oktant_shared::material::{FRESNEL, Material, PHONG_HIGHLIGHTS, SMOOTH_NORMALS, VERTEX_COLORS};
use oktant_shared::texture::{CHECKERBOARD, NO_TEXTURE, SHARED_EXPONENT_IMAGE, SRGB_IMAGE, Texture, WAVES};
use oktant_shared::whitted::MAX_DEPTH;
use oktant_tests::meshes::{ball, block, quad, turned_inside_out};
use oktant_tests::stage::{Stage, camera, frame};
use std::sync::Arc;

/// Pairs of a material and a shape that are tried.
const PAIRS: usize = 10_000;

/// How they are put into scenes.
#[derive(Clone, Copy)]
struct Plan {
    /// Pairs in a scene.
    pairs: usize,
    /// Size of its picture, pixels.
    size: [u32; 2],
}

fn vector(rng: &mut Rng) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| rng.f32() * 2.0 - 1.0))
}

fn color(rng: &mut Rng) -> Vec3 {
    match rng.u32(0..4) {
        0 => Vec3::ZERO,
        1 => Vec3::ONE,
        _ => Vec3::from_array(std::array::from_fn(|_| rng.f32())),
    }
}

fn pick<T: Copy, const N: usize>(choices: [T; N], rng: &mut Rng) -> T {
    choices[rng.usize(..N)]
}

fn material(rng: &mut Rng, textures: u32) -> Material {
    let texture = |rng: &mut Rng| {
        if rng.u32(0..3) == 0 {
            rng.u32(..textures)
        } else {
            NO_TEXTURE
        }
    };
    let flags = [VERTEX_COLORS, SMOOTH_NORMALS, PHONG_HIGHLIGHTS, FRESNEL];
    Material {
        base: color(rng),
        ambient: rng.f32(),
        specular: color(rng),
        exponent: pick([0.0, 1.0, 5.0, 40.0, 1e4], rng),
        mirror: color(rng) * pick([0.0, 0.5, 1.0], rng),
        diffuse: rng.f32(),
        transmission: color(rng) * pick([0.0, 0.5, 1.0], rng),
        ior: pick([0.3, 0.7, 1.0, 1.000_001, 1.33, 1.5, 3.0], rng),
        absorption: color(rng) * pick([0.0, 0.1, 3.0, 1e6], rng),
        priority: rng.u32(..4),
        texture: texture(rng),
        bump: texture(rng),
        bump_height: pick([0.01, 1.0, -1e4, 1e6], rng),
        flags: flags.into_iter().filter(|_| rng.bool()).sum(),
    }
}

/// Thin triangles through a point, down to what rounding leaves.
fn slivers(rng: &mut Rng, center: Vec3, size: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for _ in 0..8 {
        let base = mesh.positions.len() as u32;
        let (a, along) = (center + vector(rng) * size, vector(rng) * size);
        let width = pick([1e-2, 1e-5, 1e-7, 1e-12, 0.0], rng);
        mesh.positions
            .extend([a, a + along, a + along * 0.5 + vector(rng) * (size * width)]);
        mesh.triangles.push([base, base + 1, base + 2]);
    }
    // And one that is thin enough to have no area unless it is scaled, flat on an axis.
    let base = mesh.positions.len() as u32;
    mesh.positions
        .extend([Vec3::ZERO, Vec3::X * size, vec3(0.5 * size, 1e-17 * size, 0.0)]);
    mesh.triangles.push([base, base + 1, base + 2]);
    mesh
}

/// A shape at a place within so much of the origin.
fn shape(rng: &mut Rng, spread: f32) -> Mesh {
    let size = pick([0.05, 0.5, 1.0, 2.0], rng);
    let center = pick([vector(rng) * spread, Vec3::ZERO, Vec3::splat(0.25)], rng);
    let mut mesh = match rng.u32(0..6) {
        0 => ball(center, size, rng.u32(3..12), rng.u32(2..8)),
        1 => block(center - size, center + size),
        2 => quad(center, vector(rng) * size, vector(rng) * size),
        // On the planes that others lie on too.
        3 => quad(vec3(-size, 0.0, size), Vec3::X * (2.0 * size), Vec3::Z * (-2.0 * size)),
        4 => slivers(rng, center, size),
        _ => block(center - size * vec3(1.0, 1e-6, 1.0), center + size),
    };
    let count = mesh.positions.len();
    match rng.u32(0..5) {
        0 => mesh.normals.clear(),
        1 => mesh.normals = vec![Vec3::ZERO; count],
        2 => mesh.normals = (0..count).map(|_| vector(rng).normalize_or_zero()).collect(),
        3 => mesh.normals = vec![vector(rng).normalize_or_zero(); count],
        _ => {}
    }
    match rng.u32(0..3) {
        0 => mesh.coordinates = vec![Vec2::ZERO; count],
        1 => {
            mesh.coordinates = (0..count)
                .map(|_| vector(rng).truncate() * pick([1.0, 1e-6, 1e6], rng))
                .collect()
        }
        _ => {}
    }
    if rng.u32(0..4) == 0 {
        mesh = turned_inside_out(mesh);
    }
    mesh
}

fn light(rng: &mut Rng) -> Light {
    Light {
        // At a corner that shapes share, on a surface, or anywhere.
        position: pick(
            [vector(rng) * 3.0, Vec3::ZERO, Vec3::splat(0.25), vector(rng) * 1e4],
            rng,
        ),
        kind: POINT,
        color: color(rng) * pick([1.0, 100.0], rng),
        falloff_radius: pick([0.0, 1e-3, 1.0], rng),
        edge_u: pick([vector(rng), vector(rng) * 1e-6], rng),
        samples_per_side: rng.u32(1..3),
        edge_v: vector(rng),
        range: pick([0.0, 0.5, 20.0], rng),
    }
}

fn scene(rng: &mut Rng, pairs: usize) -> Arc<Scene> {
    // As dense, however many there are.
    let spread = (pairs as f32 / 12.0).cbrt();
    let mut stage = Stage::default();
    let texture = |kind, first, repeats| Texture {
        first,
        width: if kind == CHECKERBOARD { 0x20_80_ff } else { 2 },
        height: if kind == CHECKERBOARD { 0xff_ff_00 } else { 3 },
        kind,
        repeats,
        reserved: [0; 3],
    };
    stage.model.texels = (0..12).map(|_| rng.u32(..)).collect();
    let repeats = pick([1.0, 1e-4, 1e4], rng);
    stage.model.textures = vec![
        texture(SRGB_IMAGE, 0, repeats),
        texture(SHARED_EXPONENT_IMAGE, 6, 1.0),
        texture(CHECKERBOARD, 0, repeats),
        texture(WAVES, 0, repeats),
    ];
    let nested = rng.u32(0..8) == 0;
    for i in 0..pairs {
        let mut material = material(rng, 4);
        let mut mesh = shape(rng, spread);
        if nested && i < 16 {
            // Ten and more media, one inside of the other.
            material.transmission = Vec3::splat(0.9);
            mesh = ball(Vec3::splat(0.25), 0.1 + 0.1 * i as f32, 12, 8);
        }
        let id = stage.material(material);
        stage.mesh(&mesh, id);
    }
    // Colours where a material asks for them.
    let count = stage.model.mesh.positions.len();
    stage.model.mesh.colors = (0..count).map(|_| rng.u32(..).to_le_bytes()).collect();
    for _ in 0..rng.u32(0..3) {
        let normal = pick([Vec3::Y, Vec3::NEG_Z, vector(rng)], rng);
        if normal.length() > 0.1 {
            stage.plane(pick([Vec3::ZERO, vector(rng)], rng), normal, rng.u32(..pairs as u32));
        }
    }
    for _ in 0..rng.u32(0..4) {
        let mut light = light(rng);
        match rng.u32(0..3) {
            0 => light.kind = AREA,
            1 => (light.kind, light.position) = (DIRECTIONAL, (vector(rng) + Vec3::Y * 1.5).normalize()),
            _ => {}
        }
        stage.model.lights.push(light);
    }
    stage.model.environment = Environment {
        texture: if rng.u32(0..3) == 0 { rng.u32(..2) } else { NO_TEXTURE },
        zenith: color(rng),
        horizon: color(rng),
        up: pick([Vec3::Y, Vec3::Z], rng),
        ..Environment::constant(color(rng))
    };
    stage.model.ambient = color(rng);
    stage.build()
}

fn view(rng: &mut Rng, scene: &Scene, [width, height]: [u32; 2]) -> Frame {
    // Outside, inside of things, or exactly on what many of them touch.
    let eye = match rng.u32(0..4) {
        0 => vector(rng) * 0.5,
        1 => vec3(0.3, 0.0, 3.0),
        _ => vector(rng) * 4.0,
    };
    let target = vector(rng) * 0.2;
    let target = if target.distance(eye) < 0.01 {
        eye + Vec3::X
    } else {
        target
    };
    Frame {
        depth: rng.u32(0..=MAX_DEPTH),
        cutoff: pick([0.0, 1.0 / 512.0], rng),
        ..frame(scene, camera(eye, target, 60.0, width, height))
    }
}

fn check(seed: u64, picture: &Picture) {
    for (sum, work) in picture.sums.iter().zip(&picture.work) {
        assert!(
            sum.is_finite() && sum.min_element() >= 0.0,
            "scene {seed}: the colour {sum}"
        );
        assert!(sum.w == 1.0 && work.x >= 1.0, "scene {seed}: not written");
        assert!(
            work.is_finite() && work.min_element() >= 0.0,
            "scene {seed}: the work {work}"
        );
    }
}

fn scenes(plan: Plan) -> impl Iterator<Item = (u64, Arc<Scene>, Frame)> {
    (0..PAIRS.div_ceil(plan.pairs) as u64).map(move |seed| {
        let mut rng = Rng::with_seed(seed);
        let scene = scene(&mut rng, plan.pairs);
        let frame = view(&mut rng, &scene, plan.size);
        (seed, scene, frame)
    })
}

/// Oracle: colours are numbers, finite and not negative, on the CPU.
#[test]
fn every_pixel_is_a_color() {
    let (mut rays, mut bright) = (0.0, 0);
    let plan = Plan {
        pairs: 12,
        size: [10, 8],
    };
    for (seed, scene, frame) in scenes(plan) {
        let picture = Cpu::new(scene).render(&frame, &silent).unwrap();
        check(seed, &picture);
        rays += picture.work.iter().map(|work| f64::from(work.x)).sum::<f64>();
        bright += picture.sums.iter().filter(|sum| sum.truncate() != Vec3::ZERO).count();
    }
    println!("{rays} rays, {bright} pixels are not black");
    assert!(bright > 20_000);
}

/// The same, on the GPU. In a few crowded scenes, because lavapipe compiles the kernel anew for each frame with
/// other numbers of lights, planes and steps.
#[test]
#[ignore = "needs a Vulkan driver"]
fn every_pixel_is_a_color_on_the_gpu() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        module: ModulePath::Auto,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    let plan = Plan {
        pairs: 1000,
        size: [96, 72],
    };
    for (seed, scene, frame) in scenes(plan) {
        let mut backend = GpuBackend::new(gpu.clone(), &scene).unwrap();
        check(seed, &backend.render(&frame, &silent).unwrap());
    }
}
