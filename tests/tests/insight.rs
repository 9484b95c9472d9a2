//! `oktant render --show` and `--cells`: the commands of `docs/insight.md`, figures held against the numbers themselves and
//! against `oktant trace`.
#![cfg(test)]

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
use image::RgbImage;
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::structure::StructureOptions;
use oktant::view::View;
use oktant_shared::parts::TraversalKind;
use oktant_tests::images::{CPU, difference};
use oktant_tests::program::{Run, run};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

const SIZE: &str = "96x72";

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

fn render(folder: &Path, arguments: &[&str]) -> Run {
    run(folder, [&["render"], arguments].concat())
}

fn rendered(folder: &Path, arguments: &[&str]) -> Run {
    let run = render(folder, arguments);
    assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.error);
    run
}

fn picture(folder: &Path, name: &str) -> RgbImage {
    image::open(folder.join(name)).unwrap().to_rgb8()
}

/// The numbers of an EXR file, and the names of all its channels.
fn numbers(folder: &Path, name: &str) -> (Vec<f32>, Vec<String>) {
    let image = read().no_deep_data().largest_resolution_level().all_channels();
    let image = image
        .first_valid_layer()
        .all_attributes()
        .from_file(folder.join(name))
        .unwrap();
    let channels = image.layer_data.channel_data.list;
    let names = channels.iter().map(|channel| channel.name.to_string()).collect();
    let numbers = match &channels[0].sample_data {
        FlatSamples::F32(numbers) => numbers.clone(),
        _ => Vec::new(),
    };
    (numbers, names)
}

