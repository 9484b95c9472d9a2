//! Files that `oktant render` writes: their formats, what is beside the picture, pairs, and that all appear or none.

#![cfg(test)]

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
use image::{ColorType, DynamicImage};
use oktant_shared::color::srgb_from_linear;
use oktant_tests::program::{Run, finish, oktant, run};
use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::{TempDir, tempdir};

/// A folder with a right triangle in the plane z = 0 that fills the middle of the picture.
fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(
        folder.path().join("triangle.ply"),
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    )
    .unwrap();
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "triangle.ply")
        .collect();
    names.sort();
    names
}

/// Renders the triangle straight from the front, on the CPU.
fn render(folder: &Path, more: &[&str]) -> Run {
    let arguments = ["render", "triangle.ply", "--backend=cpu", "--elevation=0"];
    run(folder, arguments.iter().chain(more))
}

#[track_caller]
fn rendered(folder: &Path, more: &[&str]) -> Run {
    let run = render(folder, more);
    assert_eq!(run.code, Some(0), "{}", run.error);
    run
}

fn png(folder: &Path, name: &str) -> DynamicImage {
    image::open(folder.join(name)).unwrap()
}

/// The channels of an EXR file, by name.
fn channels(folder: &Path, name: &str) -> HashMap<String, FlatSamples> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(folder.join(name))
        .unwrap();
    let channels = image.layer_data.channel_data.list;
    channels
        .into_iter()
        .map(|channel| (channel.name.to_string(), channel.sample_data))
        .collect()
}

