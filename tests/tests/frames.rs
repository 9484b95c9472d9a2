//! `oktant render --frames`: each frame is the picture that a single render makes; what is there is kept; animations in one
//! file; interruption. And what else goes out of `oktant render` without a name: standard output and JSON.

#![cfg(test)]

use image::codecs::png::PngDecoder;
use image::{AnimationDecoder, RgbImage};
use oktant_tests::program::{Run, finish, oktant, run};
use serde_json::Value;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::{TempDir, tempdir};

/// A folder with a scene of a coloured ball on a board.
fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(
        folder.path().join("ball.toml"),
        "[materials.red]\nbase = [0.8, 0.1, 0.1]\nmirror = 0.2\ndiffuse = 0.7\n[materials.white]\n\
         [[sphere]]\nmaterial = \"red\"\n\
         [[checkerboard]]\ncenter = [0, -1, 0]\nsize = 6\nmaterials = [\"red\", \"white\"]\n",
    )
    .unwrap();
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.ends_with(".toml"))
        .collect();
    names.sort();
    names
}

fn render(folder: &Path, more: &[&str]) -> Run {
    let arguments = ["render", "ball.toml", "--backend=cpu", "--size=32x24"];
    run(folder, arguments.iter().chain(more))
}

#[track_caller]
fn rendered(folder: &Path, more: &[&str]) -> Run {
    let run = render(folder, more);
    assert_eq!(run.code, Some(0), "{}", run.error);
    run
}

/// The bytes of the picture that a single render makes.
#[track_caller]
fn single(folder: &Path, suffix: &str, more: &[&str]) -> Vec<u8> {
    let name = format!("single.{suffix}");
    rendered(folder, &[&["-o", &name], more].concat());
    let bytes = fs::read(folder.join(&name)).unwrap();
    fs::remove_file(folder.join(name)).unwrap();
    bytes
}

fn png(bytes: &[u8]) -> RgbImage {
    image::load_from_memory(bytes).unwrap().into_rgb8()
}

#[test]
fn frames_of_a_turntable_are_single_renders() {
    let folder = folder();
    for (suffix, more) in [
        ("png", &["--azimuth=10", "--samples=4"][..]),
        ("png", &["--azimuth=10", "--samples=adaptive:16", "--bits=16"]),
        ("exr", &["--azimuth=10", "--stereo=anaglyph"]),
    ] {
        let names_asked = format!("frame-##.{suffix}");
        let run = rendered(folder.path(), &[&["--frames=4", "-o", &names_asked], more].concat());
        let wanted: Vec<String> = (1..=4).map(|frame| format!("frame-{frame:02}.{suffix}")).collect();
        assert_eq!(names(folder.path()), wanted);
        assert!(
            run.error
                .starts_with(&format!("{} to {}: 4 frames of 32 x 24 pixels, ", wanted[0], wanted[3])),
            "{}",
            run.error
        );
        assert!(!run.error.contains(['\x1b', '\r']), "no progress: {:?}", run.error);
        for (name, azimuth) in wanted.iter().zip(["10", "100", "190", "280"]) {
            let of_all = fs::read(folder.path().join(name)).unwrap();
            let azimuth = format!("--azimuth={azimuth}");
            assert!(
                of_all == single(folder.path(), suffix, &[&more[1..], &[&azimuth]].concat()),
                "{name} with {more:?}"
            );
            fs::remove_file(folder.path().join(name)).unwrap();
        }
    }
}

#[test]
fn a_part_has_the_numbers_of_the_whole() {
    let folder = folder();
    rendered(folder.path(), &["--frames=2..3/4", "-o", "f#.png", "--aov=depth"]);
    assert_eq!(
        names(folder.path()),
        ["f2-depth.png", "f2.png", "f3-depth.png", "f3.png"]
    );
    let third = fs::read(folder.path().join("f3.png")).unwrap();
    assert!(third == single(folder.path(), "png", &["--azimuth=180"]));
}

