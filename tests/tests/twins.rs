//! The two sides of the one source: the CPU and the GPU must agree.
//!
//! All tests here need a Vulkan driver; lavapipe will do. They take the best adapter there is.

#![cfg(test)]

use glam::{Vec3, Vec4, vec3};
use oktant::backend::cpu::Cpu;
use oktant::backend::gpu::{FusedMultiplyAdd, Gpu, GpuBackend, GpuOptions, Kernel, ModulePath};
use oktant::backend::{Backend, BackendError};
use oktant::balls::balls;
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::model::Model;
use oktant::progress::silent;
use oktant::projection::Projection;
use oktant::sampling::Samples;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant::view::{Place, Shading, View};
use oktant_shared::aabb::Aabb;
use oktant_shared::arithmetic::{difference_of_products, fused_multiply_add, min, multiply_subtract};
use oktant_shared::box_test::{BoxTest, KayKajiya, Williams};
use oktant_shared::color::{linear_color, srgb_from_linear};
use oktant_shared::hit::Hit;
use oktant_shared::plane::Plane;
use oktant_shared::ray::{PreparedRay, Ray};
use oktant_shared::secondary_origin::secondary_origin;
use oktant_shared::triangle::Triangle;
use oktant_shared::triangle_test::{BaldwinWeber, MollerTrumbore, Plucker, TriangleTest, Watertight};
use oktant_tests::compare::{ColorDifferences, HitDifferences};
use oktant_tests::data::reference;
use std::path::Path;
use std::sync::Arc;

fn open(module: ModulePath) -> Arc<Gpu> {
    let gpu = Gpu::open(&GpuOptions {
        software: true,
        module,
        ..GpuOptions::default()
    })
    .expect("a Vulkan driver is installed");
    println!("{}, passed through: {}", gpu.name, gpu.passthrough);
    Arc::new(gpu)
}

/// Cameras and lights: from in front, from behind and above, close by, and without perspective.
fn views() -> [View; 4] {
    let view = |azimuth, elevation, distance, light| View {
        camera: Place {
            azimuth,
            elevation,
            distance,
        },
        light: Place {
            azimuth: light,
            ..View::default().light
        },
        ..View::default()
    };
    [
        View::default(),
        view(160.0, 40.0, 3.0, 120.0),
        View {
            shading: Shading::Flat,
            ..view(-70.0, 5.0, 1.4, -20.0)
        },
        View {
            projection: Projection::Orthographic,
            ortho_height: Some(1.7),
            ..view(33.0, 25.0, 2.0, 60.0)
        },
    ]
}