#[test]
fn the_page_shows_what_its_commands_make() {
    let text = fs::read_to_string(docs().join("insight.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("docs/insight")).unwrap();
    let commands = text.lines().filter_map(|line| line.strip_prefix("oktant "));
    let mut wrong = Vec::new();
    let mut made = Vec::new();
    for command in commands {
        let arguments: Vec<&str> = command.split(' ').collect();
        let done = run(folder.path(), arguments.iter().copied().chain(["--backend", "cpu"]));
        assert_eq!(done.code, Some(0), "{command}: {}", done.error);
        let name = arguments
            .iter()
            .find(|argument| argument.ends_with(".png"))
            .expect("a picture");
        let expected = docs().join("..").join(name);
        wrong.extend(difference(&expected, &picture(folder.path(), name), &CPU, "insight"));
        made.push(Path::new(name).file_name().unwrap().to_owned());
    }
    assert!(wrong.is_empty(), "run the commands anew: {}", wrong.join("\n"));
    let mut there: Vec<_> = fs::read_dir(docs().join("insight"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    made.sort();
    there.sort();
    assert_eq!(made, there);
    for name in there {
        assert!(
            text.contains(&format!("](insight/{})", name.to_string_lossy())),
            "{name:?} is not shown"
        );
    }
}

/// Oracle: the numbers in the EXR file, sorted here.
#[test]
fn figures_are_those_of_the_numbers() {
    let folder = tempfile::tempdir().unwrap();
    for (aspect, traversal) in [
        ("steps", "octants"),
        ("leaf-fill", "grid"),
        ("depth", "bvh2"),
        ("rays", "octree"),
    ] {
        let options = ["bunny", "--size", SIZE, "--show", aspect, "--traversal", traversal];
        rendered(folder.path(), &[&options[..], &["-o", "a.exr"]].concat());
        let (numbers, names) = numbers(folder.path(), "a.exr");
        assert_eq!((numbers.len(), names), (96 * 72, vec!["Y".to_owned()]));
        let told = rendered(folder.path(), &[&options[..], &["-o", "a.png", "--json"]].concat());
        let legend: Value = serde_json::from_str(&told.output).expect("JSON");
        let mut sorted: Vec<f32> = numbers.iter().copied().filter(|number| !number.is_nan()).collect();
        sorted.sort_by(f32::total_cmp);
        let mean = sorted.iter().copied().map(f64::from).sum::<f64>() / sorted.len() as f64;
        // serde_json reads numbers to the last bit but one; those of f32 are then what they were.
        let figure = |name: &str| f64::from(legend["figures"][name].as_f64().unwrap() as f32);
        assert_eq!(legend["figures"]["pixels"], sorted.len());
        assert_eq!(figure("least"), f64::from(sorted[0]), "{aspect}");
        assert_eq!(figure("median"), f64::from(sorted[sorted.len() / 2]), "{aspect}");
        assert_eq!(figure("greatest"), f64::from(sorted[sorted.len() - 1]), "{aspect}");
        let at_most = sorted
            .iter()
            .filter(|number| f64::from(**number) <= figure("percentile_99"))
            .count();
        assert!(at_most * 100 >= sorted.len() * 99, "{aspect}");
        assert!((figure("mean") - mean).abs() < 1e-6 * mean, "{aspect}");
        assert_eq!(legend["show"], aspect);
        assert!(told.error.contains(&format!("{aspect} (")), "{}", told.error);
    }
}

/// Oracle: the samples that are asked for, each of which is one ray of the camera.
#[test]
fn all_rays_are_the_cameras_those_to_lights_and_those_of_recursion() {
    let folder = tempfile::tempdir().unwrap();
    let mirrors = docs().join("../assets/scenes/mirrors.toml");
    for (source, samples) in [("bunny", 1), (mirrors.to_str().unwrap(), 4)] {
        let of = |aspect: &str| {
            let samples = format!("--samples={samples}");
            rendered(
                folder.path(),
                &[source, &samples, "--size", SIZE, "--show", aspect, "-o", "a.exr"],
            );
            numbers(folder.path(), "a.exr").0
        };
        let [all, shadow, recursion] = ["rays", "shadow-rays", "recursion-rays"].map(of);
        for (index, all) in all.iter().enumerate() {
            assert_eq!(
                *all,
                samples as f32 + shadow[index] + recursion[index],
                "{source}, pixel {index}"
            );
        }
        let reflected = recursion.iter().filter(|number| **number > 0.0).count();
        assert_eq!(reflected > 100, source != "bunny", "{source}: {reflected}");
    }
}

/// Oracle: `oktant trace` of the same ray.
#[test]
fn numbers_are_those_of_the_traced_ray() {
    let folder = tempfile::tempdir().unwrap();
    for traversal in ["octants", "octree", "bvh2", "grid"] {
        let of = |aspect: &str| {
            let options = [
                "balls",
                "--size",
                SIZE,
                "--traversal",
                traversal,
                "--show",
                aspect,
                "-o",
                "a.exr",
            ];
            rendered(folder.path(), &options);
            numbers(folder.path(), "a.exr").0
        };
        let (steps, tests) = (of("steps"), of("tests"));
        let mesh = oktant::balls::balls();
        let options = StructureOptions::of(TraversalKind::from_name(traversal).unwrap());
        let scene = Scene::new(&mesh, &options, &silent).unwrap();
        let camera = View::default().frame(&scene, 96, 72).camera;
        for [x, y] in [[48, 36], [30, 40], [60, 30], [5, 5]] {
            let ray = camera.ray(x as f32 + 0.5, y as f32 + 0.5, 0.0);
            let parts = [ray.origin.to_array(), ray.direction.to_array()].concat();
            let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
            let arguments = [
                "trace",
                "balls",
                "--json",
                "--traversal",
                traversal,
                "--ray",
                &parts.join(","),
            ];
            let traced = run(folder.path(), arguments);
            let trace: Value = serde_json::from_str(&traced.output).expect("JSON");
            let visits = trace["visits"].as_array().unwrap();
            let of_kind = |kind: &str| visits.iter().filter(|visit| visit["kind"] == kind).count();
            let wanted = match traversal {
                "octree" => of_kind("leaf"),
                "grid" => of_kind("cell"),
                _ => of_kind("node"),
            };
            let index = y * 96 + x;
            assert_eq!(steps[index] as usize, wanted, "{traversal}, {x}, {y}");
            assert_eq!(
                tests[index] as usize,
                trace["tests"].as_array().unwrap().len(),
                "{traversal}, {x}, {y}"
            );
        }
        assert!(steps.iter().any(|number| *number > 3.0), "{traversal}");
    }
}

#[test]
fn ranges_and_legends_are_as_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let show = |more: &[&str]| {
        let options = ["balls", "--size", "320x240", "--show", "tests", "-o", "a.png"];
        rendered(folder.path(), &[&options[..], more].concat());
        picture(folder.path(), "a.png")
    };
    let with = show(&[]);
    let without = show(&["--legend", "off"]);
    assert_eq!((without.width(), without.height()), (320, 240));
    assert!(with.height() > 260, "{}", with.height());
    for (x, y, pixel) in without.enumerate_pixels() {
        assert_eq!(with.get_pixel(x, y), pixel, "the legend covers nothing");
    }
    let all = show(&["--legend", "off", "--range", "-2..-1"]);
    assert!(
        all.pixels().all(|pixel| pixel.0 == [252, 255, 164]),
        "everything is above"
    );
    let none = show(&["--legend", "off", "--range", "1000..2000"]);
    assert!(none.pixels().all(|pixel| pixel.0 == [0, 0, 4]), "everything is below");
}

#[test]
fn what_is_seen_has_the_channels_of_layers() {
    let folder = tempfile::tempdir().unwrap();
    for (aspect, wanted) in [
        ("normals", &["normal.X", "normal.Y", "normal.Z"][..]),
        ("ids", &["id.triangle"]),
        ("barycentrics", &["barycentrics.u", "barycentrics.v"]),
    ] {
        rendered(
            folder.path(),
            &["balls", "--size", SIZE, "--show", aspect, "-o", "a.exr"],
        );
        assert_eq!(numbers(folder.path(), "a.exr").1, wanted);
        rendered(
            folder.path(),
            &["balls", "--size", SIZE, "--show", aspect, "-o", "a.png"],
        );
    }
}

#[test]
fn cells_are_drawn_over_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["balls", "--size", "160x120", "--backend", "cpu", "-o", "a.png"];
    let with = |more: &[&str]| {
        let run = rendered(folder.path(), &[&options[..], more].concat());
        (picture(folder.path(), "a.png"), run.error)
    };
    let (bare, _) = with(&[]);
    for traversal in ["octants", "octree", "bvh2", "grid", "compact"] {
        for (cells, told) in [
            ("all", " leaves"),
            ("0", " cells of level 0"),
            ("80,60", " cells that the ray of pixel 80, 60"),
        ] {
            let (drawn, error) = with(&["--traversal", traversal, "--cells", cells]);
            assert!(error.contains(told), "{traversal}: {error}");
            let changed = bare.pixels().zip(drawn.pixels()).filter(|(a, b)| a != b).count();
            // A ray may visit a single small cell.
            assert!(changed > 20, "{traversal}, {cells}: {changed}");
        }
    }
    let (deep, error) = with(&["--cells", "90"]);
    assert!(error.contains("0 cells of level 90"), "{error}");
    assert_eq!(deep, bare);
}

#[test]
fn what_cannot_be_shown_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, what) in [
        (&["--show", "speed"][..], "leaf-depth"),
        (&["--show", "steps", "--traversal", "brute"], "visits no nodes"),
        (&["--show", "leaf-depth", "--traversal", "grid"], "of one level"),
        (&["--show", "references", "--traversal", "brute"], "no leaves"),
        (&["--show", "steps", "--backend", "gpu"], "--backend gpu"),
        (&["--show", "steps", "--stereo", "sequential"], "--stereo none"),
        (&["--show", "steps", "--exposure", "1"], "--exposure"),
        (&["--show", "ids", "--range", "0..5"], "--range"),
        (&["--show", "steps", "--range", "5..0"], "0..60"),
        (&["--range", "0..5"], "--show"),
        (&["--legend", "off"], "--show"),
        (&["--cells", "x"], "640,480"),
        (&["--cells", "64,0"], "63,47"),
        (&["--cells", "all", "--stereo", "rows"], "--stereo none"),
        (&["--cells", "all", "--bits", "16"], "--bits"),
    ] {
        let run = render(
            folder.path(),
            &[&["balls", "--size", "64x48", "-o", "a.png"], arguments].concat(),
        );
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.error);
        assert!(run.error.contains(what), "{arguments:?}: {}", run.error);
    }
    for arguments in [
        &["--show", "steps", "--range", "0..5"][..],
        &["--show", "steps", "--legend", "off"],
        &["--cells", "all"],
    ] {
        let run = render(
            folder.path(),
            &[&["balls", "--size", "64x48", "-o", "a.exr"], arguments].concat(),
        );
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.error);
        assert!(run.error.contains("EXR files hold"), "{}", run.error);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
