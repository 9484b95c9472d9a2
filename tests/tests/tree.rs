//! Trees of boxes: their rules on meshes that are hard to part, and what they cost.

#![cfg(test)]

use glam::Vec3;
use oktant::build_error::BuildError;
use oktant::costs::Costs;
use oktant::generated::{bumpy_ball, knot, room, soup, teapot_in_stadium};
use oktant::mesh::Mesh;
use oktant::mesh_source::MeshSource;
use oktant::model::Model;
use oktant::progress::silent;
use oktant::scene::{Memory, Scene};
use oktant::shapes::stadium;
use oktant::structure::StructureOptions;
use oktant::tree::{BinaryTree, BuildPreset, CollapseOptions, MAX_LEAF, WideTree};
use oktant_shared::brute::Brute;
use oktant_shared::hit::Hit;
use oktant_shared::octants::MAX_LEVEL;
use oktant_shared::parts::TraversalKind;
use oktant_shared::ray::Ray;
use oktant_shared::traversal::{Standard, Traversal};
use oktant_shared::triangle_test::Watertight;
use oktant_tests::data::reference;
use oktant_tests::meshes;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use std::time::Instant;

fn bare(corners: impl IntoIterator<Item = [Vec3; 3]>) -> Mesh {
    let positions: Vec<Vec3> = corners.into_iter().flatten().collect();
    Mesh {
        triangles: (0..positions.len() as u32 / 3)
            .map(|id| [3 * id, 3 * id + 1, 3 * id + 2])
            .collect(),
        positions,
        ..Mesh::default()
    }
}

fn moved(mut mesh: Mesh, offset: Vec3) -> Mesh {
    for position in &mut mesh.positions {
        *position += offset;
    }
    mesh
}

/// Every seventh triangle without area.
fn with_flat_ones(mut mesh: Mesh) -> Mesh {
    for [a, b, _] in mesh.triangles.iter_mut().step_by(7) {
        *b = *a;
    }
    mesh
}

const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

/// Meshes that builders find hard.
fn hard_meshes() -> Vec<(&'static str, Mesh)> {
    // Triangles with one centre, each around the one before.
    let nested = (1..3_000).map(|size| [Vec3::NEG_X, Vec3::X - Vec3::Y, Vec3::X + Vec3::Y].map(|p| p * size as f32));
    // A chain in which every step is twice the one before: nothing parts it evenly.
    let doubling = (-100..39).map(|power| TRIANGLE.map(|p| (p + Vec3::X) * 2.0_f32.powi(power)));
    let blades = (0..20_000).map(|blade| {
        let turn = |blade: i32| {
            let (y, x) = (blade as f32 * 3e-4).sin_cos();
            Vec3::new(x, y, 0.0) * 100.0
        };
        [Vec3::ZERO, turn(blade), turn(blade + 1)]
    });
    vec![
        ("one", bare([TRIANGLE])),
        ("two", bare([TRIANGLE, TRIANGLE.map(|p| p + Vec3::Z)])),
        ("five", bare((0..5).map(|i| TRIANGLE.map(|p| p + Vec3::Z * i as f32)))),
        ("identical pair", bare([TRIANGLE; 2])),
        ("identical", bare([TRIANGLE; 5_000])),
        ("nested", bare(nested)),
        ("doubling", bare(doubling)),
        ("long fan", bare(blades)),
        ("fan", meshes::fan_64()),
        ("flat grid", meshes::flat_grid(64)),
        ("soup", meshes::soup(20_000, 1)),
        ("soup with flat ones", with_flat_ones(meshes::soup(20_000, 3))),
        (
            "at the end of f32",
            bare([[Vec3::ZERO, Vec3::Y, Vec3::Z].map(|p| p + Vec3::X * 2e38)]),
        ),
        ("far away", moved(meshes::soup(5_000, 2), Vec3::new(1e6, -3e7, 2e5))),
        ("room", meshes::room()),
        ("stadium", stadium()),
        ("icosphere", meshes::icosphere(5)),
    ]
}

fn with_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap()
        .install(work)
}

#[test]
fn every_preset_builds_valid_trees_of_hard_meshes() {
    for (name, mesh) in hard_meshes() {
        for preset in BuildPreset::ALL {
            let binary = BinaryTree::build(&mesh, preset, &silent).unwrap();
            binary
                .validate(&mesh)
                .unwrap_or_else(|error| panic!("{name} {preset:?}: {error}"));
            for leaf in 1..=MAX_LEAF {
                let options = CollapseOptions {
                    leaf,
                    ..CollapseOptions::default()
                };
                let wide = WideTree::of(&binary, &options);
                wide.validate(&mesh, MAX_LEVEL)
                    .unwrap_or_else(|error| panic!("{name} {preset:?}: {error}"));
            }
            let wide = WideTree::build(&mesh, preset, &silent).unwrap();
            wide.validate(&mesh, MAX_LEVEL)
                .unwrap_or_else(|error| panic!("{name} {preset:?}: {error}"));
        }
    }
}

