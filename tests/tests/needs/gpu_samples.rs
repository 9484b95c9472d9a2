//! Samples where they matter, on a GPU.

use super::{farthest, gpu, model, rendered, steps};
use glam::{Vec4, uvec2};
use oktant::adaptive::{makes_list, passes};
use oktant::backend::Backend;
use oktant::backend::gpu::GpuBackend;
use oktant::picture::Picture;
use oktant::progress::silent;
use oktant::sampling::Samples;
use oktant::scene::Scene;
use oktant::stereo::{Stereo, StereoMode};
use oktant::structure::StructureOptions;
use oktant::view::View;
use oktant_shared::adaptive::{Choice, INTERPOLATED, Known, SINGLE, UNKNOWN, choose, level_of};
use oktant_shared::frame::Frame;
use oktant_shared::parts::{Parts, TraversalKind};
use std::sync::Arc;

/// A scene of the repository, seen with 16 samples where they matter.
fn adaptive(name: &str, block: u32) -> (Arc<Scene>, View) {
    adaptive_with(name, block, TraversalKind::default())
}

fn adaptive_with(name: &str, block: u32, traversal: TraversalKind) -> (Arc<Scene>, View) {
    let (model, view) = model(name);
    let view = View {
        samples: Samples::Sixteen,
        adaptive: true,
        block,
        depth: view.depth.min(5),
        ..view
    };
    let options = StructureOptions {
        parts: Parts {
            traversal,
            ..Parts::STANDARD
        },
        ..StructureOptions::default()
    };
    let scene = Scene::of_model(model, &options, &silent).expect("a scene of the repository");
    (Arc::new(scene), view)
}

/// How many pixels of two pictures are off by more than one step. Where samples round to something else, as after many mirrors, others
/// may follow.
fn off(here: &Picture, there: &Picture, view: &View) -> usize {
    let (here, there) = (steps(here, view), steps(there, view));
    let pairs = here.chunks(3).zip(there.chunks(3));
    pairs.filter(|(a, b)| farthest(a, b) > 1).count()
}

/// Oracle: the CPU's choice from the same colours and marks, and its picture.
#[test]
#[ignore = "needs a Vulkan driver"]
fn a_gpu_chooses_as_the_cpu_does() {
    let gpu = gpu();
    let per_pass = if gpu.is_software() { 1 } else { 16 };
    for (name, block) in [("bunny", 1), ("bunny", 8), ("cornell", 1), ("mirrors", 1)] {
        let (scene, view) = adaptive(name, block);
        let frame = view.frame(&scene, 160, 121);
        let uploaded = gpu.upload(&scene).expect("it fits");
        let picture = gpu.picture(160, 121, true).expect("it fits");
        let known = || {
            let marks = gpu.read_marks(&picture).expect("the device works");
            (marks, gpu.read_picture(&picture).expect("the device works"))
        };
        let mut before = known();
        let (mut listed, mut others) = (0, 0);
        let passes = passes(&frame, per_pass);
        let mut round = passes.as_slice();
        while let Some(first) = round.first() {
            let next = round
                .iter()
                .skip(1)
                .position(makes_list)
                .map_or(round.len(), |next| next + 1);
            let (passes, rest) = round.split_at(next);
            for pass in passes {
                gpu.render_pass_timed(&uploaded, &picture, pass)
                    .expect("the device works");
            }
            let after = known();
            if makes_list(first) {
                let (marks, sums) = &before;
                for (index, mark) in after.0.iter().enumerate() {
                    let pixel = uvec2(index as u32 % 160, index as u32 / 160);
                    let choice = choose(first, &Known { marks, sums }, pixel);
                    let wanted = match choice {
                        Choice {
                            is_interpolated: true, ..
                        } => INTERPOLATED,
                        Choice { level: UNKNOWN, .. } => marks[index].level(),
                        Choice { level, .. } => level,
                    };
                    listed += usize::from(choice.level != UNKNOWN);
                    others += usize::from(mark.level() != wanted);
                }
            }
            (before, round) = (after, rest);
        }
        let there = Picture {
            width: 160,
            height: 121,
            sums: before.1,
            work: Vec::new(),
            marks: before.0,
        };
        let off = off(&rendered(&scene, &frame), &there, &view);
        println!(
            "{name}, block {block}: {listed} pixels were listed, {others} are at other levels, {off} off by more than 1"
        );
        assert!(listed > 3_000 && others <= 2 && off <= 60, "{name}, block {block}");
    }
}

/// How many rays a picture took, and how many shadow rays.
fn rays(picture: &Picture) -> (f64, f64) {
    let sum = |of: fn(&Vec4) -> f32| picture.work.iter().map(|work| f64::from(of(work))).sum();
    (sum(|work| work.x), sum(|work| work.y))
}