#[test]
fn keys_are_met_and_between_them_the_way_is_smooth() {
    let folder = folder();
    fs::write(
        folder.path().join("path.toml"),
        "[[key]]\ntime = 0\n[[key]]\ntime = 1\nazimuth = 50\nexposure = 1\n[[key]]\ntime = 2\nelevation = 60\nfov = 25\n",
    )
    .unwrap();
    rendered(folder.path(), &["--frames=5", "--path=path.toml", "-o", "f#.png"]);
    assert_eq!(names(folder.path()), ["f1.png", "f2.png", "f3.png", "f4.png", "f5.png"]);
    let frame = |number: u32| fs::read(folder.path().join(format!("f{number}.png"))).unwrap();
    assert!(frame(1) == single(folder.path(), "png", &[]));
    assert!(frame(3) == single(folder.path(), "png", &["--azimuth=50", "--exposure=1"]));
    assert!(frame(5) == single(folder.path(), "png", &["--elevation=60", "--fov=25"]));
    // Half way to the second key, a quarter of the line's slope at the first and none in the second is taken off.
    let between = [
        "--azimuth=31.25",
        "--exposure=0.625",
        "--elevation=12.1875",
        "--fov=40.9375",
    ];
    assert!(frame(2) == single(folder.path(), "png", &between));
    fs::remove_file(folder.path().join("path.toml")).unwrap();
}

#[test]
fn what_is_there_is_kept_unless_it_is_to_be_overwritten() {
    let folder = folder();
    let ask = ["--frames=3", "-o", "f#.png", "--aov=id"];
    rendered(folder.path(), &ask);
    let all = ["f1-id.png", "f1.png", "f2-id.png", "f2.png", "f3-id.png", "f3.png"];
    assert_eq!(names(folder.path()), all);
    let path = |name: &str| folder.path().join(name);
    let state = |name: &str| {
        (
            fs::metadata(path(name)).unwrap().modified().unwrap(),
            fs::read(path(name)).unwrap(),
        )
    };
    let before = all.map(state);
    // A frame is there when all its files are.
    fs::remove_file(path("f2-id.png")).unwrap();
    fs::write(path("f3.png"), "another picture").unwrap();
    let run = rendered(folder.path(), &ask);
    assert!(
        run.error
            .starts_with("There already, and kept: 2 of 3 frames; --overwrite renders them anew.\n"),
        "{}",
        run.error
    );
    assert!(run.error.contains("f2.png: 1 frame of 32 x 24"), "{}", run.error);
    assert_eq!(state("f1.png"), before[1]);
    assert_eq!(fs::read(path("f3.png")).unwrap(), b"another picture");
    assert_eq!(state("f2-id.png").1, before[2].1);
    assert!(state("f2.png").0 > before[3].0, "it is new");
    let run = rendered(folder.path(), &ask);
    assert_eq!(
        run.error,
        "There already, and kept: 3 of 3 frames; --overwrite renders them anew.\n"
    );
    rendered(folder.path(), &[&ask[..], &["--overwrite"]].concat());
    assert_eq!(state("f3.png").1, before[5].1);
    assert!(state("f1.png").0 > before[1].0, "it is new");
}

#[test]
fn an_apng_has_every_colour_of_its_frames() {
    let folder = folder();
    let run = rendered(folder.path(), &["--frames=3", "-o", "a.apng", "--fps=10"]);
    assert!(run.error.starts_with("a.apng: 3 frames of 32 x 24"), "{}", run.error);
    assert_eq!(names(folder.path()), ["a.apng"]);
    let file = BufReader::new(File::open(folder.path().join("a.apng")).unwrap());
    let frames = PngDecoder::new(file).unwrap().apng().unwrap().into_frames();
    let frames: Vec<_> = frames.map(Result::unwrap).collect();
    assert_eq!(frames.len(), 3);
    for (frame, azimuth) in frames.into_iter().zip(["0", "120", "240"]) {
        assert_eq!(frame.delay().numer_denom_ms(), (100, 1));
        let wanted = png(&single(folder.path(), "png", &["--azimuth", azimuth]));
        let is = image::DynamicImage::ImageRgba8(frame.into_buffer()).into_rgb8();
        assert!(is == wanted, "azimuth {azimuth}");
    }
}