fn floats(channels: &HashMap<String, FlatSamples>, name: &str) -> Vec<f32> {
    match &channels[name] {
        FlatSamples::F32(values) => values.clone(),
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn all_formats_show_the_same_picture() {
    let folder = folder();
    let size = "--size=48x36";
    rendered(folder.path(), &["-o", "8.png", size]);
    rendered(folder.path(), &["-o", "16.png", size, "--bits=16"]);
    rendered(folder.path(), &["-o", "a.exr", size]);
    assert_eq!(names(folder.path()), ["16.png", "8.png", "a.exr"]);
    let [eight, sixteen] = ["8.png", "16.png"].map(|name| png(folder.path(), name));
    assert_eq!((eight.color(), sixteen.color()), (ColorType::Rgb8, ColorType::Rgb16));
    let (eight, sixteen) = (eight.into_rgb8(), sixteen.into_rgb16());
    let channels = channels(folder.path(), "a.exr");
    let light = ["R", "G", "B"].map(|name| floats(&channels, name));
    assert_eq!(eight.dimensions(), (48, 36));
    for (index, (few, many)) in eight.pixels().zip(sixteen.pixels()).enumerate() {
        for (channel, light) in light.iter().enumerate() {
            let encoded = srgb_from_linear(light[index].min(1.0));
            assert!((f32::from(few.0[channel]) - encoded * 255.0).abs() <= 0.501);
            assert!((f32::from(many.0[channel]) - encoded * 65_535.0).abs() <= 0.6);
        }
    }
}

#[test]
fn exposure_and_curve_are_in_png_files() {
    let folder = folder();
    let mean = |more: &[&str]| {
        rendered(folder.path(), &[&["-o", "a.png", "--size=24x18"], more].concat());
        let picture = png(folder.path(), "a.png").into_rgb8().into_raw();
        picture.iter().map(|channel| f64::from(*channel)).sum::<f64>() / picture.len() as f64
    };
    let plain = mean(&[]);
    assert!(mean(&["--exposure=2"]) > plain + 10.0);
    assert!(mean(&["--exposure=-2"]) < plain - 10.0);
    assert!(mean(&["--tone=reinhard"]) < plain - 2.0);
    assert_ne!(mean(&["--tone=aces"]), plain);
}

#[test]
fn aovs_are_files_beside_a_png() {
    let folder = folder();
    let run = rendered(
        folder.path(),
        &["-o", "a.png", "--size=48x36", "--aov=all", "--samples=4"],
    );
    let all = ["barycentrics", "depth", "id", "normal", "rays", "samples"];
    let wanted = all.map(|name| format!("a-{name}.png"));
    assert_eq!(names(folder.path()), [&wanted[..], &["a.png".into()]].concat());
    for name in &wanted {
        assert!(run.error.contains(&format!("\n{name}: ")), "{}", run.error);
    }
    // The plane z = 0 at the distance of the camera, whose line of sight is perpendicular to it.
    let distance = 2.8_f32 * 0.5_f32.sqrt();
    let (_, told) = run.error.split_once("65535 is ").unwrap();
    let near: f32 = told.split_once(',').unwrap().0.parse().unwrap();
    assert!((near - distance).abs() < 1e-4, "{near} instead of {distance}");

    let [depth, normal, id, corners] =
        ["depth", "normal", "id", "barycentrics"].map(|name| png(folder.path(), &format!("a-{name}.png")));
    assert_eq!((depth.color(), normal.color()), (ColorType::L16, ColorType::Rgb16));
    let (depth, normal, id, corners) = (
        depth.into_luma16(),
        normal.into_rgb16(),
        id.into_rgb8(),
        corners.into_rgb16(),
    );
    let mut hits = 0;
    for (x, y, pixel) in depth.enumerate_pixels() {
        let is_hit = pixel.0[0] != 0;
        hits += u32::from(is_hit);
        let sum: u32 = corners.get_pixel(x, y).0.iter().map(|weight| u32::from(*weight)).sum();
        if is_hit {
            assert_eq!(normal.get_pixel(x, y).0, [32_768, 32_768, 65_535]);
            assert_ne!(id.get_pixel(x, y).0, [0; 3]);
            assert!(sum.abs_diff(65_535) <= 2, "{sum}");
        } else {
            assert_eq!(normal.get_pixel(x, y).0, [0; 3]);
            assert_eq!(id.get_pixel(x, y).0, [0; 3]);
            assert_eq!(sum, 0);
        }
    }
    assert!((50..48 * 36 / 2).contains(&hits), "{hits}");
    // Everywhere as many samples.
    let samples = png(folder.path(), "a-samples.png").into_rgb8();
    assert!(samples.pixels().all(|pixel| pixel == samples.get_pixel(0, 0)));
    assert!(run.error.contains("to 4 (yellow)"), "{}", run.error);
}

#[test]
fn aovs_are_layers_of_an_exr() {
    let folder = folder();
    rendered(
        folder.path(),
        &["-o", "a.EXR", "--size=48x36", "--aov=rays,depth,id,normal,samples"],
    );
    assert_eq!(names(folder.path()), ["a.EXR"]);
    let channels = channels(folder.path(), "a.EXR");
    assert_eq!(channels.len(), 3 + 3 + 1 + 1 + 3 + 1);
    let FlatSamples::U32(ids) = &channels["id.triangle"] else {
        panic!("ids are whole numbers");
    };
    let depth = floats(&channels, "depth.Z");
    let normal = floats(&channels, "normal.Z");
    let closest = floats(&channels, "rays.closest");
    let shadow = floats(&channels, "rays.shadow");
    let samples = floats(&channels, "samples.weight");
    let distance = 2.8_f32 * 0.5_f32.sqrt();
    for pixel in 0..48 * 36 {
        let is_hit = ids[pixel] == 0;
        assert!(is_hit || ids[pixel] == u32::MAX);
        assert_eq!((closest[pixel], samples[pixel]), (1.0, 1.0));
        assert_eq!(
            (shadow[pixel], normal[pixel]),
            if is_hit { (1.0, 1.0) } else { (0.0, 0.0) }
        );
        if is_hit {
            assert!((depth[pixel] - distance).abs() < 1e-4);
        } else {
            assert_eq!(depth[pixel], f32::INFINITY);
        }
    }
    assert!(ids.contains(&0));
}

#[test]
fn sequential_stereo_is_a_file_for_each_eye() {
    let folder = folder();
    let more = ["--size=64x48", "--stereo=sequential", "--eye-distance=0.2"];
    let run = rendered(folder.path(), &[&["-o", "a.png", "--aov=depth"], &more[..]].concat());
    assert_eq!(
        names(folder.path()),
        ["a-left-depth.png", "a-left.png", "a-right-depth.png", "a-right.png"]
    );
    assert!(
        run.error.starts_with("a-left.png and a-right.png: 64 x 48 pixels"),
        "{}",
        run.error
    );
    let [left, right] = ["a-left.png", "a-right.png"].map(|name| png(folder.path(), name).into_rgb8());
    assert_eq!((left.dimensions(), right.dimensions()), ((64, 48), (64, 48)));
    assert_ne!(left, right);
    // Side by side they are the same two.
    rendered(
        folder.path(),
        &[
            "-o",
            "both.png",
            "--size=128x48",
            "--stereo=side-by-side",
            "--eye-distance=0.2",
        ],
    );
    let both = png(folder.path(), "both.png");
    assert_eq!(both.crop_imm(0, 0, 64, 48).into_rgb8(), left);
    assert_eq!(both.crop_imm(64, 0, 64, 48).into_rgb8(), right);

    rendered(folder.path(), &[&["-o", "b.exr", "--aov=depth"], &more[..]].concat());
    for name in ["b-left.exr", "b-right.exr"] {
        let channels = channels(folder.path(), name);
        assert_eq!(floats(&channels, "depth.Z").len(), 64 * 48);
    }
    assert!(!folder.path().join("b.exr").exists());
}

#[test]
fn other_stereo_is_one_file() {
    let folder = folder();
    for mode in ["side-by-side", "rows", "anaglyph"] {
        rendered(
            folder.path(),
            &["-o", "a.png", "--size=64x49", "--aov=id", "--stereo", mode],
        );
        assert_eq!(names(folder.path()), ["a-id.png", "a.png"]);
        for name in names(folder.path()) {
            assert_eq!(png(folder.path(), &name).into_rgb8().dimensions(), (64, 49), "{mode}");
        }
    }
}

#[test]
fn what_does_not_go_together_is_refused_with_code_2() {
    let folder = folder();
    for (more, words) in [
        (&["-o", "a.jpg"][..], &["a.jpg", ".png or .exr"][..]),
        (&["-o", "a"], &[".png or .exr"]),
        (&["-o", "a.exr", "--bits=16"], &["--bits"]),
        (&["-o", "a.png", "--bits=12"], &["8, 16"]),
        (&["-o", "a.exr", "--exposure=1"], &["--exposure", ".png"]),
        (&["-o", "a.exr", "--tone=aces"], &["--tone", ".png"]),
        (&["-o", "a.png", "--aov=colour"], &["barycentrics", "all"]),
        (
            &["-o", "a.png", "--size=65x48", "--stereo=side-by-side"],
            &["--size 66x48"],
        ),
    ] {
        let run = render(folder.path(), more);
        assert_eq!(run.code, Some(2), "{more:?}: {}", run.error);
        for word in words {
            assert!(run.error.contains(word), "{word:?} is not in {:?}", run.error);
        }
    }
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn where_one_file_cannot_be_there_is_none() {
    let folder = folder();
    for (taken, more) in [
        ("a-id.png", &["-o", "a.png", "--aov=all"][..]),
        ("a-right.png", &["-o", "a.png", "--stereo=sequential"]),
        (
            "a-right-rays.png",
            &["-o", "a.png", "--stereo=sequential", "--aov=rays"],
        ),
        ("a-left.exr", &["-o", "a.exr", "--stereo=sequential", "--aov=rays"]),
    ] {
        fs::create_dir(folder.path().join(taken)).unwrap();
        let run = render(folder.path(), more);
        assert_eq!(run.code, Some(1), "{}", run.error);
        assert!(run.error.contains(&format!("{taken} is not a file")), "{}", run.error);
        assert_eq!(names(folder.path()), [taken]);
        fs::remove_dir(folder.path().join(taken)).unwrap();
    }
}

/// A limit to the size of files makes the system refuse to write on, as a full disk does: the picture of the triangle is
/// smaller, its barycentrics and the EXR file are not.
#[cfg(unix)]
#[test]
fn where_one_file_does_not_fit_the_old_ones_stay() {
    let folder = folder();
    for (name, more, failing) in [
        ("a.png", "--aov barycentrics", "a-barycentrics.png"),
        ("a.exr", "--aov all", "a.exr"),
    ] {
        fs::write(folder.path().join(name), "the old one").unwrap();
        let script = format!(
            "trap '' XFSZ; ulimit -f 64; exec \"$0\" render triangle.ply -o {name} {more} --backend cpu --size 640x480"
        );
        let mut command = Command::new("sh");
        command.arg("-c").arg(script).arg(oktant()).current_dir(folder.path());
        let run = finish(&mut command);
        assert_eq!(run.code, Some(1), "{}", run.error);
        assert!(
            run.error.contains(&format!("{failing} cannot be written")),
            "{}",
            run.error
        );
        assert_eq!(fs::read_to_string(folder.path().join(name)).unwrap(), "the old one");
        assert_eq!(names(folder.path()), [name]);
        fs::remove_file(folder.path().join(name)).unwrap();
    }
}