/// The cheapest wide tree with larger leaves allowed is no dearer.
#[test]
fn more_freedom_costs_no_more() {
    for mesh in [meshes::room(), meshes::icosphere(5)] {
        let binary = BinaryTree::build(&mesh, BuildPreset::Balanced, &silent).unwrap();
        let costs = (1..=MAX_LEAF).map(|leaf| {
            let options = CollapseOptions {
                leaf,
                ..CollapseOptions::default()
            };
            WideTree::of(&binary, &options).figures(&options.costs).cost
        });
        let costs: Vec<f64> = costs.collect();
        assert!(costs.is_sorted_by(|a, b| *b <= a * 1.000_01), "{costs:?}");
        assert!(costs[2] < 0.99 * costs[0], "leaves of several triangles pay: {costs:?}");
    }
}

/// Triangles whose boxes overlap much make many small nodes, and large structures, unless nodes are filled.
#[test]
fn no_structure_takes_more_than_72_bytes_a_triangle() {
    let bunny = MeshSource::Bunny.load(&silent).unwrap();
    for (name, mesh) in [
        ("bunny", bunny),
        ("room", room().mesh),
        ("teapot in a stadium", teapot_in_stadium().mesh),
        ("ball", bumpy_ball(100_000)),
        ("knot", knot(100_000)),
        ("soup of 1,000", soup(1_000)),
        ("soup of 100,000", soup(100_000)),
        ("soup of 1,000,000", soup(1_000_000)),
    ] {
        for preset in BuildPreset::ALL {
            if preset == BuildPreset::Quality && mesh.triangles.len() > 500_000 {
                // It takes too long.
                continue;
            }
            let options = StructureOptions {
                preset,
                ..StructureOptions::default()
            };
            let scene = Scene::new(&mesh, &options, &silent).unwrap();
            let each = Memory::of(&scene).traced() as f64 / mesh.triangles.len() as f64;
            println!("{name}, {}: {each:.2}", preset.name());
            assert!(each <= 72.0, "{name}, {}: {each}", preset.name());
        }
    }
}

/// The cheapest tree by the surface area heuristic, whatever its nodes, is the oracle.
#[test]
fn fuller_nodes_cost_little_and_only_where_they_are_needed() {
    let unlimited = CollapseOptions {
        nodes: f32::INFINITY,
        ..CollapseOptions::default()
    };
    for (name, mesh, is_needed) in [
        ("icosphere", meshes::icosphere(6), false),
        ("room", room().mesh, false),
        ("soup", soup(200_000), true),
    ] {
        let binary = BinaryTree::build(&mesh, BuildPreset::Balanced, &silent).unwrap();
        let [cheapest, filled] = [unlimited, CollapseOptions::default()].map(|options| WideTree::of(&binary, &options));
        let [before, after] = [&cheapest, &filled].map(|tree| tree.figures(&Costs::OCTANTS));
        println!("{name}: {before:?} {after:?}");
        assert_eq!(cheapest.nodes != filled.nodes, is_needed, "{name}");
        assert!(after.cost <= 1.01 * before.cost, "{name}: {before:?} {after:?}");
        let limit = f64::from(CollapseOptions::default().nodes) * mesh.triangles.len() as f64;
        assert!(after.nodes as f64 <= limit, "{name}: {after:?}");
        assert_eq!(before.nodes as f64 > limit, is_needed, "{name}: {before:?}");
    }
}