#[test]
fn a_gif_has_the_nearest_colours_of_its_palettes() {
    let folder = folder();
    rendered(folder.path(), &["--frames=3", "-o", "a.GIF", "--samples=16"]);
    assert_eq!(names(folder.path()), ["a.GIF"]);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    let mut decoder = options
        .read_info(File::open(folder.path().join("a.GIF")).unwrap())
        .unwrap();
    let mut count = 0;
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let azimuth = format!("--azimuth={}", 120 * count);
        count += 1;
        assert_eq!(frame.delay, 4, "25 frames in a second");
        let wanted = png(&single(folder.path(), "png", &["--samples=16", &azimuth]));
        let palette = frame.palette.as_ref().unwrap().as_chunks::<3>().0;
        let distance =
            |a: &[u8; 3], b: &[u8; 3]| -> u32 { a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum() };
        let mut off = 0;
        for (index, pixel) in frame.buffer.iter().zip(wanted.pixels()) {
            let is = distance(&palette[usize::from(*index)], &pixel.0);
            let nearest = palette.iter().map(|color| distance(color, &pixel.0)).min().unwrap();
            assert_eq!(is, nearest);
            off += is;
        }
        let rmse = (f64::from(off) / frame.buffer.len() as f64 / 3.0).sqrt();
        assert!(rmse < 4.0, "{rmse} of 255");
    }
    assert_eq!(count, 3);
}

#[test]
fn each_eye_has_its_frames() {
    let folder = folder();
    let more = ["--stereo=sequential", "--eye-distance=0.3"];
    rendered(folder.path(), &[&["--frames=2", "-o", "f#.png"], &more[..]].concat());
    rendered(folder.path(), &[&["--frames=2", "-o", "a.apng"], &more[..]].concat());
    let wanted = [
        "a-left.apng",
        "a-right.apng",
        "f1-left.png",
        "f1-right.png",
        "f2-left.png",
        "f2-right.png",
    ];
    assert_eq!(names(folder.path()), wanted);
    for eye in ["left", "right"] {
        let read = |name: String| png(&fs::read(folder.path().join(name)).unwrap());
        assert!(read(format!("a-{eye}.apng")) == read(format!("f1-{eye}.png")));
    }
}

/// What a run writes to standard output, byte by byte, and to standard error.
fn piped(folder: &Path, more: &[&str]) -> (Vec<u8>, String) {
    let mut command = Command::new(oktant());
    command.args(["render", "ball.toml", "--backend=cpu", "--size=32x24", "-o", "-"]);
    command.env("OKTANT_CONFIG", "");
    let output = command.args(more).current_dir(folder).output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{error}");
    (output.stdout, error)
}

#[test]
fn standard_output_takes_the_bytes_of_the_file() {
    let folder = folder();
    for (suffix, more) in [
        ("png", &[][..]),
        ("exr", &["--format=exr"]),
        ("gif", &["--format=gif", "--frames=2"]),
        ("apng", &["--format=apng", "--frames=2", "--bits=16"]),
    ] {
        let (bytes, error) = piped(folder.path(), more);
        let as_file: Vec<_> = more
            .iter()
            .copied()
            .filter(|more| !more.starts_with("--format"))
            .collect();
        assert!(bytes == single(folder.path(), suffix, &as_file), "{more:?}");
        assert!(error.starts_with("standard output: "), "{error}");
        assert_eq!(names(folder.path()), [""; 0]);
    }
    let (bytes, error) = piped(folder.path(), &["--repeat=2"]);
    assert_eq!(png(&bytes).dimensions(), (32, 24));
    assert!(error.contains("\nkernel: median "), "{error}");
}

#[test]
fn json_says_what_was_rendered() {
    let folder = folder();
    let json = |more: &[&str]| -> Value { serde_json::from_str(&rendered(folder.path(), more).output).unwrap() };
    let one = json(&["-o", "a.png", "--json", "--repeat=3", "--samples=4"]);
    assert_eq!(one["files"], serde_json::json!(["a.png"]));
    assert_eq!(one["size"], serde_json::json!([32, 24]));
    assert_eq!((&one["samples"], &one["mean_samples"]), (&4.into(), &4.0.into()));
    assert_eq!(one["adaptive"], Value::Bool(false));
    assert!(one["triangles"].as_u64().unwrap() > 100);
    assert!(one["backend"].as_str().unwrap().contains("CPU"));
    assert!(one["seconds"].as_f64().unwrap() > 0.0);
    let times = &one["kernel_milliseconds"];
    assert!(times["least"].as_f64().unwrap() <= times["greatest"].as_f64().unwrap());
    let camera_rays = 32.0 * 24.0 * 4.0;
    assert!(one["rays"]["closest"].as_f64().unwrap() >= camera_rays);
    assert!(one["rays"]["shadow"].as_f64().unwrap() > 0.0);
    assert!(one["cut"]["greatest"].as_f64().unwrap() >= one["cut"]["mean"].as_f64().unwrap());
    assert!(one["frames"].is_null() && one["kept"].is_null());

    rendered(folder.path(), &["--frames=2..2/3", "-o", "f#.png"]);
    let many = json(&["--frames=3", "-o", "f#.png", "--json"]);
    assert_eq!(many["files"], serde_json::json!(["f1.png", "f3.png"]));
    assert_eq!(many["kept"], serde_json::json!([2]));
    assert!(many["kernel_milliseconds"].is_null());
    let frames = many["frames"].as_array().unwrap();
    assert_eq!((&frames[0]["frame"], &frames[1]["frame"]), (&1.into(), &3.into()));
    assert_eq!(frames[1]["files"], serde_json::json!(["f3.png"]));
    let rays = |of: &Value| of["rays"]["closest"].as_f64().unwrap();
    assert_eq!(rays(&many), rays(&frames[0]) + rays(&frames[1]));
    let animation = json(&["--frames=2", "-o", "a.gif", "--json"]);
    assert_eq!(animation["files"], serde_json::json!(["a.gif"]));
    assert_eq!(animation["frames"][1]["files"], serde_json::json!([]));
}

