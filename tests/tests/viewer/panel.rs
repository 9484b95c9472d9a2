//! The panel at the window's right side, and what it sets.

use super::window::{Image, Session, agreement, offline, run, value_in};
use super::{SIZE, assert_same};
use image::imageops::crop_imm;
use oktant::sampling::Samples;
use oktant::tone::Curve;
use oktant::view::{Shading, View};

const PIXELS: [u32; 2] = [640, 480];
/// The panel covers no more at first, pixels.
const WIDTH: u32 = 330;

fn left(image: &Image) -> Image {
    crop_imm(image, 0, 0, PIXELS[0] - WIDTH, PIXELS[1]).to_image()
}

fn right(image: &Image) -> Image {
    crop_imm(image, image.width() - 280, 0, 280, image.height()).to_image()
}

/// Opens and closes it; returns what the window shows with it.
fn the_panel_lies_over_the_picture(backend: &str) -> Image {
    let session = Session::new();
    let script = format!(
        "key I
        wait settled
        expect backend {backend}
        key Tab
        wait settled
        screenshot open.png
        save saved.png
        key Tab
        wait settled
        screenshot closed.png"
    );
    run(&session, &["--backend", backend, "--size", SIZE], &script);
    let wanted = offline(&View::default(), PIXELS);
    let [open, saved, closed] = ["open.png", "saved.png", "closed.png"].map(|name| session.await_picture(name));
    assert_same("beside the panel", &left(&open), &left(&wanted));
    assert!(
        agreement(&right(&open), &right(&wanted)) < 0.1,
        "the panel covers the rest"
    );
    assert_same("what was saved", &saved, &wanted);
    assert_same("without the panel", &closed, &wanted);
    open
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_draws_the_panel() {
    the_panel_lies_over_the_picture("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_draws_the_same_panel() {
    let [cpu, gpu] = ["cpu", "gpu"].map(|backend| right(&the_panel_lies_over_the_picture(backend)));
    // Edges of letters are blended in linear light on the GPU; names of the back ends differ.
    let near = cpu.pixels().zip(gpu.pixels()).filter(|(a, b)| {
        let differences = a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b));
        differences.max() <= Some(60)
    });
    let share = near.count() as f64 / (cpu.width() * cpu.height()) as f64;
    println!("{share} of the panel's pixels are near each other");
    assert!(share > 0.95, "{share}");
}

#[test]
#[ignore = "needs a display"]
fn settings_do_what_options_do() {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "wait settled
        set samples 4
        set shading flat
        set depth 3
        set exposure 0.5
        set tone aces
        set azimuth 30
        set light-elevation 10
        key I
        wait settled
        screenshot shown.png
        print",
    );
    let mut view = View {
        samples: Samples::Four,
        shading: Shading::Flat,
        depth: 3,
        ..View::default()
    };
    (view.tone.curve, view.tone.exposure) = (Curve::Aces, 0.5);
    (view.camera.azimuth, view.light.elevation) = (30.0, 10.0);
    assert_eq!(
        report.view(),
        View {
            target: report.view().target,
            ..view
        },
        "{report}"
    );
    assert_same(
        "what is set",
        &session.await_picture("shown.png"),
        &offline(&view, PIXELS),
    );
}

#[test]
#[ignore = "needs a display"]
fn what_is_done_on_the_panel_does_not_turn_the_camera() {
    let session = Session::new();
    // The middle of the window is on the panel, among names of settings.
    let report = run(
        &session,
        &["--backend", "cpu", "--size", "520x400", "--panel", "on"],
        "wait settled
        print
        drag left 20 30
        drag right 20 30
        wheel 3
        wait settled
        print
        key Tab
        drag left 20 30
        print",
    );
    let cameras: Vec<&str> = report
        .standard_output
        .lines()
        .filter(|line| line.starts_with("camera ") || line.starts_with("light "))
        .collect();
    assert_eq!(cameras.len(), 6, "{report}");
    assert_eq!(cameras[..2], cameras[2..4]);
    assert_ne!(cameras[2], cameras[4], "without the panel it turns");
}

#[test]
#[ignore = "needs a display"]
fn clicks_fold_and_unfold() {
    let session = Session::new();
    run(
        &session,
        &["--backend", "cpu", "--size", SIZE, "--panel", "on"],
        "wait settled
        screenshot before.png
        click 400 11
        wait settled
        screenshot clicked.png
        click 400 11
        click 10 400
        wait settled
        screenshot again.png",
    );
    let [before, clicked, again] =
        ["before.png", "clicked.png", "again.png"].map(|name| right(&session.await_picture(name)));
    assert!(agreement(&before, &clicked) < 0.98, "{}", agreement(&before, &clicked));
    // Times have changed.
    assert!(agreement(&before, &again) > 0.98, "{}", agreement(&before, &again));
}

