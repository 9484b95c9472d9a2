//! Where the camera is: sides, projections, saved views, flights, and copies for elsewhere.

use super::window::{Display, Image, Session, agreement, offline, run};
use super::{AGREE, SIZE, assert_same};
use oktant::projection::Projection;
use oktant::view::View;
use std::process::Command;

const PIXELS: [u32; 2] = [640, 480];
const CPU: [&str; 4] = ["--backend", "cpu", "--size", SIZE];

/// What the program renders with arguments, besides the file and the size.
fn rendered(session: &Session, name: &str, arguments: &[&str]) -> Image {
    let mut all = vec!["render", "--backend", "cpu", "--size", SIZE, "-o", name];
    all.extend(arguments);
    session.start_with(&all).finish();
    session.await_picture(name)
}

fn bytes(session: &Session, name: &str) -> Vec<u8> {
    std::fs::read(session.folder().join(name)).expect("it was written")
}

#[test]
#[ignore = "needs a display"]
fn what_is_copied_renders_the_very_same_picture() {
    for steps in [
        "drag left 91 33\ndrag middle 17 -40\nwheel 1.5\nkey K",
        "key Shift+P\ndrag left -31 50\nwheel 3\ndrag middle 9 9",
        "fly forward 1.1\nfly right 0.3\ndrag left 20 -11\nkey Esc",
    ] {
        let session = Session::new();
        let script = format!("wait settled\n{steps}\nwait settled\nsave saved.png\ncamera arguments\ncamera table\n");
        let report = run(&session, &CPU, &script);
        let (arguments, table) = report.standard_output.split_once('\n').expect("two copies");
        let arguments: Vec<&str> = arguments.split(' ').collect();
        rendered(&session, "again.png", &arguments);
        assert_eq!(
            bytes(&session, "again.png"),
            bytes(&session, "saved.png"),
            "{steps}: {arguments:?}"
        );
        session.write("view.toml", table);
        let of_file = rendered(&session, "of-file.png", &["--view", "view.toml"]);
        assert_same(steps, &of_file, &session.await_picture("saved.png"));
        let differs = agreement(&of_file, &offline(&View::default(), PIXELS));
        assert!(differs < 0.95, "the camera has moved: {differs}");
        let viewed = [&CPU[..], &["--view", "view.toml"]].concat();
        run(&session, &viewed, "wait settled\nsave viewed.png");
        assert_eq!(
            bytes(&session, "viewed.png"),
            bytes(&session, "of-file.png"),
            "{steps}: the window takes the file, too"
        );
    }
}

#[test]
#[ignore = "needs a display"]
fn sides_and_projections_are_those_of_the_command() {
    let session = Session::new();
    let report = run(
        &session,
        &CPU,
        "key I
        wait settled
        key X
        wait settled
        screenshot right.png
        key Ctrl+Keypad1
        key Keypad5
        wait settled
        screenshot back.png
        stand top
        wheel 2
        wait settled
        screenshot top.png
        print
        key Shift+P
        key J
        key J
        wait settled
        screenshot narrow.png
        print",
    );
    let (parallel, _) = report.standard_output.split_at(report.standard_output.len() / 2);
    assert!(parallel.contains("\nprojection orthographic\n"), "{report}");
    let right = rendered(&session, "a.png", &["--azimuth", "90", "--elevation", "0"]);
    assert_same("from the right", &session.await_picture("right.png"), &right);
    let orthographic = ["--projection", "orthographic"];
    let back = [&["--azimuth", "180", "--elevation", "0"][..], &orthographic].concat();
    let back = rendered(&session, "b.png", &back);
    assert_same("from behind", &session.await_picture("back.png"), &back);
    let height = View::default().seen_height() * 0.81;
    let height = height.to_string();
    let top = [&["--elevation", "90", "--ortho-height", &height][..], &orthographic].concat();
    let top = rendered(&session, "c.png", &top);
    assert_same("from above", &session.await_picture("top.png"), &top);
    let view = report.view();
    assert_eq!((view.projection, view.field_of_view), (Projection::Perspective, 30.0));
    assert_same("narrow", &session.await_picture("narrow.png"), &offline(&view, PIXELS));
}

#[test]
#[ignore = "needs a display"]
fn saved_views_come_back_also_another_time() {
    let session = Session::new();
    let state = session.folder().join("state.toml");
    let play = |script: &str| {
        session.write("script.txt", script);
        let mut command: Command = session.command(&["view", "--script", "script.txt", CPU[0], CPU[1], CPU[2], CPU[3]]);
        let output = command
            .env("OKTANT_STATE", &state)
            .output()
            .expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("it prints text")
    };
    let first = play(
        "wait settled
        key 4
        expect message Ctrl+4
        drag left 120 40
        key Shift+P
        key Ctrl+4
        camera arguments
        key R
        key L
        key 4
        expect message Two eyes
        set stereo none
        key 4
        camera arguments",
    );
    let [saved, recalled] = first.lines().collect::<Vec<_>>()[..] else {
        panic!("{first}");
    };
    assert_eq!(saved, recalled);
    let later = play("wait settled\nview recall 4\ncamera arguments");
    assert_eq!(later.trim_end(), saved);
    session.write("other.toml", "[[sphere]]\n");
    let other = play("wait settled\nopen other.toml\nwait settled\nkey 4\nexpect message No view of this scene");
    assert_eq!(other, "");
}

#[test]
#[ignore = "needs a display"]
fn a_hand_flies_and_circles_what_is_in_the_middle() {
    let session = Session::new();
    let display = Display::new();
    let mut window = session.start(&CPU, "");
    display.find_window("oktant");
    let at_home = offline(&View::default(), PIXELS);
    display.key("i");
    display.shows("at first", &at_home);
    display.hold("w", 400);
    display.key("Escape");
    display.key("ctrl+s");
    let nearer = session.await_picture("oktant-0001.png");
    assert!(agreement(&nearer, &at_home) < 0.9, "it has flown");
    display.drag(1, [60, 0]);
    display.key("ctrl+c");
    display.key("ctrl+s");
    let turned = session.await_picture("oktant-0002.png");
    assert!(agreement(&turned, &nearer) < AGREE, "it circles");
    display.key("Escape");
    let report = window.finish();
    assert!(
        report.standard_error.contains("The camera is on the clipboard"),
        "{report}"
    );
}

#[test]
#[ignore = "needs a display"]
fn flights_of_scripts_are_as_long_as_they_say() {
    let session = Session::new();
    let report = run(
        &session,
        &CPU,
        "wait settled
        fly forward 0.5
        fly forward 0.5
        print
        fly backward 1
        key G
        wait settled
        print",
    );
    let (there, _) = report.standard_output.split_at(report.standard_output.len() / 2);
    assert!(there.contains("\nflying true\n"), "{there}");
    let view = report.view();
    assert_eq!(report.value("flying"), "false");
    // It circles the bunny's surface now, and sees what it saw.
    assert!(view.camera.distance < View::default().camera.distance - 0.2);
    assert_same("back", &offline(&view, PIXELS), &offline(&View::default(), PIXELS));
}