/// What a build spends more time on is worth it.
#[test]
fn presets_are_in_the_order_of_their_costs() {
    for (name, mesh) in [("room", meshes::room()), ("icosphere", meshes::icosphere(6))] {
        let options = CollapseOptions::default();
        let [fast, balanced, quality] = BuildPreset::ALL.map(|preset| {
            let tree = WideTree::build(&mesh, preset, &silent).unwrap();
            tree.figures(&options.costs).cost
        });
        println!("{name}: {fast} {balanced} {quality}");
        assert!(
            fast > balanced && balanced > quality,
            "{name}: {fast} {balanced} {quality}"
        );
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for (name, mesh) in hard_meshes() {
        for preset in BuildPreset::ALL {
            let build = |threads| {
                with_threads(threads, || {
                    let binary = BinaryTree::build(&mesh, preset, &silent).unwrap();
                    (WideTree::build(&mesh, preset, &silent).unwrap(), binary)
                })
            };
            let (wide, binary) = build(1);
            for threads in [2, 5] {
                let (other_wide, other_binary) = build(threads);
                let same = binary.nodes[..] == other_binary.nodes[..] && binary.order == other_binary.order;
                assert!(same, "{name} {preset:?} {threads} threads: binary tree");
                let same = wide.nodes == other_wide.nodes && wide.order == other_wide.order;
                assert!(same, "{name} {preset:?} {threads} threads: wide tree");
            }
        }
    }
}

/// Oracle: brute force. What is built is the same on any number of threads, and rays hit in it what they hit without it.
#[test]
fn rays_hit_what_they_hit_without_a_tree() {
    let brute = StructureOptions::of(TraversalKind::Brute);
    for (name, mesh) in [
        ("soup", with_flat_ones(meshes::soup(30_000, 5))),
        ("icosphere", meshes::icosphere(6)),
        ("room", meshes::room()),
    ] {
        let all = Scene::new(&mesh, &brute, &silent).unwrap();
        let (low, high) = mesh.bounds().unwrap();
        let mut random = fastrand::Rng::with_seed(3);
        let mut place = || low + (high - low) * Vec3::new(random.f32(), random.f32(), random.f32()) * 1.2;
        let rays: Vec<Ray> = (0..300)
            .map(|_| {
                let origin = place();
                Ray::new(origin, place() - origin)
            })
            .collect();
        let expected: Vec<Hit> = rays
            .par_iter()
            .map(|ray| {
                all.view()
                    .identified(Brute::<Watertight>::closest_hit(&all.view(), ray))
            })
            .collect();
        assert!(expected.iter().any(Hit::is_hit));
        for preset in BuildPreset::ALL {
            let options = StructureOptions {
                preset,
                ..StructureOptions::default()
            };
            let scenes =
                [1, 2, 5].map(|threads| with_threads(threads, || Scene::new(&mesh, &options, &silent).unwrap()));
            for other in &scenes[1..] {
                let same = scenes[0].nodes == other.nodes
                    && scenes[0].ids == other.ids
                    && scenes[0].triangles == other.triangles;
                assert!(same, "{name} {preset:?}: not the same on any number of threads");
            }
            let view = scenes[0].view();
            for (ray, expected) in rays.iter().zip(&expected) {
                let hit = view.identified(Standard::closest_hit(&view, ray));
                assert_eq!(
                    (hit.t, hit.triangle),
                    (expected.t, expected.triangle),
                    "{name} {preset:?} {ray:?}"
                );
            }
        }
    }
}

#[test]
fn triangles_without_area_are_left_out_and_counted() {
    let flat = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
    for preset in BuildPreset::ALL {
        let tree = BinaryTree::build(&bare([flat, TRIANGLE, flat]), preset, &silent).unwrap();
        assert_eq!((tree.order, tree.degenerate), (vec![1], 2));
        let build = |mesh: &Mesh| BinaryTree::build(mesh, preset, &silent).unwrap_err();
        assert_eq!(build(&bare([flat])), BuildError::NoArea);
        assert_eq!(build(&Mesh::default()), BuildError::NoArea);
        assert_eq!(build(&bare([TRIANGLE.map(|p| p * 1e13)])), BuildError::Extent(1e13));
        assert_eq!(build(&bare([TRIANGLE.map(|p| p * 1e-13)])), BuildError::Extent(1e-13));
    }
}

/// `mesh` four times as fine: every triangle cut at the middles of its edges.
fn finer(mesh: &Mesh) -> Mesh {
    bare(mesh.triangles.iter().flat_map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let (ab, bc, ca) = ((a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    }))
}

#[test]
#[ignore = "measures time"]
fn builds_are_measured() {
    let load = |name: &str| oktant::ply::read(&reference(name), &silent).unwrap();
    let dragon = load("meshes/dragon-871k.ply");
    let finer = finer(&dragon);
    println!(
        "mesh, preset, threads; ms from mesh to scene, median and least; cost; nodes; levels; children a node; triangles a \
         leaf; bytes a triangle"
    );
    for (name, mesh) in [
        ("bunny", load("meshes/bunny-69k.ply")),
        ("dragon", dragon),
        ("finer", finer),
    ] {
        for preset in BuildPreset::ALL {
            if name == "finer" && preset == BuildPreset::Quality {
                // A quarter of a minute each time.
                continue;
            }
            let options = StructureOptions {
                preset,
                ..StructureOptions::default()
            };
            let mut bytes = 0;
            for threads in [1, 2] {
                let mut times: Vec<f64> = (0..7)
                    .map(|_| {
                        let model = Model::of_mesh(mesh.clone());
                        with_threads(threads, || {
                            let start = Instant::now();
                            let scene = Scene::of_model(model, &options, &silent).unwrap();
                            let time = start.elapsed().as_secs_f64();
                            bytes = Memory::of(&scene).traced();
                            time
                        })
                    })
                    .collect();
                times.sort_by(f64::total_cmp);
                let wide = WideTree::build(&mesh, preset, &silent).unwrap();
                let figures = wide.figures(&Costs::OCTANTS);
                println!(
                    "{name:8} {:9} {threads} {:8.1} {:8.1} {:7.2} {:8} {:3} {:5.2} {:5.2} {:5.1}",
                    preset.name(),
                    1e3 * times[times.len() / 2],
                    1e3 * times[0],
                    figures.cost,
                    figures.nodes,
                    figures.depth,
                    figures.children,
                    figures.triangles,
                    bytes as f64 / mesh.triangles.len() as f64,
                );
            }
        }
    }
}

/// 1,600 triangles of sizes from 2^38 down to 2^-120, in several shapes: of the smaller ones f32 holds no surface, so that any
/// tree of them costs the same, and a chain of nodes with two children each as much as one that is full.
fn dwindling() -> Vec<(&'static str, Mesh)> {
    const STEPS: i32 = 1_600;
    let size = |step: i32, of: i32| 2.0_f32.powf(38.0 - 158.0 * step as f32 / of as f32);
    let corner = [Vec3::X, Vec3::Y, Vec3::Z];
    let chain = |steps: i32, place: fn(i32) -> Vec3| {
        bare((0..steps).map(move |step| corner.map(|corner| (place(step) + corner) * size(step, steps))))
    };
    let in_octants = |step: i32| Vec3::from_array([1, 2, 4].map(|bit| if step & bit == 0 { 1.0 } else { -1.0 }));
    let mut random = fastrand::Rng::with_seed(1);
    let mut anywhere = || Vec3::from_array([(); 3].map(|()| random.f32() - 0.5));
    let around: Vec<[Vec3; 3]> = (0..STEPS)
        .map(|step| [anywhere(), anywhere(), anywhere()].map(|corner| corner * size(step, STEPS)))
        .collect();
    // As many of each size, side by side.
    let crowds = (0..STEPS).map(|id| {
        let beside = Vec3::splat(1.0 + (id % 10) as f32 * 0.1);
        corner.map(|corner| (beside + corner * 0.05) * size(id / 10, STEPS / 10))
    });
    let halves = chain(158, |_| Vec3::ONE);
    vec![
        ("along the diagonal", chain(STEPS, |_| Vec3::ONE)),
        ("half as large each", halves),
        ("in one corner", chain(STEPS, |_| Vec3::ZERO)),
        (
            "to both sides",
            chain(STEPS, |step| Vec3::splat([1.0, -1.0][step as usize % 2])),
        ),
        ("in all octants", chain(STEPS, in_octants)),
        ("around the middle", bare(around)),
        ("ten of each size", bare(crowds)),
    ]
}

/// Kernels have a stack for so many levels, and no mesh may need more.
#[test]
fn no_node_is_deeper_than_kernels_go() {
    let unlimited = CollapseOptions {
        levels: u32::MAX,
        ..CollapseOptions::default()
    };
    let mut deepest = 0;
    for (name, mesh) in dwindling() {
        for preset in BuildPreset::ALL {
            let depth = |tree: &WideTree| tree.figures(&Costs::OCTANTS).depth;
            let binary = BinaryTree::build(&mesh, preset, &silent).unwrap();
            let cheapest = depth(&WideTree::of(&binary, &unlimited));
            let tree = WideTree::build(&mesh, preset, &silent).unwrap();
            println!("{name} {}: {cheapest} {}", preset.name(), depth(&tree));
            for tree in [tree, WideTree::of(&binary, &CollapseOptions::default())] {
                tree.validate(&mesh, MAX_LEVEL)
                    .unwrap_or_else(|error| panic!("{name} {preset:?}: {error}"));
            }
            let options = StructureOptions {
                preset,
                ..StructureOptions::default()
            };
            Scene::new(&mesh, &options, &silent).unwrap_or_else(|error| panic!("{name} {preset:?}: {error}"));
            deepest = deepest.max(cheapest);
        }
    }
    assert!(deepest > MAX_LEVEL, "these meshes are too easy: {deepest}");
}
