//! The compact setting beside the default: what it takes, and what pictures look like.

#![cfg(test)]

use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions};
use oktant::mesh_source::MeshSource;
use oktant::picture::Picture;
use oktant::progress::silent;
use oktant::scene::{Memory, Scene};
use oktant::source::{Setting, Source};
use oktant::structure::StructureOptions;
use oktant::view::{Shading, View};
use oktant_shared::parts::TraversalKind;
use oktant_tests::data::reference;
use std::path::Path;
use std::sync::Arc;

/// Width and height of the pictures in pixels.
const SIZE: [u32; 2] = [320, 242];

/// A code of 16 bits is so many times a code of 8 bits.
const STEP: u16 = 257;

/// The scenes in `assets/scenes`.
const SCENES: [&str; 7] = ["balls", "bumps", "bunny", "cornell", "glass", "mirrors", "stadium"];

fn load(scene: &str) -> Setting {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../assets/scenes/{scene}.toml"));
    Source::from_path(path).load(&silent).unwrap()
}

fn built(setting: &Setting, traversal: TraversalKind) -> Arc<Scene> {
    let options = StructureOptions::of(traversal);
    Arc::new(Scene::of_model(setting.model.clone(), &options, &silent).unwrap())
}

fn rendered(view: &View, scene: &Arc<Scene>) -> Picture {
    let frame = view.frame(scene, SIZE[0], SIZE[1]);
    Cpu::new(scene.clone()).render(&frame, &silent).unwrap()
}

/// Bytes of a triangle that rays need, by the default and by the compact setting.
fn bytes(source: &MeshSource) -> [f64; 2] {
    let mesh = source.load(&silent).unwrap();
    [TraversalKind::Octants, TraversalKind::Compact].map(|traversal| {
        let scene = Scene::new(&mesh, &StructureOptions::of(traversal), &silent).unwrap();
        Memory::of(&scene).traced() as f64 / mesh.triangles.len() as f64
    })
}

#[test]
fn a_triangle_takes_no_more_bytes_than_stated() {
    let [fast, compact] = bytes(&MeshSource::Bunny);
    assert!(fast <= 72.0 && compact <= 48.0, "{fast}, {compact}");
}

#[test]
#[ignore = "needs the reference data"]
fn a_triangle_of_the_dragon_takes_no_more_bytes_than_stated() {
    let [fast, compact] = bytes(&MeshSource::File(reference("meshes/dragon-871k.ply")));
    println!("{fast:.1} and {compact:.1} bytes a triangle");
    assert!(fast <= 72.0 && compact <= 48.0, "{fast}, {compact}");
}

/// Oracle: the default setting. Where no normals are interpolated, nothing is rounded.
#[test]
fn flat_pictures_are_the_same_bit_for_bit() {
    for name in SCENES {
        let setting = load(name);
        let view = View {
            shading: Shading::Flat,
            ..setting.view
        };
        let [fast, compact] = [TraversalKind::Octants, TraversalKind::Compact]
            .map(|traversal| rendered(&view, &built(&setting, traversal)));
        assert!(fast.sums == compact.sums, "{name}");
        assert!(fast.work == compact.work, "{name}");
    }
}

/// Oracle: the default setting, with normals of 96 bits. Where rays are mirrored, refracted or bumped, those are there too.
#[test]
fn smooth_pictures_are_off_by_less_than_a_step() {
    let mut wrong = Vec::new();
    for name in SCENES {
        let setting = load(name);
        let [fast, compact] = [TraversalKind::Octants, TraversalKind::Compact].map(|traversal| {
            let picture = rendered(&setting.view, &built(&setting, traversal));
            picture.to_rgb16(&setting.view.tone)
        });
        let pixels = fast.chunks(3).zip(compact.chunks(3));
        let worst: Vec<u16> = pixels
            .map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0))
            .collect();
        let off = worst.iter().filter(|off| **off >= STEP).count();
        let greatest = f64::from(*worst.iter().max().unwrap()) / f64::from(STEP);
        println!(
            "{name}: {off} of {} pixels off by 1/255 or more, the greatest by {greatest:.2}/255",
            worst.len()
        );
        if off > 0 {
            wrong.push(format!("{name}: {off} pixels"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
}

/// Oracle: the CPU, as for all that the GPU renders.
#[test]
#[ignore = "needs a Vulkan driver"]
fn the_gpu_renders_it_like_the_cpu() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    for name in ["bunny", "mirrors"] {
        let setting = load(name);
        let scene = built(&setting, TraversalKind::Compact);
        let frame = setting.view.frame(&scene, SIZE[0], SIZE[1]);
        let mut backend = GpuBackend::new(gpu.clone(), &scene).unwrap();
        let pictures = [
            Cpu::new(scene.clone()).render(&frame, &silent).unwrap(),
            backend.render(&frame, &silent).unwrap(),
        ];
        let [cpu, gpu] = pictures.map(|picture| picture.to_rgb8(&setting.view.tone));
        let pixels = cpu.chunks(3).zip(gpu.chunks(3));
        let off = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2));
        let off = off.count();
        println!("{name}: {off} pixels off by more than 2 of 255");
        assert!(off <= cpu.len() / 3 / 200, "{name}: {off} pixels");
    }
}
