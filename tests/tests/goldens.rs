#![cfg(test)]
//! The pictures of all scenes in `assets/scenes` against goldens.
//!
//! The CPU is the standard: `OKTANT_BLESS=1` lets it write the goldens anew. Where a picture differs too much, expected,
//! actual and difference are written side by side into `target/goldens`.

use image::RgbImage;
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions, ModulePath};
use oktant::octree::OctreeOptions;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant_tests::images::{CPU, Tolerance, difference};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Width and height of the goldens in pixels.
const SIZE: [u32; 2] = [320, 242];

/// Drivers contract and divide as they like: a ray that passes an edge sees something else.
const GPU: Tolerance = Tolerance {
    step: 2,
    outliers: 5e-3,
};
/// In the rims of the glass a ray is reflected a dozen times, and each time its rounding grows.
const GPU_IN_GLASS: Tolerance = Tolerance {
    step: 2,
    outliers: 4e-2,
};

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

/// Renders a scene file at the size of the goldens.
fn picture(path: &Path, backend: impl FnOnce(&Arc<Scene>) -> Box<dyn Backend>) -> RgbImage {
    let setting = Source::from_path(path.to_path_buf()).load(&silent).unwrap();
    let scene = Arc::new(Scene::of_model(setting.model, &OctreeOptions::default(), &silent).unwrap());
    let frame = setting.view.frame(&scene, SIZE[0], SIZE[1]);
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
        let actual = picture(&path, |scene| Box::new(Cpu::new(scene.clone())));
        if bless {
            actual.save(golden(&path)).unwrap();
        }
        wrong.extend(golden_differs(&path, &actual, &CPU, "cpu"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn the_gpu_renders_the_goldens(module: ModulePath, who: &str) {
    let options = GpuOptions { software: true, module };
    let gpu = Arc::new(Gpu::open(&options).unwrap());
    let mut wrong = Vec::new();
    for path in scenes() {
        let actual = picture(&path, |scene| Box::new(GpuBackend::new(gpu.clone(), scene).unwrap()));
        let is_glass = path.file_stem().is_some_and(|name| name == "glass");
        wrong.extend(golden_differs(
            &path,
            &actual,
            if is_glass { &GPU_IN_GLASS } else { &GPU },
            who,
        ));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn the_gpu_renders_the_goldens_from_the_kernel_passed_through() {
    the_gpu_renders_the_goldens(ModulePath::Auto, "gpu");
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn the_gpu_renders_the_goldens_through_naga() {
    the_gpu_renders_the_goldens(ModulePath::Naga, "naga");
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
