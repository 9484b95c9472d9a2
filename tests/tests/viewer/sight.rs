//! The work behind the picture: what pixels tell, cells, pinned rays.

use super::window::{Image, Session, run};
use super::{agreement, assert_same};
use oktant_tests::program;
use serde_json::Value;

const SIZE: &str = "640x480";
/// Panels are higher up.
const BELOW_PANELS: u32 = 230;

/// What is below the panels.
fn lower(picture: &Image) -> Image {
    let height = picture.height() - BELOW_PANELS;
    image::imageops::crop_imm(picture, 0, BELOW_PANELS, picture.width(), height).to_image()
}

/// What `oktant render --show` makes of the first view.
fn shown_by_the_command(session: &Session, aspect: &str) -> Image {
    let arguments = [
        "render",
        "bunny",
        "--size",
        SIZE,
        "--show",
        aspect,
        "--legend",
        "off",
        "-o",
        "wanted.png",
    ];
    let run = program::run(session.folder(), arguments);
    assert_eq!(run.code, Some(0), "{}", run.error);
    session.await_picture("wanted.png")
}

fn pixels_tell_what_the_command_shows(backend: &str) {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", backend, "--size", SIZE],
        "key I
        wait settled
        screenshot before.png
        show steps
        wait settled
        screenshot steps.png
        print
        key V
        wait settled
        screenshot tests.png
        show normals
        wait settled
        screenshot normals.png
        show picture
        wait settled
        screenshot after.png
        print",
    );
    for (name, aspect) in [
        ("steps.png", "steps"),
        ("tests.png", "tests"),
        ("normals.png", "normals"),
    ] {
        let wanted = shown_by_the_command(&session, aspect);
        assert_same(name, &lower(&session.await_picture(name)), &lower(&wanted));
    }
    let [before, after] = ["before.png", "after.png"].map(|name| session.await_picture(name));
    assert_eq!(agreement(&before, &after), 1.0);
    let (first, last) = report.standard_output.split_at(report.standard_output.len() / 2);
    assert!(first.contains("\nshow steps\nshow-figures 0 "), "{report}");
    assert!(last.contains("\nshow picture\nshow-figures -\n"), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn pixels_tell_it_over_the_cpus_picture() {
    pixels_tell_what_the_command_shows("cpu");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn pixels_tell_it_over_the_gpus_picture() {
    pixels_tell_what_the_command_shows("gpu");
}

fn cells_and_pins_are_drawn(backend: &str, traversal: &str) {
    let session = Session::new();
    let report = run(
        &session,
        &["--backend", backend, "--size", SIZE, "--traversal", traversal],
        "key I
        wait settled
        screenshot bare.png
        key C
        wait settled
        screenshot leaves.png
        key C
        key >
        key >
        wait settled
        print
        screenshot level.png
        key C
        move 320 380
        wait settled
        screenshot pointer.png
        print
        key C
        pin 320 380
        wait settled
        screenshot pinned.png
        print
        drag left 40 0
        wait settled
        screenshot turned.png
        key Esc
        wait settled
        drag left -40 0
        wait settled
        screenshot after.png
        print",
    );
    let pictures = [
        "bare.png",
        "leaves.png",
        "level.png",
        "pointer.png",
        "pinned.png",
        "turned.png",
        "after.png",
    ];
    let [bare, leaves, level, pointer, pinned, turned, after] =
        pictures.map(|name| lower(&session.await_picture(name)));
    for (name, drawn) in [
        ("leaves", &leaves),
        ("level", &level),
        ("pointer", &pointer),
        ("pinned", &pinned),
    ] {
        let same = agreement(drawn, &bare);
        println!("{backend}: {:.1} % of the pixels are as without {name}", same * 100.0);
        // The cells of a single ray are few.
        assert!(same < 0.998, "{name}: {same}");
    }
    assert_same("the pinned cells are those under the pointer", &pinned, &pointer);
    assert!(
        agreement(&turned, &pinned) < 0.99,
        "cells stay where they are in the scene"
    );
    assert_same("after it was unpinned", &after, &bare);
    let values = |name: &str| -> Vec<&str> {
        let lines = report.standard_output.lines();
        lines
            .filter_map(|line| line.strip_prefix(name)?.strip_prefix(' '))
            .collect()
    };
    let cells = values("cells");
    assert!(
        cells[0].parse::<u32>().unwrap() <= 64 && cells[1].parse::<u32>().unwrap() > 3,
        "{report}"
    );
    assert_eq!(cells[2..], ["-", "-"]);
    let pins = values("pin");
    assert_eq!([pins[0], pins[1], pins[3]], ["-"; 3]);
    // The command that was told says the same.
    let command = report
        .standard_error
        .lines()
        .find_map(|line| line.strip_prefix("oktant trace "));
    let command = command.unwrap_or_else(|| panic!("no command in {report}"));
    let traced = program::run(
        session.folder(),
        ["trace", "--json"].into_iter().chain(command.split(' ')),
    );
    let trace: Value = serde_json::from_str(&traced.output).expect("JSON");
    let count = |list: &str| trace[list].as_array().unwrap().len();
    let said: Vec<f32> = pins[2].split(' ').map(|word| word.parse().unwrap()).collect();
    let hit = [&trace["hit"]["triangle"], &trace["hit"]["t"]].map(|number| number.as_f64().unwrap() as f32);
    let visits = trace["visits"].as_array().unwrap();
    let nodes = visits.iter().filter(|visit| visit["kind"] == "node").count();
    // The octree visits leaves alone.
    let steps = if nodes == 0 { visits.len() } else { nodes };
    let wanted = [hit[0], hit[1], steps as f32, count("tests") as f32, visits.len() as f32];
    assert_eq!(said, wanted, "{report}");
}

#[test]
#[ignore = "needs a display"]
fn cells_and_pins_are_over_the_cpus_picture() {
    cells_and_pins_are_drawn("cpu", "octree");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn cells_and_pins_are_over_the_gpus_picture() {
    // lavapipe takes long over the kernel that has all traversals.
    cells_and_pins_are_drawn("gpu", "octants");
}

#[test]
#[ignore = "needs a display"]
fn what_means_nothing_ends_the_script() {
    let session = Session::new();
    let report = session
        .start(
            &["balls", "--backend", "cpu", "--size", SIZE, "--traversal", "brute"],
            "show steps",
        )
        .wait();
    assert_eq!(report.code, Some(1), "{report}");
    assert!(
        report
            .standard_error
            .contains("steps means nothing with --traversal brute"),
        "{report}"
    );
}