#[test]
#[ignore = "needs a display"]
fn a_material_that_is_picked_is_there_once_all_is_settled() {
    let session = Session::new();
    run(
        &session,
        &["--backend", "cpu", "--size", "640x960"],
        "panel on
        wait settled
        screenshot before.png
        pick 320 560
        wait settled
        screenshot picked.png
        wait milliseconds 300
        screenshot later.png",
    );
    // Where its table is, below what can be set of the picture; the figures further down go on changing.
    let table = |name: &str| crop_imm(&right(&session.await_picture(name)), 0, 460, 280, 240).to_image();
    let [before, picked, later] = ["before.png", "picked.png", "later.png"].map(table);
    let settled = agreement(&picked, &later);
    assert_eq!(settled, 1.0, "it was not complete");
    let changed = agreement(&before, &picked);
    println!("the table changed {:.1} % of the pixels", (1.0 - changed) * 100.0);
    assert!(changed < 0.95, "{changed}: there is no table");
}

/// Pixels of the text of warnings.
pub fn warning_pixels(image: &Image) -> usize {
    let is_warning = |pixel: &[u8; 3]| {
        pixel
            .iter()
            .zip([255, 190, 92])
            .all(|(is, wanted)| is.abs_diff(wanted) <= 1)
    };
    image.pixels().filter(|pixel| is_warning(&pixel.0)).count()
}

#[test]
#[ignore = "needs a display"]
fn a_message_ends_where_the_panel_begins() {
    let session = Session::new();
    run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "key I
        wait settled
        open a-folder-that-nobody-has-made/with-a-mesh-that-is-not-there.ply
        wait settled
        expect message nobody
        screenshot closed.png
        panel on
        wait settled
        screenshot open.png",
    );
    // The same letters, in other lines. The panel hides what lies under it.
    let [closed, open] = ["closed.png", "open.png"].map(|name| warning_pixels(&session.await_picture(name)));
    assert!(closed > 500, "{closed} pixels of text");
    assert_eq!(open, closed);
}

