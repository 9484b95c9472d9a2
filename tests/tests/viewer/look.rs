//! How the picture looks: tone, stereo, samples, depth.

use super::window::{Image, Session, agreement, difference, offline, run, value_in};
use super::{AGREE, SIZE, assert_same};
use image::imageops::crop_imm;
use oktant::sampling::Samples;
use oktant::stereo::StereoMode;
use oktant::tone::Curve;
use oktant::view::View;

const PIXELS: [u32; 2] = [640, 480];

/// What the step `print` said of something, each time.
fn values<const N: usize>(text: &str, name: &str) -> [String; N] {
    let values = text
        .lines()
        .filter_map(|line| line.strip_prefix(name)?.strip_prefix(' '))
        .map(str::to_owned);
    let values: Vec<String> = values.collect();
    values
        .try_into()
        .unwrap_or_else(|values| panic!("{N} times {name}: {values:?}"))
}

fn tone_changes_what_is_shown_and_nothing_is_rendered(backend: &str) {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", backend, "--size", SIZE],
        "key I
        wait settled
        print
        key T
        key +
        key =
        wait settled
        screenshot reinhard.png
        print
        key T
        key -
        wait settled
        screenshot aces.png
        print",
    );
    let [before, _, after]: [String; 3] = values(&report.standard_output, "kernel-milliseconds");
    assert_eq!(before, after, "the last pass is the same");
    for (name, curve, exposure) in [
        ("reinhard.png", Curve::Reinhard, 2.0 / 3.0),
        ("aces.png", Curve::Aces, 1.0 / 3.0),
    ] {
        let mut view = View::default();
        (view.tone.curve, view.tone.exposure) = (curve, exposure);
        assert_same(name, &session.await_picture(name), &offline(&view, PIXELS));
    }
    assert_eq!(report.view().tone.curve, Curve::Aces);
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_shows_every_tone() {
    tone_changes_what_is_shown_and_nothing_is_rendered("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_shows_every_tone() {
    tone_changes_what_is_shown_and_nothing_is_rendered("gpu");
}

fn stereo_matches_the_offline_picture(backend: &str) {
    let session = Session::new();
    let turns: String = (0..8)
        .map(|i| format!("wait milliseconds 21\nscreenshot turn{i}.png\n"))
        .collect();
    let script = format!(
        "key I
        wait settled
        expect backend {backend}
        key L
        key ]
        drag left 30 10
        wait settled
        screenshot anaglyph.png
        key L
        wait settled
        screenshot side-by-side.png
        key L
        wait settled
        screenshot rows.png
        key L
        wait settled
        {turns}
        print
        save saved.png
        key L
        wait settled
        screenshot one-eye.png"
    );
    let report = run(&session, &["--backend", backend, "--size", SIZE], &script);
    let mut view = report.view();
    let of_the_command_line = View::default().camera.distance / 30.0;
    let mut stereo = view.stereo.expect("the last mode was printed");
    assert_eq!(stereo.mode, StereoMode::Sequential);
    let apart = stereo.eye_distance.expect("it was printed");
    assert!(apart > of_the_command_line * 0.05, "in units of the scene: {apart}");
    let mut wanted = |mode, size| {
        stereo.mode = mode;
        view.stereo = Some(stereo);
        offline(&view, size)
    };
    for (name, mode) in [
        ("anaglyph.png", StereoMode::Anaglyph),
        ("side-by-side.png", StereoMode::SideBySide),
        ("rows.png", StereoMode::Rows),
    ] {
        assert_same(name, &session.await_picture(name), &wanted(mode, PIXELS));
    }
    let both = wanted(StereoMode::Sequential, PIXELS);
    let [left, right] = [0, 480].map(|top| crop_imm(&both, 0, top, 640, 480).to_image());
    let shows = |shown: &Image, eye: &Image| agreement(shown, eye) >= AGREE;
    assert!(!shows(&left, &right));
    let mut turns = [0, 0];
    for i in 0..8 {
        let shown = session.await_picture(&format!("turn{i}.png"));
        let eyes = [&left, &right].map(|eye| usize::from(shows(&shown, eye)));
        assert_eq!(eyes[0] + eyes[1], 1, "turn {i} shows one of the eyes");
        turns = [turns[0] + eyes[0], turns[1] + eyes[1]];
    }
    println!("{backend}: the left eye has {} turns of 8", turns[0]);
    assert!(turns[0] > 0 && turns[1] > 0);
    assert_same(
        "both eyes in a file",
        &session.await_picture("saved.png"),
        &wanted(StereoMode::SideBySide, [1280, 480]),
    );
    view.stereo = None;
    assert_same(
        "one eye",
        &session.await_picture("one-eye.png"),
        &offline(&view, PIXELS),
    );
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_shows_two_eyes() {
    stereo_matches_the_offline_picture("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_shows_two_eyes() {
    stereo_matches_the_offline_picture("gpu");
}

fn a_picture_is_refined_in_sight(backend: &str) {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", backend, "--size", SIZE],
        "key I
        wait settled
        screenshot one.png
        key M
        key M
        wait settled
        key M
        wait samples 20
        screenshot some.png
        print
        wait settled
        screenshot all.png
        print",
    );
    let [some, all]: [String; 2] = values(&report.standard_output, "samples");
    println!("{backend}: {some}, then {all}");
    assert_eq!(all, "64 of 64");
    let pass: f64 = report.value("kernel-milliseconds").parse().expect("a number");
    if pass * 64.0 > 1000.0 {
        assert_ne!(some, all, "the picture was shown before it was done");
    }
    let [one, some, all] = ["one.png", "some.png", "all.png"].map(|name| session.await_picture(name));
    let view = View {
        samples: Samples::SixtyFour,
        ..View::default()
    };
    assert_same("64 samples", &all, &offline(&view, PIXELS));
    let [first, later] = [&one, &some].map(|image| difference(image, &all));
    println!("{backend}: {first:.3} of 255 from the final picture at first, {later:.3} later");
    assert!(later < 0.9 * first);
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_refines_in_sight() {
    a_picture_is_refined_in_sight("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_refines_in_sight() {
    a_picture_is_refined_in_sight("gpu");
}

/// What the window shows of an adaptive picture that it has refined, and what `oktant render` makes of the same.
fn refined_and_rendered(backend: &str, block: &str) -> [Image; 2] {
    let session = Session::new();
    let script = format!(
        "key I
        wait settled
        set block {block}
        set samples adaptive:16
        wait settled
        expect backend {backend}
        screenshot shown.png"
    );
    let of_both = ["--backend", backend, "--size", "320x240"];
    run(&session, &of_both, &script);
    let render = [
        "render",
        "-o",
        "rendered.png",
        "--samples",
        "adaptive:16",
        "--block",
        block,
    ];
    session.start_with(&[&render[..], &of_both].concat()).finish();
    let [shown, rendered] = ["shown.png", "rendered.png"].map(|name| session.await_picture(name));
    let fixed = offline(&View::default(), [320, 240]);
    assert_ne!(rendered, fixed, "there is something to refine");
    [shown, rendered]
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_refines_an_adaptive_picture_as_the_command_does() {
    for block in ["1", "4"] {
        let [shown, rendered] = refined_and_rendered("cpu", block);
        let different = shown.pixels().zip(rendered.pixels()).filter(|(a, b)| a != b).count();
        assert_eq!(different, 0, "block {block}");
    }
}

/// The GPU encodes what it shows itself, which rounds otherwise; a file's colours are encoded on the CPU.
#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_refines_an_adaptive_picture_as_the_command_does() {
    for block in ["1", "4"] {
        let [shown, rendered] = refined_and_rendered("gpu", block);
        let different = shown.pixels().zip(rendered.pixels()).filter(|(a, b)| a != b).count();
        println!("block {block}: {different} pixels are off by 1 of 255");
        assert_eq!(agreement(&shown, &rendered), 1.0, "block {block}");
    }
}

#[test]
#[ignore = "needs a display"]
fn keys_change_the_depth() {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE, "--depth", "15"],
        "wait settled\nkey .\nkey .\nprint\nkey ,\nkey ,\nkey ,\nprint",
    );
    let (deeper, _) = report.standard_output.split_at(report.standard_output.len() / 2);
    assert_eq!(value_in(deeper, "depth"), "16");
    assert_eq!(report.value("depth"), "13");
}