#[test]
fn what_does_not_go_together_is_refused_with_code_2() {
    let folder = folder();
    for (more, words) in [
        (&["--frames=3", "-o", "a.png"][..], "frame-####.png"),
        (&["--frames=0", "-o", "f#.png"], "1..60/240"),
        (&["--frames=3..9/8", "-o", "f#.png"], "1 to 8"),
        (&["--frames=3", "-o", "f#.jpg"], ".png or .exr"),
        (&["--frames=3", "-o", "f#.png", "--fps=5"], "--fps"),
        (&["--frames=3", "-o", "a.gif", "--fps=51"], "--fps 50"),
        (&["--frames=3", "-o", "a.gif", "--fps=0"], "--fps"),
        (&["--frames=3", "-o", "a.gif", "--bits=16"], ".apng"),
        (&["--frames=3", "-o", "a.gif", "--aov=id"], "--aov"),
        (&["--frames=3", "-o", "a.apng", "--overwrite"], "--overwrite"),
        (&["--frames=3", "-o", "f#.exr", "--tone=aces"], "--tone"),
        (&["--frames=3", "-o", "f#.png", "--path=orbit"], "turntable"),
        (&["--frames=3", "-o", "f#.png", "--reference"], "--reference"),
        (&["-o", "a.png", "--path=turntable"], "--frames"),
        (&["-o", "a.gif"], "--frames"),
        (&["-o", "a.png", "--format=png"], "-o -"),
        (&["-o", "-", "--aov=id"], "--aov"),
        (&["-o", "-", "--json"], "--json"),
        (&["-o", "-", "--stereo=sequential"], "--stereo"),
        (&["-o", "-", "--frames=3"], "frame-####.png"),
        (
            &["-o", "-", "--format=gif", "--frames=3", "--stereo=sequential"],
            "--stereo",
        ),
        (&["-o", "-", "--format=exr", "--bits=16"], "--bits"),
    ] {
        let run = render(folder.path(), more);
        assert_eq!(run.code, Some(2), "{more:?}: {}", run.error);
        assert!(run.error.contains(words), "{words:?} is not in {:?}", run.error);
        assert!(run.output.is_empty());
    }
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn paths_and_places_that_are_wrong_are_refused_before_anything_is_rendered() {
    let folder = folder();
    let write = |text: &str| fs::write(folder.path().join("path.toml"), text).unwrap();
    for (text, words) in [
        ("", "path.toml:1:1: the path lacks [[key]]"),
        (
            "[[key]]\ntime = 0\nroll = 5\n",
            "path.toml:3:1: key has no field \"roll\"",
        ),
        (
            "[[key]]\ntime = 1\n[[key]]\ntime = 0\n",
            "path.toml:4:8: key.time is not later",
        ),
        ("[[key]]\ntime = inf\n", "path.toml:2:8: key.time is inf; give a number"),
        ("key = 1\n", "path.toml:1:7: key is 1"),
    ] {
        write(text);
        let run = render(folder.path(), &["--frames=3", "-o", "f#.png", "--path=path.toml"]);
        assert_eq!(run.code, Some(1), "{}", run.error);
        assert!(run.error.starts_with(&format!("oktant: {words}")), "{:?}", run.error);
    }
    let run = render(folder.path(), &["--frames=3", "-o", "f#.png", "--path=missing.toml"]);
    assert_eq!(run.code, Some(1));
    assert!(
        run.error.contains("missing.toml: the camera path cannot be read"),
        "{}",
        run.error
    );
    let run = render(folder.path(), &["--frames=3", "-o", "missing/f#.png"]);
    assert_eq!(run.code, Some(1));
    assert!(run.error.contains("The folder missing does not exist"), "{}", run.error);
    assert_eq!(names(folder.path()), [""; 0]);
}

/// Starts a run, waits until something is there, and sends what Ctrl-C sends.
#[cfg(unix)]
fn interrupted(folder: &Path, more: &[&str], is_time: impl Fn() -> bool) -> Run {
    let mut command = Command::new(oktant());
    command
        .args(["render", "ball.toml", "--backend=cpu", "--size=320x240"])
        .args(more);
    command
        .env("OKTANT_CONFIG", "")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let child = command.current_dir(folder).spawn().unwrap();
    let start = Instant::now();
    while !is_time() {
        assert!(start.elapsed() < Duration::from_secs(60), "nothing was written");
        std::thread::sleep(Duration::from_millis(5));
    }
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    Run {
        code: output.status.code(),
        output: String::from_utf8(output.stdout).unwrap(),
        error: String::from_utf8(output.stderr).unwrap(),
        time: start.elapsed(),
        memory: 0,
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_whole_frames_and_says_how_to_go_on() {
    let folder = folder();
    let ask = ["--frames=10000", "-o", "f#####.png"];
    let second = folder.path().join("f00002.png");
    let run = interrupted(folder.path(), &ask, || second.exists());
    assert_eq!(run.code, Some(130), "{}", run.error);
    let there = names(folder.path());
    let complete = format!(
        "Complete: {} of 10000 frames; the same command goes on with the others.",
        there.len()
    );
    assert_eq!(run.error, format!("oktant: {complete}\n"));
    for (index, name) in there.iter().enumerate() {
        assert_eq!(*name, format!("f{:05}.png", index + 1), "nothing is half written");
        assert_eq!(image::open(folder.path().join(name)).unwrap().width(), 320);
    }
    let kept = fs::metadata(&second).unwrap().modified().unwrap();
    let third = folder.path().join(format!("f{:05}.png", there.len() + 1));
    let run = interrupted(folder.path(), &ask, || third.exists());
    assert_eq!(run.code, Some(130));
    assert!(
        run.error
            .starts_with(&format!("There already, and kept: {} of", there.len())),
        "{}",
        run.error
    );
    assert_eq!(fs::metadata(&second).unwrap().modified().unwrap(), kept);
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_no_part_of_an_animation() {
    let folder = folder();
    fs::write(folder.path().join("a.gif"), "the old one").unwrap();
    let is_begun = || {
        let entries = fs::read_dir(folder.path()).unwrap();
        let mut sizes = entries.filter_map(|entry| {
            let entry = entry.ok()?;
            entry
                .file_name()
                .to_str()?
                .starts_with(".oktant-")
                .then(|| entry.metadata().map_or(0, |data| data.len()))
        });
        sizes.any(|size| size > 0)
    };
    let run = interrupted(folder.path(), &["--frames=10000", "-o", "a.gif"], is_begun);
    assert_eq!(run.code, Some(130), "{}", run.error);
    assert!(run.error.contains("the same command begins anew"), "{}", run.error);
    assert_eq!(names(folder.path()), ["a.gif"]);
    assert_eq!(fs::read(folder.path().join("a.gif")).unwrap(), b"the old one");
}

#[test]
fn an_animation_that_does_not_fit_leaves_the_old_one() {
    let folder = folder();
    fs::write(folder.path().join("a.apng"), "the old one").unwrap();
    let script =
        "trap '' XFSZ; ulimit -f 16; exec \"$0\" render ball.toml --backend cpu --frames 8 -o a.apng --size 160x120";
    let mut command = Command::new("sh");
    command.arg("-c").arg(script).arg(oktant()).current_dir(folder.path());
    let run = finish(&mut command);
    assert_eq!(run.code, Some(1), "{}", run.error);
    assert!(run.error.contains("a.apng cannot be written"), "{}", run.error);
    assert_eq!(names(folder.path()), ["a.apng"]);
    assert_eq!(fs::read(folder.path().join("a.apng")).unwrap(), b"the old one");
}
