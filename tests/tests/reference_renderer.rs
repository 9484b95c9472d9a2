#![cfg(test)]
//! The renderer in f32 against the reference in f64, which shares no line with it.

use image::{GrayImage, Luma, Rgb, RgbImage};
use oktant::backend::Backend;
use oktant::backend::cpu::Cpu;
use oktant::compare::{Shot, compare};
use oktant::oracle::whitted::{Reference, Takes};
use oktant::progress::silent;
use oktant::projection::Projection;
use oktant::sampling::{Filter, Pattern, Samples};
use oktant::scene::Scene;
use oktant::seen::Seen;
use oktant::source::{Setting, Source};
use oktant::stereo::{Stereo, StereoMode};
use oktant::structure::StructureOptions;
use oktant::view::{Shading, View};
use oktant_tests::program::run;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Width and height of the pictures, pixels.
const SIZE: [u32; 2] = [96, 72];

/// How far the renderer may be from the reference.
#[derive(Clone, Copy)]
struct Bound {
    /// Pixels that may differ by more than 1 of 255, of all.
    differing: f64,
    /// Mean of FLIP.
    flip: f64,
}

/// Where rays end at what they hit first, or are reflected once: roundings stay roundings.
const DIRECT: Bound = Bound {
    differing: 3e-4,
    flip: 1e-4,
};
/// Where they go on: a rounding grows with each curved surface, and textures of planes near the horizon are a few thousand
/// units away, where f32 tells squares no better than the eye does.
const DEEP: Bound = Bound {
    differing: 1e-2,
    flip: 2e-3,
};

fn load(source: &Source) -> Setting {
    source.load(&silent).unwrap()
}

/// Both pictures of a setting; what is wrong, if anything is.
fn judge(name: &str, setting: &Setting, view: &View, bound: Bound) -> Option<String> {
    let scene = Arc::new(Scene::of_model(setting.model.clone(), &StructureOptions::default(), &silent).unwrap());
    let is = Cpu::new(scene.clone())
        .render(&view.frame(&scene, SIZE[0], SIZE[1]), &silent)
        .unwrap();
    let reference = Reference::new(Arc::new(setting.model.clone())).unwrap();
    let sitting = reference.sitting(view, SIZE, Takes::View);
    let wanted = sitting.render(&AtomicBool::new(false), &silent).unwrap();
    assert_eq!((wanted.width, wanted.height), (is.width, is.height), "{name}");
    let (comparison, _) = compare(&Shot::of_picture(&wanted), &Shot::of_picture(&is), 1.0).unwrap();
    let differing = comparison.differing as f64 / f64::from(is.width * is.height);
    let (flip, largest) = (comparison.flip.mean, comparison.largest);
    println!(
        "{name}: {:.3} % of the pixels differ, at most by {largest:.1} of 255, FLIP {flip:.6}",
        differing * 100.0
    );
    let is_wrong = differing > bound.differing || flip > bound.flip;
    is_wrong.then(|| format!("{name}: {differing} of the pixels differ, FLIP {flip}"))
}