/// Oracle: the CPU. The entry points of lists that are not tested above: of scenes with mirrors, and of other parts.
#[test]
#[ignore = "needs a Vulkan driver"]
fn a_gpu_samples_as_the_cpu_does() {
    let gpu = gpu();
    for (name, traversal) in [("bumps", TraversalKind::Octants), ("mirrors", TraversalKind::Bvh2)] {
        let (scene, view) = adaptive_with(name, 1, traversal);
        let frame = view.frame(&scene, 160, 121);
        let mut backend = GpuBackend::new(gpu.clone(), &scene).expect("it fits");
        let there = backend.render(&frame, &silent).expect("the device works");
        let here = rendered(&scene, &frame);
        let off = off(&here, &there, &view);
        let [(rays, shadow_rays), (wanted, wanted_shadow)] = [&there, &here].map(rays);
        println!(
            "{name}, {traversal}: {off} pixels are off by more than 1; {rays} rays and {shadow_rays} shadow rays, on the CPU \
             {wanted} and {wanted_shadow}"
        );
        assert!(off <= 60, "{name}, {traversal}");
        for (is, wanted) in [(rays, wanted), (shadow_rays, wanted_shadow)] {
            assert!(is > 0.0 && (is - wanted).abs() <= 1e-3 * wanted, "{name}, {traversal}");
        }
    }
}

/// Oracle: pictures of as many samples everywhere, by the same device, bit by bit on software. Other entry points take their samples,
/// which another driver may contract in another way.
#[test]
#[ignore = "needs a Vulkan driver"]
fn an_adaptive_picture_consists_of_pixels_of_others_on_a_gpu() {
    let gpu = gpu();
    for name in ["bunny", "cornell", "bumps", "mirrors"] {
        let (scene, view) = adaptive(name, 1);
        let mut backend = GpuBackend::new(gpu.clone(), &scene).expect("it fits");
        let mut of = |view: &View| {
            let frame = view.frame(&scene, 160, 121);
            backend.render(&frame, &silent).expect("the device works")
        };
        let picture = of(&view);
        let others = [Samples::One, Samples::Four, Samples::Sixteen].map(|samples| {
            of(&View {
                samples,
                adaptive: false,
                ..view
            })
        });
        let mut counts = [0; 3];
        let mut other_cuts = 0;
        let sums = picture.marks.iter().enumerate().map(|(index, mark)| {
            let which = (mark.level() - SINGLE) as usize;
            counts[which] += 1;
            other_cuts += usize::from(picture.work[index].z != others[which].work[index].z);
            others[which].sums[index]
        });
        let wanted = Picture {
            sums: sums.collect(),
            ..picture.clone()
        };
        let pairs = picture.sums.iter().zip(&wanted.sums);
        let different = pairs.filter(|(is, wanted)| is != wanted).count();
        let off = off(&picture, &wanted, &view);
        println!(
            "{name}: {counts:?} pixels of 1, 4 and 16 samples, {different} are others, {off} of them off by more than 1; of \
             {other_cuts} something else was cut"
        );
        assert!(counts.iter().all(|count| *count > 50), "{name}: {counts:?}");
        assert!(
            off <= 60 && (different + other_cuts == 0 || !gpu.is_software()),
            "{name}"
        );
    }
}

/// Oracle: the sum over one sample after the other. However many samples a pass takes, and so however often a workgroup takes turns,
/// they are added up in their order.
#[test]
#[ignore = "needs a Vulkan driver"]
fn passes_of_many_samples_make_the_same_picture_on_a_gpu() {
    let gpu = gpu();
    for (name, block, stereo) in [
        ("bunny", 1, None),
        ("cornell", 4, Some(Stereo::new(StereoMode::Anaglyph))),
    ] {
        let (scene, view) = adaptive(name, block);
        let samples = if gpu.is_software() { 16 } else { 64 };
        let frame = Frame {
            most_samples: samples,
            ..View { stereo, ..view }.frame(&scene, 96, 73)
        };
        let uploaded = gpu.upload(&scene).expect("it fits");
        let of = |per_pass| {
            let picture = gpu.picture(96, 73, true).expect("it fits");
            for pass in passes(&frame, per_pass) {
                gpu.render_pass_timed(&uploaded, &picture, &pass)
                    .expect("the device works");
            }
            let marks = gpu.read_marks(&picture).expect("the device works");
            (gpu.read_picture(&picture).expect("the device works"), marks)
        };
        let (sums, marks) = of(1);
        let most = marks.iter().filter(|mark| mark.level() == level_of(samples)).count();
        println!("{name}: {most} pixels have {samples} samples");
        assert!(most > 200, "{name}");
        for per_pass in [3, samples] {
            let (other_sums, other_marks) = of(per_pass);
            assert!(other_sums == sums, "{name}, {per_pass}: other colours");
            assert!(other_marks == marks, "{name}, {per_pass}: other marks");
        }
    }
}
