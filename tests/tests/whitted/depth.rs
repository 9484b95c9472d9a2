//! The ray tree at every depth: what is cut is bounded, and the stack never overflows.

use glam::{Vec3, Vec4, vec3};
use oktant::backend::Backend;
use oktant::backend::gpu::{Gpu, GpuBackend, GpuOptions, ModulePath};
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant_shared::display::{STEPS, encoded, steps};
use oktant_shared::environment::Environment;
use oktant_shared::frame::Frame;
use oktant_shared::material::{FRESNEL, Material, SMOOTH_NORMALS};
use oktant_shared::ray::Ray;
use oktant_shared::whitted::{MAX_DEPTH, MAX_RAYS};
use oktant_tests::compare::ColorDifferences;
use oktant_tests::meshes::{ball, block, quad};
use oktant_tests::stage::{
    Stage, camera, clear, directional_light, frame, matte, mean, mirror, picture, point_light, see,
};
use std::sync::Arc;

/// Two mirrors that face each other, with wide highlights of a light between them: through both there is more to see than any
/// surface shows.
fn hall_of_highlights() -> Stage {
    let mut stage = Stage::default();
    let silver = stage.material(Material {
        mirror: Vec3::splat(0.9),
        specular: Vec3::splat(0.8),
        exponent: 1.0,
        ..mirror()
    });
    stage.mesh(&quad(vec3(-4.0, -2.0, -3.0), Vec3::X * 8.0, Vec3::Y * 5.0), silver);
    stage.mesh(&quad(vec3(4.0, -2.0, 3.0), Vec3::X * -8.0, Vec3::Y * 5.0), silver);
    stage.model.lights = vec![point_light(vec3(0.0, 0.5, 0.0), Vec3::ONE)];
    stage
}

/// Two mirrors that face each other, and between them a ball of glass, a block of coloured glass and a matte ball; nothing
/// in it is brighter than 1.
fn hall_of_mirrors() -> Stage {
    let mut stage = Stage::default();
    let silver = stage.material(Material {
        mirror: vec3(0.95, 0.93, 0.9),
        ..mirror()
    });
    let glass = stage.material(Material {
        flags: FRESNEL | SMOOTH_NORMALS,
        ..clear(1.5)
    });
    let green = stage.material(Material {
        flags: FRESNEL,
        absorption: vec3(0.8, 0.1, 0.6),
        transmission: Vec3::splat(0.97),
        ..clear(1.4)
    });
    let red = stage.material(Material {
        flags: SMOOTH_NORMALS,
        ..matte(vec3(0.9, 0.3, 0.2))
    });
    stage.mesh(&quad(vec3(-4.0, -2.0, -3.0), Vec3::X * 8.0, Vec3::Y * 5.0), silver);
    stage.mesh(&quad(vec3(4.0, -2.0, 3.0), Vec3::X * -8.0, Vec3::Y * 5.0), silver);
    stage.mesh(&ball(vec3(-1.0, 0.0, 0.0), 0.8, 32, 16), glass);
    stage.mesh(&block(vec3(0.4, -1.0, -0.6), vec3(1.4, 0.6, 0.4)), green);
    stage.mesh(&ball(vec3(0.2, -0.9, 1.4), 0.5, 32, 16), red);
    stage.plane(Vec3::Y * -2.0, Vec3::Y, red);
    stage.model.environment = Environment {
        zenith: vec3(0.3, 0.5, 1.0),
        horizon: vec3(1.0, 0.9, 0.8),
        ..Environment::constant(Vec3::splat(0.2))
    };
    stage.model.ambient = Vec3::splat(0.6);
    stage
}

fn hall(width: u32, height: u32) -> (Arc<Scene>, Frame) {
    let scene = hall_of_mirrors().build();
    let frame = frame(
        &scene,
        camera(vec3(0.3, 0.6, 2.7), vec3(0.0, -0.2, 0.0), 70.0, width, height),
    );
    (scene, frame)
}