#[test]
fn the_scenes_are_as_the_reference_has_them() {
    let mut wrong = Vec::new();
    for (name, bound) in [
        ("balls", DIRECT),
        ("bumps", DEEP),
        ("bunny", DIRECT),
        ("cornell", DIRECT),
        ("glass", DEEP),
        ("mirrors", DEEP),
        ("stadium", DIRECT),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../assets/scenes/{name}.toml"));
        let setting = load(&Source::Scene(path));
        wrong.extend(judge(name, &setting, &setting.view, bound));
        let mut parallel = View {
            projection: Projection::Orthographic,
            ..setting.view
        };
        wrong.extend(judge(
            &format!("{name} without perspective"),
            &setting,
            &parallel,
            bound,
        ));
        parallel.ortho_height = Some(2.6);
        parallel.camera.azimuth += 40.0;
        wrong.extend(judge(
            &format!("{name} with a height of its own"),
            &setting,
            &parallel,
            bound,
        ));
    }
    let plain = load(&Source::default());
    for shading in [Shading::Flat, Shading::Phong] {
        let view = View { shading, ..plain.view };
        wrong.extend(judge("the plain bunny", &plain, &view, DIRECT));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
}

/// What no scene in `assets/scenes` has: images on surfaces, as heights, and all around; lights of all kinds with falloff;
/// colours of vertices; nested volumes that absorb; and up is z.
const EVERYTHING: &str = r##"
up = "z"
[camera]
position = [1, -7, 3]
look_at = [0, 0, 0.8]
[environment]
image = "sky.png"
strength = 0.9
rotation = 40
[render]
samples = 4
depth = 6
[textures.wall]
file = "wall.png"
repeats = 2
[textures.relief]
file = "relief.png"
[materials.wall]
texture = "wall"
[materials.relief]
bump = "relief"
bump_height = 0.2
highlight = "phong"
mirror = 0.2
fresnel = true
[materials.outer]
transmission = [0.9, 0.95, 1]
absorption = [0.1, 0.3, 0.2]
[materials.inner]
transmission = 0.9
ior = 1.2
priority = 3
[[plane]]
point = [0, 0, 0]
material = "wall"
[[box]]
center = [-2, 0, 0.7]
size = [1, 1, 1.4]
rotate = [0, 0, 25]
material = "relief"
[[sphere]]
center = [0.3, -1, 1]
material = "outer"
[[sphere]]
center = [0.3, -1, 1.2]
radius = 0.5
material = "inner"
[[quad]]
corner = [-4, 2, 0]
edge_u = [8, 0, 0]
edge_v = [0, 0, 4]
material = "wall"
[[mesh]]
name = "stadium"
scale = 0.02
rotate = [90, 0, 0]
translate = [2.5, 0, 0.2]
[[light]]
kind = "area"
corner = [-1, -3, 4]
edge_u = [0, 1, 0.2]
edge_v = [1, 0, 0]
intensity = 20
falloff = "inverse-square"
samples_per_side = 3
[[light]]
kind = "directional"
direction = [1, 2, -3]
intensity = 0.4
[[light]]
position = [3, -3, 2]
color = "#ff8040"
intensity = 2
falloff = "inverse-square"
radius = 0.1
range = 9
"##;

fn everything() -> Setting {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let stripes = |x: u32, y: u32| Rgb([(x * 40 % 256) as u8, (y * 25 % 256) as u8, ((x ^ y) * 16 % 256) as u8]);
    RgbImage::from_fn(16, 12, stripes).save(at("wall.png")).unwrap();
    RgbImage::from_fn(64, 32, stripes).save(at("sky.png")).unwrap();
    let hill = |x: u32, y: u32| Luma([(128.0 + 60.0 * ((x as f32 * 0.4).sin() + (y as f32 * 0.7).cos())) as u8]);
    GrayImage::from_fn(32, 32, hill).save(at("relief.png")).unwrap();
    std::fs::write(at("scene.toml"), EVERYTHING).unwrap();
    load(&Source::Scene(at("scene.toml")))
}

#[test]
fn everything_there_is_is_as_the_reference_has_it() {
    let setting = everything();
    let view = setting.view;
    let stereo = |mode| View {
        stereo: Some(Stereo {
            eye_distance: Some(0.3),
            ..Stereo::new(mode)
        }),
        samples: Samples::One,
        ..view
    };
    let sampled = |pattern, filter| View {
        pattern,
        filter,
        ..view
    };
    let views = [
        ("regular, box", sampled(Pattern::Regular, Filter::Box)),
        ("rotated, tent", sampled(Pattern::Rotated, Filter::Tent)),
        ("R2, Gaussian", sampled(Pattern::R2, Filter::Gaussian)),
        ("side by side", stereo(StereoMode::SideBySide)),
        ("rows", stereo(StereoMode::Rows)),
        ("one after the other", stereo(StereoMode::Sequential)),
        ("anaglyph", stereo(StereoMode::Anaglyph)),
    ];
    let wrong: Vec<_> = views
        .into_iter()
        .filter_map(|(name, view)| judge(name, &setting, &view, DEEP))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
}

#[test]
fn what_is_seen_first_is_what_the_reference_sees() {
    let setting = everything();
    let scene = Arc::new(Scene::of_model(setting.model.clone(), &StructureOptions::default(), &silent).unwrap());
    let mut cpu = Cpu::new(scene.clone());
    let frame = setting.view.frame(&scene, SIZE[0], SIZE[1]);
    let is = Seen::new(&frame, &scene, |frame| cpu.hits(frame)).unwrap();
    let reference = Reference::new(Arc::new(setting.model)).unwrap();
    let wanted = reference.sitting(&setting.view, SIZE, Takes::View).seen();
    assert_eq!(wanted.hits.len(), is.hits.len());
    let mut others = 0;
    for (i, (wanted_hit, hit)) in wanted.hits.iter().zip(&is.hits).enumerate() {
        if wanted_hit.triangle != hit.triangle {
            others += 1;
        } else if hit.is_hit() {
            // Planes are met at a grazing angle far away.
            let tolerance = 1e-5 * hit.t.max(hit.t * hit.t);
            assert!(
                (wanted_hit.t - hit.t).abs() <= tolerance,
                "pixel {i}: {hit:?}, {wanted_hit:?}"
            );
            assert!(wanted.normals[i].distance(is.normals[i]) < 1e-3, "pixel {i}");
        }
    }
    assert!(others <= 3, "{others} pixels see another triangle");
}

#[test]
fn the_command_writes_it_and_refuses_what_makes_no_sense() {
    let folder = tempfile::tempdir().unwrap();
    let render = |more: &[&str]| {
        let common = ["render", "balls", "--size", "32x24", "-o", "right.exr"];
        run(folder.path(), common.iter().chain(more))
    };
    let done = render(&["--reference=9", "--aov", "all"]);
    assert_eq!(done.code, Some(0), "{}", done.error);
    assert!(
        done.error.contains("9 samples each") && done.error.contains("in double precision"),
        "{}",
        done.error
    );
    let wanted = Shot::read(&folder.path().join("right.exr")).unwrap();
    let setting = load(&Source::from_argument(Some(Path::new("balls"))));
    let reference = Reference::new(Arc::new(setting.model)).unwrap();
    let sitting = reference.sitting(&setting.view, [32, 24], Takes::Grid(3));
    let picture = sitting.render(&AtomicBool::new(false), &silent).unwrap();
    assert_eq!(wanted, Shot::of_picture(&picture));
    for (wrong, told) in [
        (&["--reference=8"][..], "the square of a whole number"),
        (
            &["--reference=9", "--samples", "4"],
            "leave --samples and --pattern out",
        ),
        (&["--reference", "--backend", "cpu"], "cannot be used with"),
        (&["--reference", "--traversal", "bvh2"], "cannot be used with"),
    ] {
        let refused = render(wrong);
        assert!(
            refused.code == Some(2) && refused.error.contains(told),
            "{wrong:?}: {}",
            refused.error
        );
    }
}
