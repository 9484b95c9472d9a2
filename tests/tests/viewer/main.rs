//! The window, driven by scripts and by a display server's own pointer and keyboard.
//!
//! Oracle: the offline picture of the same view. `xvfb-run -a -s '-screen 0 1600x1200x24'` makes a display.

#![cfg(test)]

mod camera;
mod drag;
mod failures;
mod files;
mod large;
mod look;
mod materials;
mod oracle;
mod panel;
mod random;
mod saves;
mod several;
mod sight;
mod start;
mod tasks;
mod window;

use oktant::view::View;
use std::time::{Duration, Instant};
use window::{Display, Image, Session, agreement, offline, rendered_by_the_command, run, screen_of};

/// Pixels of the window in most of these tests: small, because lavapipe is slow.
const SIZE: &str = "640x480";
/// Share of the pixels that must agree within one step of 255: edges fall to one side or the other.
const AGREE: f64 = 0.999;

fn assert_same(what: &str, shown: &Image, wanted: &Image) {
    let agreement = agreement(shown, wanted);
    println!("{what}: {:.3} % of the pixels agree", agreement * 100.0);
    assert!(agreement >= AGREE, "{what}: only {agreement} of the pixels agree");
}

/// A session with each kind of step; what the window's buffers and the display show is the offline picture.
fn session_matches_the_offline_picture(backend: &str) {
    let session = Session::new();
    let script = format!(
        "wait settled
        expect backend {backend}
        drag left 100 50
        drag right 60 -20
        wheel 1
        wait settled
        key P
        key M
        key H
        wait settled
        screenshot help.png
        key ?
        key I
        resize 500 400
        wait settled
        screenshot shown.png
        print
        wait milliseconds 2500
        save saved.png"
    );
    let mut window = session.start(&["--backend", backend, "--size", SIZE], &script);
    let shown = session.await_picture("shown.png");
    let on_display = screen_of("oktant");
    let report = window.finish();
    let view = report.view();
    assert_eq!(view.samples.count(), 4, "{report}");
    assert_eq!(view.shading, oktant::view::Shading::Flat);
    let turned = View::default().camera.azimuth - 30.0;
    assert!((view.camera.azimuth - turned).abs() < 1e-3, "{report}");
    assert!((view.light.azimuth - (View::default().light.azimuth + 18.0)).abs() < 1e-3);
    let wanted = rendered_by_the_command(&session, &view, [500, 400]);
    assert_same("what the window shows", &shown, &wanted);
    assert_same("what the display shows", &on_display, &wanted);
    assert_same("what was saved", &session.await_picture("saved.png"), &wanted);
    let help = session.await_picture("help.png");
    let without = rendered_by_the_command(&session, &view, [640, 480]);
    let covered = 1.0 - agreement(&help, &without);
    assert!(
        (0.1..0.8).contains(&covered),
        "the overlay covers {covered} of the window"
    );
}

