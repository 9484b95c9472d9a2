//! Devices that are lost, too small or not there, in the window and without one.

use super::window::{Report, Session, ended, offline};
use super::{SIZE, assert_same};
use oktant::view::View;

/// Plays a script where the GPU has this to suffer.
fn suffers(session: &Session, hardship: &str, arguments: &[&str], script: &str) -> Report {
    let script = session.write("script.txt", script);
    let mut command = session.command(&["view", "--script", &script]);
    let report = ended(command.args(arguments).env("OKTANT_TEST_GPU", hardship));
    assert_eq!(report.code, Some(0), "{report}");
    report
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn a_lost_device_is_opened_again_once_and_then_the_cpu_takes_over() {
    let session = Session::new();
    let report = suffers(
        &session,
        "",
        &["--backend", "gpu", "--size", SIZE],
        "wait settled
        expect backend gpu
        key P
        key P
        wait settled
        lose device
        wait milliseconds 1000
        expect message it is opened again
        wait settled
        expect backend gpu
        key I
        wait milliseconds 8500
        wait settled
        screenshot again.png
        lose device
        wait milliseconds 1000
        expect message the CPU renders
        wait settled
        expect backend cpu
        wait milliseconds 8500
        wait settled
        screenshot cpu.png
        print",
    );
    let wanted = offline(&View::default(), [640, 480]);
    assert_same("after the first loss", &session.await_picture("again.png"), &wanted);
    assert_same("after the second", &session.await_picture("cpu.png"), &wanted);
    assert!(report.value("backend").starts_with("CPU"), "{report}");
    assert_eq!(report.standard_error.matches("was lost").count(), 2, "{report}");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn a_device_that_is_lost_while_it_draws_leaves_the_panel_as_it_was() {
    let session = Session::new();
    let report = suffers(
        &session,
        "",
        &["balls", "--backend", "gpu", "--size", SIZE, "--panel", "on"],
        "wait settled
        expect backend gpu
        set material 0 mirror 0.25
        drag left 50 20
        wait settled
        screenshot before.png
        drag left 10 0
        lose device
        drag left -10 0
        wait settled
        wait milliseconds 8500
        wait settled
        expect backend gpu
        screenshot after.png",
    );
    let below = |image: super::window::Image| image::imageops::crop_imm(&image, 0, 200, 320, 280).to_image();
    assert_same(
        "the same view and material",
        &below(session.await_picture("after.png")),
        &below(session.await_picture("before.png")),
    );
    assert!(!report.standard_error.contains("mistake"), "{report}");
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn triangles_that_are_too_large_become_indices_and_then_the_cpu_renders() {
    // Of the bunny, rows of 48 bytes take 3.3 MB, its nodes 1 MB.
    for (hardship, backend, traversal) in [
        ("binding=3000000", "gpu", "compact"),
        ("memory=4000000", "gpu", "compact"),
        // More than the picture takes, 0.3 MB.
        ("binding=400000", "cpu", "compact"),
    ] {
        let session = Session::new();
        let script = format!(
            "wait settled
            wait milliseconds 300
            wait settled
            expect backend {backend}
            key I
            wait milliseconds 8500
            wait settled
            screenshot shown.png
            print"
        );
        let report = suffers(&session, hardship, &["--backend", "gpu", "--size", "160x120"], &script);
        assert_eq!(report.value("traversal"), traversal, "{hardship}: {report}");
        assert!(report.standard_error.contains("triangles as indices"), "{report}");
        assert!(report.standard_error.contains(" bytes"), "how much was asked: {report}");
        assert_same(
            hardship,
            &session.await_picture("shown.png"),
            &offline(&View::default(), [160, 120]),
        );
    }
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn commands_end_with_a_sentence_or_go_on_with_less() {
    let session = Session::new();
    let render = |hardship: &str, backend: &str| {
        let arguments = ["render", "--size", "320x240", "--backend", backend, "-o", "out.png"];
        ended(session.command(&arguments).env("OKTANT_TEST_GPU", hardship))
    };
    for (hardship, sentence) in [
        ("waits=0", "was lost"),
        ("binding=3000000", "binds at most 3000000 at once"),
        ("memory=4000000", "has no room for the triangles"),
        ("luck=3", "OKTANT_TEST_GPU is"),
    ] {
        let report = render(hardship, "gpu");
        assert_eq!(report.code, Some(1), "{hardship}: {report}");
        assert!(report.standard_error.contains(sentence), "{hardship}: {report}");
        assert!(!report.standard_error.contains("panicked"), "{report}");
        assert_eq!(report.standard_error.trim_end().lines().count(), 1, "{report}");
        assert!(!session.files().contains(&"out.png".into()), "nothing is half written");
    }
    for (hardship, sentences) in [
        ("software,waits=0", &["was lost", "the CPU renders"][..]),
        ("software,binding=3000000", &["triangles as indices", "llvmpipe"]),
        ("software,binding=100000", &["triangles as indices", "the CPU renders"]),
    ] {
        let report = render(hardship, "auto");
        assert_eq!(report.code, Some(0), "{hardship}: {report}");
        for sentence in sentences {
            assert!(
                report.standard_error.contains(sentence),
                "{hardship}, {sentence}: {report}"
            );
        }
        let wanted = offline(&View::default(), [320, 240]);
        assert_same(hardship, &session.await_picture("out.png"), &wanted);
        std::fs::remove_file(session.folder().join("out.png")).expect("it was written");
    }
}

#[test]
#[ignore = "needs a display"]
fn broken_drivers_are_told_of() {
    let session = Session::new();
    session.write("text.json", "this is no JSON");
    session.write(
        "missing.json",
        r#"{"file_format_version": "1.0.0", "ICD": {"library_path": "/nonexistent/libvulkan_none.so", "api_version": "1.3.0"}}"#,
    );
    for driver in ["/nonexistent", "text.json", "missing.json"] {
        let script = session.write("script.txt", "wait settled\nexpect backend cpu\n");
        let with_driver = |arguments: &[&str]| {
            let mut command = session.command(arguments);
            ended(command.env("VK_DRIVER_FILES", driver).env("VK_ICD_FILENAMES", driver))
        };
        for (arguments, code, sentence) in [
            (
                &["view", "balls", "--size", SIZE, "--script", &script][..],
                0,
                "the CPU renders",
            ),
            (
                &["view", "balls", "--backend", "gpu", "--script", &script],
                1,
                "use --backend cpu",
            ),
            (
                &["render", "balls", "--size", "64x48", "-o", "out.png"],
                0,
                "the CPU renders",
            ),
            (
                &["render", "balls", "--backend", "gpu", "-o", "none.png"],
                1,
                "use --backend cpu",
            ),
        ] {
            let report = with_driver(arguments);
            assert_eq!(report.code, Some(code), "{driver}, {arguments:?}: {report}");
            let sentences = report.standard_error.matches("There is no GPU to use").count();
            assert_eq!(sentences, 1, "{driver}, {arguments:?}: {report}");
            assert!(
                report.standard_error.contains(sentence),
                "{driver}, {arguments:?}: {report}"
            );
            assert!(!report.standard_error.contains("panicked"), "{report}");
        }
        assert!(!session.files().contains(&"none.png".into()));
    }
}

#[test]
#[ignore = "needs a display"]
fn what_is_chosen_while_a_file_is_opened_is_built() {
    let session = Session::new();
    session.write("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let script = "wait settled
        show leaf-depth
        set traversal bvh2
        open missing.ply
        wait settled
        pin 320 240
        wait settled
        open corner.obj
        set traversal brute
        wait settled
        pin 320 240
        wait settled
        print";
    let report = session
        .start(&["balls", "--backend", "cpu", "--size", SIZE], script)
        .finish();
    let commands: Vec<&str> = report
        .standard_error
        .lines()
        .filter(|line| line.contains("--ray"))
        .collect();
    let [after_none, after_another] = commands[..] else {
        panic!("{report}");
    };
    assert!(after_none.starts_with("oktant trace balls ") && after_none.ends_with(" --traversal bvh2"));
    assert!(after_another.starts_with("oktant trace corner.obj ") && after_another.ends_with(" --traversal brute"));
    assert_eq!(report.value("show"), "picture", "there are no leaves");
}
