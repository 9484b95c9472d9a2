#![cfg(test)]
//! The pictures of all scenes in `assets/scenes` against goldens.
//!
//! The CPU is the standard: `OKTANT_BLESS=1` lets it write the goldens anew. Where a picture differs too much, expected,
//! actual and difference are written side by side into `target/goldens`.

use image::{Rgb, RgbImage};
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions, ModulePath};
use oktant::octree::OctreeOptions;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::view::View;
use oktant_shared::whitted::MAX_DEPTH;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Width and height of the goldens in pixels.
const SIZE: [u32; 2] = [320, 242];

/// How far a picture may be from its golden.
struct Tolerance {
    /// A channel may be off by so many of 255.
    step: u8,
    /// Pixels that may be off by more, as a part of all.
    outliers: f64,
}

/// Another CPU has another power function, whose last bit may turn a rounding, or a ray at an edge.
const CPU: Tolerance = Tolerance {
    step: 1,
    outliers: 5e-4,
};
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
    let scene = Arc::new(Scene::of_model(setting.model, &OctreeOptions::default(), &silent).unwrap());
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

/// Part of the pixels in which a channel is off by more than a step.
fn outliers(expected: &RgbImage, actual: &RgbImage, step: u8) -> f64 {
    assert_eq!(expected.dimensions(), actual.dimensions());
    let off = |(a, b): (&Rgb<u8>, &Rgb<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > step);
    let count = expected.pixels().zip(actual.pixels()).filter(|pair| off(*pair)).count();
    count as f64 / f64::from(expected.width() * expected.height())
}

/// Expected, actual and eight times the difference, side by side.
fn side_by_side(expected: &RgbImage, actual: &RgbImage) -> RgbImage {
    let (width, height) = expected.dimensions();
    RgbImage::from_fn(width * 3, height, |x, y| {
        let (a, b) = (expected.get_pixel(x % width, y), actual.get_pixel(x % width, y));
        match x / width {
            0 => *a,
            1 => *b,
            _ => Rgb(std::array::from_fn(|i| a.0[i].abs_diff(b.0[i]).saturating_mul(8))),
        }
    })
}

/// Compares a picture with its golden; what is wrong, if anything is.
fn compare(path: &Path, actual: &RgbImage, tolerance: &Tolerance, who: &str) -> Option<String> {
    let golden = golden(path);
    let expected = match image::open(&golden) {
        Ok(image) => image.to_rgb8(),
        Err(error) => return Some(format!("{}: {error}; OKTANT_BLESS=1 writes it", golden.display())),
    };
    let part = outliers(&expected, actual, tolerance.step);
    let name = golden.file_stem().unwrap().to_str().unwrap();
    println!(
        "{name} on {who}: {:.3} % of the pixels off by more than {}",
        part * 100.0,
        tolerance.step
    );
    if part <= tolerance.outliers {
        return None;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/goldens");
    std::fs::create_dir_all(&folder).unwrap();
    let shown = folder.join(format!("{name}-{who}.png"));
    side_by_side(&expected, actual).save(&shown).unwrap();
    Some(format!(
        "{name} on {who}: {:.3} % of the pixels are off, see {}",
        part * 100.0,
        shown.display()
    ))
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
        wrong.extend(compare(&path, &actual, &CPU, "cpu"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn gpu(module: ModulePath) -> Arc<Gpu> {
    let options = GpuOptions { software: true, module };
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
        wrong.extend(compare(&path, &actual, &GPU, "gpu"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn the_gpu_renders_the_scenes_through_naga() {
    let gpu = gpu(ModulePath::Naga);
    for path in scenes() {
        let expected = picture(&path, NAGA_DEPTH, |scene| Box::new(Cpu::new(scene.clone())));
        let actual = picture(&path, NAGA_DEPTH, |scene| {
            Box::new(GpuBackend::new(gpu.clone(), scene).unwrap())
        });
        let part = outliers(&expected, &actual, GPU.step);
        println!(
            "{}: {:.3} % of the pixels off by more than {}",
            path.display(),
            part * 100.0,
            GPU.step
        );
        assert!(part <= GPU.outliers, "{}", path.display());
    }
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

#[test]
fn the_comparison_can_fail() {
    let expected = RgbImage::from_fn(SIZE[0], SIZE[1], |x, y| Rgb([x as u8, y as u8, 7]));
    assert_eq!(outliers(&expected, &expected, 0), 0.0);
    let mut actual = expected.clone();
    actual.put_pixel(5, 6, Rgb([5, 6, 10]));
    assert_eq!(outliers(&expected, &actual, 3), 0.0);
    assert_eq!(outliers(&expected, &actual, 2), 1.0 / f64::from(SIZE[0] * SIZE[1]));
    let shown = side_by_side(&expected, &actual);
    assert_eq!(shown.dimensions(), (SIZE[0] * 3, SIZE[1]));
    assert_eq!(*shown.get_pixel(SIZE[0] * 2 + 5, 6), Rgb([0, 0, 24]));
    assert_eq!(*shown.get_pixel(SIZE[0] * 2 + 6, 6), Rgb([0, 0, 0]));
}