#[test]
#[ignore = "needs a display"]
fn an_idle_panel_draws_nothing() {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE, "--panel", "on"],
        "wait settled
        wait milliseconds 1500
        print
        wait milliseconds 1000
        print",
    );
    let (before, after) = report.standard_output.split_at(report.standard_output.len() / 2);
    let drawn = |text| value_in(text, "drawn");
    assert_eq!(drawn(before), drawn(after), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn a_pointer_that_passes_draws_nothing() {
    let session = Session::new();
    let moves: String = (1..=20)
        .map(|step| format!("move {} {}\n", 20 * step, 15 * step))
        .collect();
    let script = format!("wait settled\nwait milliseconds 500\nprint\n{moves}wait milliseconds 300\nprint");
    let report = run(&session, &["--backend", "cpu", "--size", SIZE], &script);
    let (before, after) = report.standard_output.split_at(report.standard_output.len() / 2);
    let drawn = |text| value_in(text, "drawn");
    assert_eq!(drawn(before), drawn(after), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn settings_that_make_no_sense_are_refused() {
    let session = Session::new();
    let start = |script: &str| session.start(&["--backend", "cpu", "--size", SIZE], script).wait();
    let unknown = start("set sampels 4");
    assert_eq!(unknown.code, Some(2), "{unknown}");
    assert!(unknown.standard_error.contains("did you mean \"samples\""), "{unknown}");
    let refused = start("wait settled\nset eye-distance 0.1");
    assert_eq!(refused.code, Some(1), "{refused}");
    assert!(
        refused.standard_error.contains("line 2: only pictures for two eyes"),
        "{refused}"
    );
}

/// Lights, materials and surroundings that are changed, and the scene file that says the same.
fn a_changed_scene_is_the_one_that_a_file_describes(backend: &str) {
    let session = Session::new();
    let scene = |material: &str, rest: &str| {
        format!(
            "[camera]\nposition = [0.0, 1.0, 4.0]\nlook_at = [0.0, 0.0, 0.0]\n\
            [materials.floor]\nbase = [0.8, 0.7, 0.6]\n\
            [materials.ball]\n{material}\n\
            [[sphere]]\ncenter = [0.0, 0.0, 0.0]\nradius = 1.0\nmaterial = \"ball\"\n\
            [[plane]]\npoint = [0.0, -1.0, 0.0]\nnormal = [0.0, 1.0, 0.0]\nmaterial = \"floor\"\n\
            [[light]]\nposition = [3.0, 4.0, 5.0]\n{rest}"
        )
    };
    session.write("plain.toml", &scene("base = [0.5, 0.5, 0.5]", ""));
    let changed = "base = [0.5, 0.5, 0.5]\nmirror = 0.5\ntransmission = 0.25\nior = 1.3\nfresnel = true\ndiffuse = 0.4\nambient = 1.0";
    let lights = "color = [1.0, 0.5, 0.25]\n[[light]]\nposition = [-3.0, 2.0, 1.0]\ncolor = [0.0, 0.0, 1.0]\n\
        [environment]\nzenith = [0.0, 0.0, 1.0]\nhorizon = [1.0, 1.0, 1.0]\nnadir = [0.0, 0.0, 0.0]\n";
    session.write("wanted.toml", &format!("ambient = 0.3\n{}", scene(changed, lights)));
    let script = "key I
        wait settled
        set material 0 mirror 0.5
        set material 0 transmission 0.25
        set material 0 ior 1.3
        set material 0 fresnel on
        set material 0 diffuse 0.4
        set light 0 color 1,0.5,0.25
        add light
        add light
        remove light 1
        set light 1 position -3,2,1
        set light 1 color 0,0,1
        set environment zenith 0,0,1
        set environment horizon 1
        set environment nadir 0
        set environment ambient 0.3
        pick 320 240
        key Tab
        wait settled
        screenshot shown.png
        print";
    let report = run(&session, &["plain.toml", "--backend", backend, "--size", SIZE], script);
    assert_eq!(
        (report.value("lights"), report.value("material")),
        ("2".into(), "0".into()),
        "{report}"
    );
    let arguments = [
        "render",
        "wanted.toml",
        "--backend",
        "cpu",
        "--size",
        SIZE,
        "-o",
        "wanted.png",
    ];
    session.start_with(&arguments).finish();
    assert_same(
        "the changed scene",
        &session.await_picture("shown.png"),
        &session.await_picture("wanted.png"),
    );
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_shows_what_is_changed() {
    a_changed_scene_is_the_one_that_a_file_describes("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_shows_what_is_changed() {
    a_changed_scene_is_the_one_that_a_file_describes("gpu");
}

#[test]
#[ignore = "needs a display"]
fn structures_are_built_while_the_view_stays() {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "key I
        wait settled
        drag left 40 20
        set traversal octree
        set triangle moller-trumbore
        wait settled
        print
        set traversal bvh2
        set build fast
        wait settled
        screenshot shown.png
        print",
    );
    let (octree, _) = report.standard_output.split_at(report.standard_output.len() / 2);
    assert_eq!(value_in(octree, "traversal"), "octree");
    assert_eq!(value_in(octree, "triangle"), "moller-trumbore");
    assert_eq!(value_in(octree, "box"), "williams", "the one that is offered with it");
    assert_eq!(report.value("traversal"), "bvh2");
    let view = report.view();
    assert_ne!(view.camera, View::default().camera);
    assert_same(
        "through another structure",
        &session.await_picture("shown.png"),
        &offline(&view, PIXELS),
    );
}

#[test]
#[ignore = "needs a display"]
fn the_panel_is_left_as_it_was() {
    let session = Session::new();
    let state = session.folder().join("state/viewer.toml");
    let play = |script: &str| {
        let script = session.write("script.txt", script);
        let mut command = session.command(&["view", "--backend", "cpu", "--size", SIZE, "--script", &script]);
        let output = command
            .env("OKTANT_STATE", &state)
            .output()
            .expect("the program starts");
        assert!(output.status.success());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let complaints = play("wait settled\nkey Tab\nwait settled\nscreenshot first.png\nclick 400 11\nwait settled");
    assert!(!complaints.contains("remembered"), "{complaints}");
    let text = std::fs::read_to_string(&state).expect("it was written");
    assert!(text.contains("panel = true") && text.contains("unfolded"), "{text}");
    play("wait settled\nscreenshot second.png");
    let [first, second] = ["first.png", "second.png"].map(|name| right(&session.await_picture(name)));
    let alike = agreement(&first, &second);
    assert!(
        (0.3..0.99).contains(&alike),
        "it is open, and a section was folded: {alike}"
    );
    std::fs::write(&state, "panel = maybe").expect("it can be written");
    let complaints = play("wait settled");
    assert!(complaints.contains("cannot be used"), "{complaints}");
    let text = std::fs::read_to_string(&state).expect("it is there");
    assert!(text.contains("panel = false"), "{text}");
}
