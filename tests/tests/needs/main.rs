#![cfg(test)]
//! No more work than a scene needs: the picture is the same, or off by no more than is said, and there is less to do.

mod gpu_samples;
mod variants;

use glam::{UVec2, Vec3, uvec2, vec3};
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions, ModulePath};
use oktant::compare::{Shot, compare};
use oktant::model::Model;
use oktant::picture::Picture;
use oktant::progress::silent;
use oktant::sampling::{Pattern, Samples};
use oktant::scene::Scene;
use oktant::source::Source;
use oktant::structure::StructureOptions;
use oktant::view::View;
use oktant_shared::adaptive::{INTERPOLATED, SINGLE, level_of, samples_at};
use oktant_shared::display::encoded;
use oktant_shared::frame::Frame;
use oktant_shared::sampling::ROTATED;
use oktant_shared::texture::NO_TEXTURE;
use oktant_tests::meshes::quad;
use oktant_tests::stage::{Stage, camera, frame, glowing, mean};
use rayon::ThreadPoolBuilder;
use std::path::Path;
use std::sync::Arc;

/// All that are in `assets/scenes`.
const SCENES: [&str; 7] = ["balls", "bumps", "bunny", "cornell", "glass", "mirrors", "stadium"];

fn model(name: &str) -> (Model, View) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../assets/scenes/{name}.toml"));
    let setting = Source::Scene(path).load(&silent).expect("a scene of the repository");
    (setting.model, setting.view)
}

fn scene(model: Model) -> Scene {
    Scene::of_model(model, &StructureOptions::default(), &silent).expect("a scene of the repository")
}

fn rendered(scene: &Arc<Scene>, frame: &Frame) -> Picture {
    Cpu::new(scene.clone())
        .render(frame, &silent)
        .expect("the CPU renders everything")
}

fn gpu() -> Arc<Gpu> {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        module: ModulePath::Auto,
        ..GpuOptions::default()
    });
    Arc::new(gpu.expect("a Vulkan driver is installed"))
}

/// The colours of a picture in steps of 8 bits.
fn steps(picture: &Picture, view: &View) -> Vec<u8> {
    picture.to_rgb8(&view.tone)
}

fn farthest(a: &[u8], b: &[u8]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

/// Oracle: pictures of as many samples everywhere, of which an adaptive one consists, pixel by pixel and bit by bit.
#[test]
fn an_adaptive_picture_consists_of_pixels_of_others() {
    for name in ["bunny", "mirrors", "cornell"] {
        let (model, view) = model(name);
        let scene = Arc::new(scene(model));
        let adaptive = View {
            samples: Samples::Sixteen,
            adaptive: true,
            ..view
        };
        let picture = rendered(&scene, &adaptive.frame(&scene, 120, 91));
        let others = [Samples::One, Samples::Four, Samples::Sixteen].map(|samples| {
            let view = View {
                samples,
                adaptive: false,
                ..view
            };
            rendered(&scene, &view.frame(&scene, 120, 91))
        });
        let mut counts = [0; 3];
        for (index, mark) in picture.marks.iter().enumerate() {
            let which = (mark.level() - SINGLE) as usize;
            counts[which] += 1;
            assert_eq!(picture.sums[index], others[which].sums[index], "{name}, pixel {index}");
            let cut = |picture: &Picture| picture.work[index].z;
            assert_eq!(
                cut(&picture),
                cut(&others[which]),
                "{name}, pixel {index}: what was cut"
            );
        }
        println!("{name}: {counts:?} pixels of 1, 4 and 16 samples");
        assert!(counts.iter().all(|count| *count > 50), "{name}: {counts:?}");
        for threads in [1, 3] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build();
            let again = pool
                .expect("there are threads")
                .install(|| rendered(&scene, &adaptive.frame(&scene, 120, 91)));
            assert!(again == picture, "{name}: another picture with {threads} threads");
        }
    }
}

