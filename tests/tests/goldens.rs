#![cfg(test)]
//! The pictures of all scenes in `assets/scenes` against goldens.
//!
//! The CPU is the standard: `OKTANT_BLESS=1` lets it write the goldens anew. Where a picture differs too much, expected,
//! actual and difference are written side by side into `target/goldens`.

use image::RgbImage;
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions, ModulePath};
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::structure::StructureOptions;
use oktant::view::View;
use oktant_shared::whitted::MAX_DEPTH;
use oktant_tests::images::{CPU, Tolerance, compared, difference};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Width and height of the goldens in pixels.
const SIZE: [u32; 2] = [320, 242];

/// Drivers contract and divide as they like: a ray that passes an edge sees something else, and each reflection makes its
/// rounding grow.
const GPU: Tolerance = Tolerance {
    step: 2,
    outliers: 5e-3,
};

/// Deeper trees of rays are too much for lavapipe where naga has made more loops of them: it leaves all loops of a pixel
/// when they have taken 65,535 turns together.
const NAGA_DEPTH: u32 = 5;

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes");
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    scenes.sort();
    assert!(scenes.len() >= 6, "the scenes are gone");
    scenes
}

/// Renders a scene file at the size of the goldens, its tree of rays no deeper than said.
fn picture(path: &Path, most_depth: u32, backend: impl FnOnce(&Arc<Scene>) -> Box<dyn Backend>) -> RgbImage {
    let setting = Source::from_path(path.to_path_buf()).load(&silent).unwrap();
    let scene = Arc::new(Scene::of_model(setting.model, &StructureOptions::default(), &silent).unwrap());
    let view = View {
        depth: setting.view.depth.min(most_depth),
        ..setting.view
    };
    let frame = view.frame(&scene, SIZE[0], SIZE[1]);
    let picture = backend(&scene).render(&frame, &silent).unwrap();
    assert!(
        picture
            .sums
            .iter()
            .all(|sum| sum.is_finite() && sum.w > 0.0 && sum.min_element() >= 0.0)
    );
    RgbImage::from_raw(SIZE[0], SIZE[1], picture.to_rgb8(&setting.view.tone)).unwrap()
}

fn golden(path: &Path) -> PathBuf {
    let name = path.file_stem().unwrap().to_str().unwrap();
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("goldens/{name}.png"))
}

/// Compares a picture with its golden; what is wrong, if anything is.
fn golden_differs(path: &Path, actual: &RgbImage, tolerance: &Tolerance, who: &str) -> Option<String> {
    let wrong = difference(&golden(path), actual, tolerance, who)?;
    Some(format!("{wrong}; OKTANT_BLESS=1 writes it anew"))
}

#[test]
fn the_cpu_renders_the_goldens() {
    let bless = std::env::var_os("OKTANT_BLESS").is_some();
    let mut wrong = Vec::new();
    for path in scenes() {
        let actual = picture(&path, MAX_DEPTH, |scene| Box::new(Cpu::new(scene.clone())));
        if bless {
            actual.save(golden(&path)).unwrap();
        }
        wrong.extend(golden_differs(&path, &actual, &CPU, "cpu"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn gpu(module: ModulePath) -> Arc<Gpu> {
    let options = GpuOptions {
        software: true,
        module,
        ..GpuOptions::default()
    };
    Arc::new(Gpu::open(&options).unwrap())
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn the_gpu_renders_the_goldens_from_the_kernel_passed_through() {
    let gpu = gpu(ModulePath::Auto);
    let mut wrong = Vec::new();
    for path in scenes() {
        let actual = picture(&path, MAX_DEPTH, |scene| {
            Box::new(GpuBackend::new(gpu.clone(), scene).unwrap())
        });
        wrong.extend(golden_differs(&path, &actual, &GPU, "gpu"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn the_gpu_renders_the_scenes_through_naga() {
    let gpu = gpu(ModulePath::Naga);
    let mut wrong = Vec::new();
    for path in scenes() {
        let expected = picture(&path, NAGA_DEPTH, |scene| Box::new(Cpu::new(scene.clone())));
        let actual = picture(&path, NAGA_DEPTH, |scene| {
            Box::new(GpuBackend::new(gpu.clone(), scene).unwrap())
        });
        let name = path.file_stem().unwrap().to_string_lossy();
        wrong.extend(compared(&name, &expected, &actual, &GPU, "naga"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_golden_is_left_over() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens");
    let mut goldens: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "png"))
        .map(|path| path.canonicalize().unwrap())
        .collect();
    goldens.sort();
    let wanted: Vec<PathBuf> = scenes()
        .iter()
        .map(|path| golden(path).canonicalize().unwrap())
        .collect();
    assert_eq!(goldens, wanted);
}