#[test]
#[ignore = "needs a display"]
fn the_cpu_shows_the_offline_picture() {
    session_matches_the_offline_picture("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn the_gpu_shows_the_offline_picture() {
    session_matches_the_offline_picture("gpu");
}

#[test]
#[ignore = "needs a display"]
fn a_wrong_picture_would_be_noticed() {
    let view = View::default();
    let mut turned = view;
    turned.camera.azimuth += 1.0;
    let (one, other) = (offline(&view, [320, 240]), offline(&turned, [320, 240]));
    assert!(agreement(&one, &other) < 0.9);
    assert_eq!(agreement(&one, &one), 1.0);
    assert_eq!(agreement(&one, &offline(&view, [321, 240])), 0.0, "another size");
}

#[test]
#[ignore = "needs a display"]
fn pointer_and_keyboard_do_what_the_script_does() {
    let session = Session::new();
    let display = Display::new();
    let scripted = run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "wait settled
        drag left 90 40
        drag right -50 30
        drag middle 25 15
        wheel 2
        key P
        wait settled
        save scripted.png
        print",
    )
    .view();
    let wanted = session.await_picture("scripted.png");
    assert_same("the script's view", &wanted, &offline(&scripted, [640, 480]));

    let mut window = session.start(&["--backend", "cpu", "--size", SIZE], "");
    display.find_window("oktant");
    display.key("i");
    display.drag(1, [90, 40]);
    display.drag(3, [-50, 30]);
    display.drag(2, [25, 15]);
    // Two notches: winit 0.30 takes press and release for one each where a device has no scroll axis.
    display.click(4);
    display.key("p");
    display.shows("after the drags", &wanted);
    display.key("ctrl+s");
    assert_same("what Ctrl+S saved", &session.await_picture("oktant-0001.png"), &wanted);
    display.key("ctrl+s");
    session.await_picture("oktant-0002.png");

    display.do_to_window("windowunmap");
    display.do_to_window("windowmap");
    display.do_to_window("windowfocus");
    display.shows("after it was hidden", &wanted);
    display.resize([420, 360]);
    display.shows("after it was resized", &offline(&scripted, [420, 360]));
    display.key("r");
    display.key("p");
    display.shows("after R and P", &offline(&View::default(), [420, 360]));
    display.key("question");
    display.key("Escape");
    let report = window.finish();
    assert!(report.standard_error.contains("oktant-0002.png"), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn steps_are_typed_and_given() {
    let session = Session::new();
    let display = Display::new();
    run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "wait settled
        set fov 30
        set material 0 base 1,0,0
        set azimuth 40
        key I
        wait settled
        screenshot scripted.png",
    );
    let wanted = session.await_picture("scripted.png");

    let mut window = session.start(
        &["--backend", "cpu", "--size", SIZE, "--set", "material 0 base 1,0,0"],
        "",
    );
    display.find_window("oktant");
    let start = Instant::now();
    // Without any pause: what follows an Enter or an Esc comes before the window is drawn. The second step stays to be
    // corrected.
    let corrected = "key --delay 0 Right\n".repeat("set azimut".len());
    display.hurries(&format!(
        "key --delay 0 slash
        type --delay 0 'set fov 30'
        key --delay 0 Return
        type --delay 0 'set azimut 40'
        key --delay 0 Return
        key --delay 0 Home
        {corrected}type --delay 0 h
        key --delay 0 Return
        key --delay 0 Escape
        key --delay 0 Tab
        key --delay 0 i"
    ));
    display.shows("what was typed", &wanted);
    // Messages stay for eight seconds, but not what is no longer true.
    assert!(start.elapsed() < Duration::from_secs(7), "{:?}", start.elapsed());
    display.key("Escape");
    let report = window.finish();
    assert_eq!(
        report.standard_error,
        "\"azimut\" is no setting; did you mean \"azimuth\".\n"
    );
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn back_ends_change_places_and_the_window_may_be_minimised() {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "wait settled
        expect backend cpu
        key I
        key B
        wait settled
        expect backend gpu
        screenshot gpu.png
        minimise
        wait milliseconds 100
        restore
        wait settled
        expect backend gpu
        key B
        wait settled
        expect backend cpu
        screenshot cpu.png
        minimise
        drag left 50 0
        restore
        double-click
        wait settled
        key R
        wait settled
        screenshot again.png
        print",
    );
    let wanted = offline(&View::default(), [640, 480]);
    for name in ["gpu.png", "cpu.png", "again.png"] {
        assert_same(name, &session.await_picture(name), &wanted);
    }
    assert!(report.value("backend").starts_with("CPU"), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn small_pixels_enlarge_the_overlay_only() {
    let session = Session::new();
    let script = session.write("script.txt", "wait settled\nscreenshot shown.png\nprint\n");
    let mut command = session.command(&["view", "--backend", "cpu", "--size", "800x600", "--script", &script]);
    command.env("WINIT_X11_SCALE_FACTOR", "2");
    let output = command.output().expect("the program starts");
    assert!(output.status.success());
    let shown = session.await_picture("shown.png");
    assert_eq!((shown.width(), shown.height()), (800, 600));
    let wanted = offline(&View::default(), [800, 600]);
    let differs = |x, y| shown.get_pixel(x, y) != wanted.get_pixel(x, y);
    assert!(differs(16, 16) && differs(400, 100) && !differs(15, 15) && !differs(400, 300));
}

#[test]
#[ignore = "needs a display"]
fn a_hand_that_drags_sees_it_move() {
    let session = Session::new();
    let drags = "drag left 40 10\ndrag left -40 -10\n".repeat(8);
    let script = format!("wait settled\n{drags}print\nwait settled\nprint");
    let report = run(&session, &["--backend", "cpu"], &script);
    let (moving, rested) = report.standard_output.split_at(report.standard_output.len() / 2);
    println!("{moving}");
    let frames: f64 = window::value_in(moving, "frames-a-second").parse().expect("it moved");
    assert!(frames > 4.0, "{frames} frames a second on a busy computer");
    assert!(window::value_in(rested, "samples").starts_with("1 of 1"), "{report}");
}