/// How near an adaptive picture comes to the one of 64 samples, by FLIP, and what part of the rays of 16 everywhere it took;
/// both as parts of what 16 samples everywhere have.
fn by_sixteen(
    name: &str,
    tolerance: f32,
    size: UVec2,
    backend: &mut dyn FnMut(&Arc<Scene>, &Frame) -> Picture,
) -> (f64, f64) {
    let (model, view) = model(name);
    let scene = Arc::new(scene(model));
    let mut of = |samples, adaptive, pattern| {
        let view = View {
            samples,
            adaptive,
            pattern,
            tolerance,
            ..view
        };
        backend(&scene, &view.frame(&scene, size.x, size.y))
    };
    let wanted = Shot::of_picture(&of(Samples::SixtyFour, false, Pattern::Regular));
    let fixed = of(Samples::Sixteen, false, Pattern::Rotated);
    let adaptive = of(Samples::Sixteen, true, Pattern::Rotated);
    let flip = |picture: &Picture| {
        let (comparison, _) = compare(&wanted, &Shot::of_picture(picture), 0.0).expect("they are of one size");
        comparison.flip.mean
    };
    let rays = |picture: &Picture| picture.work.iter().map(|work| f64::from(work.x + work.y)).sum::<f64>();
    let (error, part) = (flip(&adaptive) / flip(&fixed), rays(&adaptive) / rays(&fixed));
    println!("{name}, {size}: {error:.3} of the error of 16 samples everywhere, {part:.3} of their rays");
    (error, part)
}

/// Oracle: 64 samples everywhere. Small, so that the edges are much of the pictures; the size that counts is tested below.
#[test]
fn samples_go_where_they_matter() {
    let mut cpu = |scene: &Arc<Scene>, frame: &Frame| rendered(scene, frame);
    for (name, tolerance, most) in [("bunny", 0.002, 0.5), ("mirrors", 0.01, 0.66), ("cornell", 0.001, 0.48)] {
        let (error, part) = by_sixteen(name, tolerance, uvec2(240, 182), &mut cpu);
        assert!(error <= 1.05 && part <= most, "{name}");
    }
}