fn sides_agree(name: &str, mesh: &Mesh, module: ModulePath) {
    let scene = Arc::new(Scene::new(mesh, &StructureOptions::default(), &silent).unwrap());
    let mut cpu = Cpu::new(scene.clone());
    let mut gpu = GpuBackend::new(open(module), &scene).unwrap();
    for (index, view) in views().iter().enumerate() {
        let frame = view.frame(&scene, 1280, 968);
        let hits = HitDifferences::new(&cpu.hits(&frame).unwrap(), &gpu.hits(&frame).unwrap());
        println!("{name}, view {index}: {hits}");
        let colors = ColorDifferences::new(
            &cpu.render(&frame, &silent).unwrap(),
            &gpu.render(&frame, &silent).unwrap(),
        );
        println!("{name}, view {index}: {colors}");
        assert!(hits.agree() && colors.agree(), "{name}, view {index}");
    }
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn bunny_passed_through() {
    sides_agree(
        "bunny",
        &MeshSource::Bunny.load(&silent).unwrap(),
        ModulePath::Passthrough,
    );
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn bunny_through_naga() {
    sides_agree("bunny", &MeshSource::Bunny.load(&silent).unwrap(), ModulePath::Naga);
}

#[test]
#[ignore = "needs a Vulkan driver and the reference data"]
fn dragon_passed_through() {
    let source = MeshSource::File(reference("meshes/dragon-202k.ply"));
    sides_agree("dragon", &source.load(&silent).unwrap(), ModulePath::Passthrough);
}

#[test]
#[ignore = "needs a Vulkan driver and the reference data"]
fn dragon_through_naga() {
    let source = MeshSource::File(reference("meshes/dragon-202k.ply"));
    sides_agree("dragon", &source.load(&silent).unwrap(), ModulePath::Naga);
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn every_pixel_is_written_at_any_size() {
    let scene = Arc::new(Scene::new(&balls(), &StructureOptions::default(), &silent).unwrap());
    let mut cpu = Cpu::new(scene.clone());
    let mut gpu = GpuBackend::new(open(ModulePath::Auto), &scene).unwrap();
    for (width, height) in [(1, 1), (7, 3), (65, 33), (200, 151)] {
        for samples in Samples::ALL {
            let view = View {
                samples,
                ..View::default()
            };
            let frame = view.frame(&scene, width, height);
            for backend in [&mut cpu as &mut dyn Backend, &mut gpu] {
                let picture = backend.render(&frame, &silent).unwrap();
                assert_eq!(picture.sums.len(), (width * height) as usize);
                assert!(
                    picture.sums.iter().all(|sum| sum.w == samples.count() as f32),
                    "{width} x {height}, {samples:?} on {}",
                    backend.name()
                );
            }
        }
    }
}

/// More pixels with trees of rays than one dispatch takes: the picture is rendered in bands, each sample by itself.
#[test]
#[ignore = "needs a Vulkan driver"]
fn pictures_in_bands_have_no_seams() {
    let mut model = Model::of_mesh(balls());
    model.planes.push(Plane::new(Vec3::ZERO, Vec3::Y, 0));
    let scene = Arc::new(Scene::of_model(model, &StructureOptions::default(), &silent).unwrap());
    let view = View {
        samples: Samples::Four,
        ..View::default()
    };
    let frame = view.frame(&scene, 1501, 1503);
    let cpu = Cpu::new(scene.clone()).render(&frame, &silent).unwrap();
    let gpu = GpuBackend::new(open(ModulePath::Auto), &scene)
        .unwrap()
        .render(&frame, &silent)
        .unwrap();
    assert!(gpu.sums.iter().all(|sum| sum.w == 4.0), "no pixel twice");
    let colors = ColorDifferences::new(&cpu, &gpu);
    println!("bands: {colors}");
    assert!(colors.agree());
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn colors_of_vertices_reach_the_picture() {
    let mut mesh = balls();
    mesh.colors = mesh
        .positions
        .iter()
        .map(|p| [(p.x * 60.0 + 128.0) as u8, (p.y * 100.0) as u8, 40, 255])
        .collect();
    sides_agree("coloured balls", &mesh, ModulePath::Auto);
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn what_does_not_fit_is_refused_in_a_sentence() {
    let scene = Scene::new(&balls(), &StructureOptions::default(), &silent).unwrap();
    let gpu = open(ModulePath::Auto);
    let mut backend = GpuBackend::new(gpu, &scene).unwrap();
    // 16 bytes a pixel: more than any device binds.
    let frame = View::default().frame(&scene, 1 << 15, 1 << 15);
    let error = backend.render(&frame, &silent).unwrap_err();
    assert!(matches!(error, BackendError::TooLarge { bytes, limit, .. } if bytes == 16 << 30 && limit < bytes));
    assert!(error.to_string().contains("--backend cpu"), "{error}");
    // Nothing is broken by it.
    let frame = View::default().frame(&scene, 64, 64);
    assert!(backend.render(&frame, &silent).is_ok());
}

/// Numbers of all signs and sizes.
fn numbers(count: usize, seed: u64) -> Vec<f32> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..count)
        .map(|_| (random.f32() - 0.5) * 2.0_f32.powi(random.i32(-20..20)))
        .collect()
}

fn points(count: usize, seed: u64) -> Vec<Vec3> {
    numbers(count * 3, seed).chunks(3).map(Vec3::from_slice).collect()
}

fn close(a: f32, b: f32, relative: f32) -> bool {
    (a - b).abs() <= relative * a.abs().max(b.abs())
}

const COUNT: usize = 100_000;

#[test]
#[ignore = "needs a Vulkan driver"]
fn arithmetic_probe() {
    for module in [ModulePath::Passthrough, ModulePath::Naga] {
        let gpu = open(module);
        let mut operands: Vec<Vec4> = numbers(COUNT * 4, 1).chunks(4).map(Vec4::from_slice).collect();
        let turned: Vec<Vec4> = operands.iter().map(|o| Vec4::new(o.z, o.w, o.x, o.y)).collect();
        let above_one = 1.0 + f32::EPSILON;
        operands.push(Vec4::new(above_one, above_one, -(1.0 + 2.0 * f32::EPSILON), 0.0));
        let results = gpu.probe_one("probe_arithmetic", &operands).unwrap();
        // Vulkan leaves it to the driver; the triangle test is watertight either way, but not where it is sometimes so.
        let fused = results[COUNT].x == f32::EPSILON * f32::EPSILON;
        println!("fused multiply-add rounds once: {fused}");
        let told = gpu.fused_multiply_add();
        assert_eq!(told == FusedMultiplyAdd::Fused, fused, "{told}");
        assert_ne!(told, FusedMultiplyAdd::Unknown);
        for (r, turned) in results.iter().zip(gpu.probe_one("probe_arithmetic", &turned).unwrap()) {
            let sign = |y: f32| (y > 0.0, y < 0.0);
            assert_eq!(
                sign(r.y),
                sign(-turned.y),
                "two triangles are on opposite sides of their edge"
            );
        }
        for (o, r) in operands.iter().zip(&results) {
            let exact = f64::from(o.x) * f64::from(o.y) - f64::from(o.z) * f64::from(o.w);
            if fused {
                assert_eq!(r.x, fused_multiply_add(o.x, o.y, o.z), "{o}");
                assert_eq!(r.y > 0.0, exact > 0.0, "{o}: the sign is exact");
                assert!(close(r.y, exact as f32, 3e-7), "{o}");
            } else {
                assert_eq!(r.x, o.x * o.y + o.z, "{o}");
                assert_eq!(r.y, o.x * o.y - o.z * o.w, "{o}");
            }
            let plain = difference_of_products(o.x, o.y, o.z, o.w);
            let size = (o.x * o.y).abs() + (o.z * o.w).abs();
            assert!((plain - r.y).abs() <= 1.2e-7 * size, "{o}");
            assert!((r.z - multiply_subtract(o.x, o.y, o.z)).abs() <= 1.2e-7 * ((o.x * o.y).abs() + o.z.abs()));
            assert_eq!(r.w, min(o.x, o.y), "{o}");
        }
    }
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn box_test_probe() {
    let gpu = open(ModulePath::Auto);
    let (origins, targets, corners) = (points(COUNT, 2), points(COUNT, 3), points(COUNT * 2, 4));
    let rays: Vec<Ray> = origins
        .iter()
        .zip(&targets)
        .map(|(o, t)| Ray::new(*o, *t - *o))
        .collect();
    let boxes: Vec<[Vec4; 2]> = corners
        .chunks(2)
        .map(|c| [c[0].min(c[1]).extend(0.0), c[0].max(c[1]).extend(0.0)])
        .collect();
    let results = gpu.probe_two("probe_box_tests", &rays, &boxes).unwrap();
    for ((ray, corners), r) in rays.iter().zip(&boxes).zip(&results) {
        let ray = PreparedRay::new(ray);
        let aabb = Aabb {
            low: corners[0].truncate(),
            high: corners[1].truncate(),
        };
        let kay_kajiya = KayKajiya::prepare(&ray).interval(&aabb);
        let williams = Williams::prepare(&ray).interval(&aabb);
        assert!(close(r.x, kay_kajiya.enter, 1e-6) && close(r.y, kay_kajiya.exit, 1e-6));
        assert!(close(r.z, williams.enter, 1e-6) && close(r.w, williams.exit, 1e-6));
    }
}

/// The module of `kernel/probes` on the device.
fn open_probes() -> Gpu {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernel/compiled/probes/oktant.spv");
    let probes = Kernel::read_probes(&path).unwrap_or_else(|error| panic!("{error}"));
    open(ModulePath::Auto).with_probes(Arc::new(probes)).unwrap()
}

fn triangle_probe<T: TriangleTest>(entry: &'static str) {
    let gpu = open_probes();
    let mut random = fastrand::Rng::with_seed(5);
    let mut inside = || vec3(random.f32() - 0.5, random.f32() - 0.5, random.f32() - 0.5);
    let triangles: Vec<Triangle> = (0..COUNT)
        .map(|_| Triangle {
            a: inside(),
            b: inside(),
            c: inside(),
            ..bytemuck::Zeroable::zeroed()
        })
        .collect();
    let rays: Vec<Ray> = (0..COUNT)
        .map(|_| Ray::new(inside() + vec3(0.0, 0.0, -2.0), Vec3::Z + inside() * 0.5))
        .collect();
    let results = gpu.probe_two(entry, &rays, &triangles).unwrap();
    let mut crossed = 0;
    let mut other = 0;
    for ((ray, triangle), r) in rays.iter().zip(&triangles).zip(&results) {
        let here = T::prepare(&PreparedRay::new(ray)).crossing(triangle);
        crossed += u32::from(here.crosses);
        if here.crosses != (r.w == 1.0) {
            other += 1;
        } else if here.crosses {
            // Slivers seen edge-on have no well-defined t; the bound is loose enough for them.
            assert!(close(r.x, here.t, 1e-3), "{ray:?} {triangle:?}");
            assert!((r.y - here.u).abs() < 1e-3 && (r.z - here.v).abs() < 1e-3);
        }
    }
    println!("{entry}: {crossed} cross, {other} on one side only");
    assert!(crossed > 5_000 && other <= 10);
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn moller_trumbore_probe() {
    triangle_probe::<MollerTrumbore>("probe_moller_trumbore");
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn watertight_probe() {
    triangle_probe::<Watertight>("probe_watertight");
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn baldwin_weber_probe() {
    triangle_probe::<BaldwinWeber>("probe_baldwin_weber");
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn plucker_probe() {
    triangle_probe::<Plucker>("probe_plucker");
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn secondary_origin_probe() {
    let gpu = open_probes();
    let corners = points(COUNT * 3, 6);
    let triangles: Vec<Triangle> = corners
        .chunks(3)
        .map(|c| Triangle {
            a: c[0],
            b: c[1],
            c: c[2],
            ..bytemuck::Zeroable::zeroed()
        })
        .collect();
    let mut random = fastrand::Rng::with_seed(7);
    let hits: Vec<Hit> = (0..COUNT)
        .map(|_| Hit {
            u: random.f32() / 2.0,
            v: random.f32() / 2.0,
            ..Hit::miss(0.0)
        })
        .collect();
    let results = gpu.probe_two("probe_secondary_origin", &hits, &triangles).unwrap();
    for ((hit, triangle), r) in hits.iter().zip(&triangles).zip(&results) {
        let here = secondary_origin(triangle, hit, Vec3::Z);
        let size = triangle
            .a
            .abs()
            .max(triangle.b.abs())
            .max(triangle.c.abs())
            .max_element();
        // The more slender a triangle, the farther off it is left, and the more of its area is rounding: fused here, not there.
        let [ab, ac] = [triangle.b, triangle.c].map(|corner| corner.as_dvec3() - triangle.a.as_dvec3());
        let longest = ab
            .length_squared()
            .max(ac.length_squared())
            .max((ac - ab).length_squared());
        let slender = (longest / ab.cross(ac).length()) as f32 / (1 << 24) as f32;
        assert!(
            (r.truncate() - here).abs().max_element() <= size * (1e-6 + 4.0 * slender * slender),
            "{triangle:?} {hit:?}"
        );
    }
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn color_probe() {
    let gpu = open_probes();
    let colors: Vec<u32> = (0..=255).map(|i| i | (255 - i) << 8 | (i / 2) << 16).collect();
    let results = gpu.probe_one("probe_color", &colors).unwrap();
    for (color, r) in colors.iter().zip(&results) {
        let here = linear_color(*color);
        assert!((r.truncate() - here).abs().max_element() < 1e-4, "{color:x}");
        assert!((r.w - srgb_from_linear(here.x)).abs() < 1e-3, "{color:x}");
    }
}