/// Oracle: the deepest picture. What is cut is more than that part of the brightest surface, and no more than that part of the
/// brightest that is seen through all of them.
#[test]
fn what_is_cut_is_bounded_through_highlights() {
    let scene = hall_of_highlights().build();
    let eye = camera(vec3(0.3, 0.6, 2.7), vec3(0.0, -0.2, 0.0), 70.0, 48, 36);
    let deepest = frame(&scene, eye);
    let full = picture(&scene, &deepest);
    let [first, through] = [scene.brightest(&deepest.light), scene.brightest_through(&deepest.light)];
    let (mut exceeds, mut largest) = (false, 0.0_f32);
    for depth in 0..MAX_DEPTH {
        let here = picture(&scene, &Frame { depth, ..deepest });
        for ((full, sum), work) in full.sums.iter().zip(&here.sums).zip(&here.work) {
            let missing = (mean(*full) - mean(*sum)).abs();
            assert!(
                (missing - through * work.z).max_element() <= 1e-5,
                "depth {depth}: {missing}"
            );
            exceeds |= (missing - first * work.z).max_element() > 0.1;
            largest = largest.max((missing / (through * work.z)).max_element());
        }
    }
    assert!(exceeds, "there is nothing to see through highlights");
    assert!(largest > 0.3, "the bound is {largest} of what it could be");
}

/// Oracle: the deepest picture. What is missing or too much at a smaller depth, or with a cut-off, is nowhere more than what
/// was cut, for nothing is brighter than 1 (and 1e-5 for rounding), also in steps of the output; and at depth 0 there is one
/// ray a pixel.
#[test]
fn what_is_cut_bounds_what_is_missing() {
    let (scene, deepest) = hall(96, 72);
    let full = picture(&scene, &deepest);
    for (depth, cutoff) in (0..=MAX_DEPTH)
        .map(|depth| (depth, 0.0))
        .chain([(MAX_DEPTH, 1.0), (MAX_DEPTH, 20.0)])
    {
        let frame = Frame {
            depth,
            cutoff,
            ..deepest
        };
        let here = picture(&scene, &frame);
        let (mut most_missing, mut cut_sum) = (0.0_f32, 0.0);
        for (i, (sum, work)) in here.sums.iter().zip(&here.work).enumerate() {
            let missing = (mean(full.sums[i]) - mean(*sum)).abs();
            assert!(
                missing.max_element() <= work.z + 1e-5,
                "depth {depth}: {missing} is missing, {} was cut",
                work.z
            );
            assert!(work.x >= 1.0 && (depth > 0 || work.x == 1.0));
            let off = (encoded(&frame, mean(full.sums[i])) - encoded(&frame, mean(*sum))).abs() * STEPS;
            let bound = steps(&frame, mean(*sum), frame.brightest * work.z);
            assert!(
                off.max_element() <= bound + 0.01,
                "depth {depth}: {off} steps, {bound} were cut"
            );
            most_missing = most_missing.max(missing.max_element());
            cut_sum += work.z;
        }
        println!(
            "depth {depth}, cut-off {cutoff}: at most {most_missing:.4} missing, {:.4} cut a pixel",
            cut_sum / 6912.0
        );
        let is_deepest = depth == MAX_DEPTH && cutoff == 0.0;
        assert!(is_deepest || most_missing > 0.0 && cut_sum > 0.0);
    }
}

/// Panes one behind the other, each of whose surfaces reflects half and lets half through: every ray becomes two.
fn panes(count: u32) -> (Arc<Scene>, Frame) {
    let mut stage = Stage::default();
    let half = stage.material(Material {
        mirror: Vec3::splat(0.5),
        transmission: Vec3::splat(0.5),
        ..clear(1.0)
    });
    for i in 0..count {
        let top = -2.0 * i as f32;
        stage.mesh(&block(vec3(-40.0, top - 1.0, -40.0), vec3(40.0, top, 40.0)), half);
    }
    stage.model.environment = Environment::constant(Vec3::ONE);
    let scene = stage.build();
    let frame = frame(&scene, camera(Vec3::Y, Vec3::ZERO, 40.0, 8, 8));
    (scene, frame)
}