/// Oracle: 64 samples everywhere. Takes a minute on a real GPU, an hour on software.
#[test]
#[ignore = "needs a real GPU"]
fn samples_go_where_they_matter_in_large_pictures() {
    let gpu = gpu();
    if gpu.is_software() {
        println!("not tested: {} is software", gpu.name);
        return;
    }
    let mut render = |scene: &Arc<Scene>, frame: &Frame| {
        let mut backend = GpuBackend::new(gpu.clone(), scene).expect("it fits");
        backend.render(frame, &silent).expect("the device works")
    };
    let mut missed = Vec::new();
    for (name, tolerance) in [("bunny", 0.0004), ("mirrors", 0.013), ("cornell", 0.001)] {
        let (error, part) = by_sixteen(name, tolerance, uvec2(1280, 968), &mut render);
        if error > 1.05 || part > 0.35 {
            missed.push(name);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

/// Oracle: 16 samples everywhere. White threads before black, level, upright, leaning and along the diagonals, each through another
/// part of the pixels: between their middles too. Of less than 0.56 pixels, the distance between the rows of four samples, they may
/// slip through between those, but for level and upright ones.
#[test]
fn threads_thinner_than_a_pixel_are_caught() {
    // Of 120 x 90 pixels the picture shows 2 x 1.5 units.
    let of_pixels = 1.0 / 60.0;
    let all = [0.0_f32, 0.6, 8.0, 26.6, 45.0, 89.4, 90.0, 116.6, 135.0, 161.0];
    for (width, directions) in [(0.9_f32, &all[..]), (0.6, &all), (0.34, &[0.0, 90.0])] {
        for &degrees in directions {
            let mut stage = Stage::default();
            let white = stage.material(glowing(NO_TEXTURE));
            stage.model.ambient = Vec3::ONE;
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let (along, across) = (vec3(cosine, sine, 0.0), vec3(-sine, cosine, 0.0));
            for line in -6..=6 {
                let begin = along * -1.5 + across * (line as f32 * 12.15 * of_pixels);
                let thread = quad(begin, along * 3.0, across * (width * of_pixels));
                stage.mesh(&thread, white);
            }
            let scene = stage.build();
            let camera = camera(Vec3::Z * 3.0, Vec3::ZERO, 2.0 * 0.25_f32.atan().to_degrees(), 120, 90);
            let fixed = Frame {
                samples: 16,
                samples_per_side: 4,
                sample_count: 16,
                pattern: ROTATED,
                ..frame(&scene, camera)
            };
            let adaptive = Frame {
                samples: 1,
                samples_per_side: 1,
                sample_count: 1,
                most_samples: 16,
                tolerance: View::default().tolerance,
                block: 1,
                ..fixed
            };
            let (fixed, adaptive) = (rendered(&scene, &fixed), rendered(&scene, &adaptive));
            // Towards the picture's border a thread may be found from one side only.
            let is_inside = |index: usize| {
                let (x, y) = (index % 120, index / 120);
                (6..114).contains(&x) && (6..84).contains(&y)
            };
            let inside = || (0..fixed.sums.len()).filter(|index| is_inside(*index));
            let lit = inside().filter(|index| mean(fixed.sums[*index]).x > 0.0).count();
            let apart = inside()
                .filter(|index| mean(fixed.sums[*index]) != mean(adaptive.sums[*index]))
                .count();
            println!("{width} of a pixel, {degrees} degrees: {apart} of {lit} pixels are not as of 16 samples");
            assert!(
                lit > 500 && apart as f64 <= 0.02 * lit as f64,
                "{width}, {degrees} degrees"
            );
        }
    }
}

/// Oracle: one sample everywhere. Pixels are traced or lie between corners that agree, and most are not traced.
#[test]
fn what_lies_between_corners_that_agree_is_not_traced() {
    let (model, view) = model("bunny");
    let scene = Arc::new(scene(model));
    let of = |block, samples, adaptive| {
        let view = View {
            block,
            samples,
            adaptive,
            ..view
        };
        let frame = view.frame(&scene, 323, 247);
        (rendered(&scene, &frame), frame)
    };
    let (whole, frame) = of(1, Samples::One, false);
    let mut last = f64::MAX;
    for block in [2, 4, 8] {
        let (coarse, _) = of(block, Samples::One, true);
        let traced: f32 = coarse.work.iter().map(|work| work.x).sum();
        let mut interpolated = 0;
        let mut worst = 0.0_f32;
        for (index, mark) in coarse.marks.iter().enumerate() {
            if mark.level() == INTERPOLATED {
                interpolated += 1;
                let [is, wanted] = [&coarse, &whole].map(|picture| encoded(&frame, mean(picture.sums[index])));
                worst = worst.max((is - wanted).abs().max_element());
            } else {
                assert_eq!(coarse.sums[index], whole.sums[index], "block {block}, pixel {index}");
            }
        }
        assert_eq!(interpolated + traced as usize, coarse.marks.len());
        let part = f64::from(traced) / coarse.marks.len() as f64;
        println!(
            "block {block}: {part:.3} of the pixels are traced, the others off by at most {worst:.3} of the range"
        );
        assert!(part < last && part < 0.7, "{block}");
        last = part;
    }
    // With more samples, edges are as good as ever.
    let (both, _) = of(8, Samples::Sixteen, true);
    let most = level_of(16);
    assert!(both.marks.iter().filter(|mark| mark.level() == most).count() > 500);
    assert_eq!(samples_at(most).samples, 16);
}

/// Oracle: the deepest tree, in which a ray is cut only where it could change a hundredth of a step.
#[test]
fn what_is_cut_cannot_be_seen() {
    for name in ["mirrors", "glass", "bumps"] {
        let (model, view) = model(name);
        let scene = Arc::new(scene(model));
        let of = |cutoff| {
            let view = View {
                depth: 16,
                cutoff,
                samples: Samples::Four,
                ..view
            };
            rendered(&scene, &view.frame(&scene, 160, 121))
        };
        let (whole, cut) = (of(0.01), of(View::default().cutoff));
        let most = farthest(&steps(&whole, &view), &steps(&cut, &view));
        // Camera rays are no choice.
        let secondary = |picture: &Picture| picture.work.iter().map(|work| f64::from(work.x) - 4.0).sum::<f64>();
        let saved = 1.0 - secondary(&cut) / secondary(&of(0.0));
        println!(
            "{name}: off by {most} of 255 at most, {:.1} % of the secondary rays saved",
            saved * 100.0
        );
        assert!(most <= 1, "{name}");
        assert!(name != "mirrors" || saved >= 0.4, "{name}: {saved}");
    }
}
