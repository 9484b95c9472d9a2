//! Several meshes at once, what was opened before, and asking for files.

use super::window::{Display, Session, agreement, drop_files, ended, run};
use super::{SIZE, assert_same};

/// A PLY file with a square in the plane `z = 0`, its lower left corner at `x`.
fn square(x: f32) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list uchar int vertex_indices\nend_header\n\
        {x} 0 0\n{right} 0 0\n{right} 1 0\n{x} 1 0\n3 0 1 2\n3 0 2 3\n",
        right = x + 1.0
    )
}

fn with_squares() -> Session {
    let session = Session::new();
    for (name, x) in [("a.ply", 0.0), ("b b.ply", 1.5), ("c.ply", 3.0)] {
        session.write(name, &square(x));
    }
    session
}

#[test]
#[ignore = "needs a display"]
fn meshes_are_shown_together_and_more_beside_them() {
    let session = with_squares();
    let report = run(
        &session,
        &["a.ply", "b b.ply", "--backend", "cpu", "--size", SIZE],
        "wait settled
        expect triangles 4
        key I
        wait settled
        screenshot two.png
        drag left 60 0
        add mesh c.ply
        wait settled
        expect triangles 6
        print
        key R
        wait settled
        screenshot three.png
        open scene.toml c.ply
        wait settled
        expect message scene.toml is a scene file
        expect triangles 6
        open c.ply \"b b.ply\"
        wait settled
        expect triangles 4",
    );
    let azimuth = report.view().camera.azimuth;
    assert!((azimuth + 18.0).abs() < 1e-3, "it is seen from where it was: {azimuth}");
    for (names, picture) in [
        (&["a.ply", "b b.ply"][..], "two.png"),
        (&["a.ply", "b b.ply", "c.ply"], "three.png"),
    ] {
        let mut arguments = vec!["render", "--backend", "cpu", "--size", SIZE, "-o", "wanted.png"];
        arguments.extend(names);
        session.start_with(&arguments).finish();
        assert_same(
            picture,
            &session.await_picture(picture),
            &session.await_picture("wanted.png"),
        );
    }
    let colors: std::collections::BTreeSet<_> =
        session.await_picture("two.png").pixels().map(|pixel| pixel.0).collect();
    assert!(colors.len() > 2, "each mesh has a colour of its own: {colors:?}");
}

#[test]
#[ignore = "needs a display"]
fn each_of_several_is_read_again_when_it_is_saved() {
    let session = with_squares();
    let mut window = session.start(
        &["a.ply", "c.ply", "--backend", "cpu", "--size", SIZE],
        "wait settled
        key I
        wait settled
        screenshot first.png
        wait reloaded
        wait settled
        screenshot again.png",
    );
    let first = session.await_picture("first.png");
    session.replace("c.ply", &square(1.0));
    let again = session.await_picture("again.png");
    window.finish();
    assert!(agreement(&first, &again) < 0.95, "the second mesh was saved");
}

#[test]
#[ignore = "needs a display"]
fn a_scene_file_among_several_is_refused() {
    let session = with_squares();
    for command in ["view", "render", "info"] {
        let mut arguments = vec![command, "a.ply", "scene.toml"];
        if command == "render" {
            arguments.extend(["-o", "out.png"]);
        }
        let report = ended(&mut session.command(&arguments));
        assert_eq!(report.code, Some(2), "{report}");
        assert!(report.standard_error.contains("scene.toml is a scene file"), "{report}");
    }
}

#[test]
#[ignore = "needs a display"]
fn what_was_opened_is_remembered_and_opened_again() {
    let session = with_squares();
    let state = session.folder().join("state/viewer.toml");
    let play = |arguments: &[&str], text: &str| {
        let script = session.write("script.txt", text);
        let mut command = session.command(&["view", "--backend", "cpu", "--size", SIZE, "--script", &script]);
        let report = ended(command.args(arguments).env("OKTANT_STATE", &state));
        assert_eq!(report.code, Some(0), "{report}");
    };
    play(
        &["a.ply"],
        "wait settled
        open c.ply \"b b.ply\"
        wait settled
        open missing.ply
        wait settled",
    );
    let text = std::fs::read_to_string(&state).expect("the state is written");
    assert!(!text.contains("missing"), "it was never shown: {text}");
    assert!(text.contains("b b.ply") && text.contains("a.ply"), "{text}");
    play(
        &["balls"],
        "wait settled
        key Ctrl+R
        wait settled
        screenshot list.png
        key 2
        wait settled
        expect triangles 2
        recent 2
        wait settled
        expect triangles 4
        key Ctrl+R
        key Esc
        wait settled",
    );
    assert!(session.files().contains(&"list.png".into()));
    let script = session.write("script.txt", "wait settled\nrecent 7\n");
    let report =
        ended(&mut session.command(&["view", "balls", "--backend", "cpu", "--size", SIZE, "--script", &script]));
    assert_eq!(report.code, Some(1), "{report}");
    assert!(report.standard_error.contains("nothing was opened yet"), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn without_a_file_dialog_a_sentence_says_what_to_do() {
    let session = Session::new();
    let script = session.write(
        "script.txt",
        "wait settled
        key Ctrl+O
        wait milliseconds 2000
        expect message There is no file dialog here
        expect triangles 4032",
    );
    let mut command = session.command(&["view", "balls", "--backend", "cpu", "--size", SIZE, "--script", &script]);
    command
        .env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent")
        .env("PATH", session.folder());
    let report = ended(&mut command);
    assert_eq!(report.code, Some(0), "{report}");
}

/// From outside, by the display's own protocol: the window has no keyboard then, and must ask what is held.
#[test]
#[ignore = "needs a display"]
fn files_are_dragged_from_another_program() {
    let session = with_squares();
    let [a, b, c] = ["a.ply", "b b.ply", "c.ply"].map(|name| session.folder().join(name));
    let display = Display::new();
    let mut window = session.start(&["a.ply", "--backend", "cpu", "--size", SIZE], "");
    display.find_window("oktant");
    display.has_title("a.ply - 2 triangles");
    drop_files(display.id(), &[&b]);
    display.has_title("b b.ply - 2 triangles");
    for (key, files, triangles) in [
        ("shift", &[c.as_path()][..], "4 triangles"),
        ("ctrl", &[&a, &c], "8 triangles"),
    ] {
        display.presses(key, true);
        drop_files(display.id(), files);
        display.presses(key, false);
        display.has_title(triangles);
    }
    // Nothing is held any more.
    drop_files(display.id(), &[&a, &c]);
    display.has_title("4 triangles");
    drop_files(display.id(), &[&a]);
    display.has_title("a.ply - 2 triangles");
    display.do_to_window("windowfocus");
    display.key("Escape");
    window.finish();
}