/// Oracle: counting. At depth `d`, in the middle of so many panes that none of the light leaves, there are
/// `2^(d + 1) - 1` rays, until there are [`MAX_RAYS`]; then only those are followed that wait already, at most
/// [`MAX_DEPTH`]. All light is seen, that of the rays that are cut in the environment, to 1e-4 (thousands of roundings).
#[test]
fn the_tree_is_bounded() {
    let (scene, deepest) = panes(30);
    let ray = Ray::new(vec3(0.1, -30.5, 0.2), vec3(0.3, -1.0, 0.1));
    for depth in 0..=MAX_DEPTH {
        let frame = Frame { depth, ..deepest };
        let traced = see(&scene, &frame, &ray);
        let whole = (1 << (depth + 1)) - 1;
        println!("depth {depth}: {} rays of {whole}, {} cut", traced.rays, traced.cut);
        if whole <= MAX_RAYS {
            assert_eq!(traced.rays, whole, "depth {depth}");
        } else {
            assert!((MAX_RAYS..=MAX_RAYS + MAX_DEPTH).contains(&traced.rays));
        }
        assert!(traced.cut > 0.0 && traced.cut < 1.0 + 1e-4);
        assert!((traced.color - 1.0).abs().max_element() < 1e-4);
    }
}

/// A frame that asks for more than [`MAX_DEPTH`] gets as much. Oracle: the picture of that depth.
#[test]
fn deeper_than_deepest_is_deepest() {
    let (scene, deepest) = hall(24, 18);
    let deeper = Frame { depth: 1000, ..deepest };
    assert_eq!(picture(&scene, &deepest), picture(&scene, &deeper));
}

/// Oracle: the CPU, whose tracer the tests above hold against analysis; tolerance as for all pictures of two back ends.
///
/// Rays that could change four steps of the output at most are cut: lavapipe leaves every loop of a pixel when their iterations together
/// have become 65,535.
#[test]
#[ignore = "needs a Vulkan driver"]
fn both_back_ends_agree_at_every_depth() {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        module: ModulePath::Auto,
        ..GpuOptions::default()
    });
    let gpu = Arc::new(gpu.expect("a Vulkan driver is installed"));
    let mut stage = hall_of_mirrors();
    stage.model.lights = vec![
        point_light(vec3(0.5, 2.0, 1.0), Vec3::splat(0.5)),
        directional_light(vec3(1.0, 2.0, 0.5), Vec3::splat(0.3)),
    ];
    let scene = stage.build();
    let mut backend = GpuBackend::new(gpu.clone(), &scene).unwrap();
    let camera = camera(vec3(0.3, 0.6, 2.7), vec3(0.0, -0.2, 0.0), 70.0, 320, 240);
    for depth in 0..=MAX_DEPTH {
        let frame = Frame {
            depth,
            cutoff: 4.0,
            ..frame(&scene, camera)
        };
        agree(&format!("hall of mirrors, depth {depth}"), &scene, &mut backend, &frame);
    }
    // Every ray becomes two.
    let (scene, deepest) = panes(30);
    let mut backend = GpuBackend::new(gpu, &scene).unwrap();
    for depth in [1, 4, 8] {
        let frame = Frame { depth, ..deepest };
        agree(&format!("panes, depth {depth}"), &scene, &mut backend, &frame);
    }
}

fn agree(name: &str, scene: &Arc<Scene>, backend: &mut GpuBackend, frame: &Frame) {
    let (here, there) = (picture(scene, frame), backend.render(frame, &silent).unwrap());
    let colors = ColorDifferences::new(&here, &there);
    let rays = |work: &[Vec4]| work.iter().map(|work| f64::from(work.x)).sum::<f64>();
    let (cpu_rays, gpu_rays) = (rays(&here.work), rays(&there.work));
    let most = here.work.iter().map(|work| work.x).fold(0.0, f32::max);
    println!("{name}: {colors}; {cpu_rays} and {gpu_rays} rays, up to {most} a pixel");
    assert!(colors.agree(), "{name}");
    assert!((cpu_rays / gpu_rays - 1.0).abs() < 1e-3, "{name}");
}
