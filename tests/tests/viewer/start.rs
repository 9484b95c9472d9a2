//! Opening the window: how soon, with what, and without.

use super::SIZE;
use super::window::{Session, run};
use std::time::{Duration, Instant};

#[test]
#[ignore = "needs a display"]
fn the_first_picture_comes_within_a_second() {
    let session = Session::new();
    // Once to warm the disk's cache.
    let report = || {
        run(
            &session,
            &["--backend", "cpu"],
            "wait frames 1\nprint\nexpect first-picture 1000",
        )
    };
    report();
    let start = Instant::now();
    let report = report();
    let all = start.elapsed();
    println!(
        "first picture after {} ms, window closed after {all:?}",
        report.value("first-picture")
    );
    assert!(
        all < Duration::from_millis(1500),
        "the clock starts when the process does: {all:?}"
    );
}

#[test]
#[ignore = "needs a display"]
fn without_a_real_gpu_the_cpu_renders_and_says_so() {
    let session = Session::new();
    let report = run(&session, &["--size", SIZE], "wait settled\nprint");
    if report.value("backend").starts_with("CPU") {
        let sentence = report
            .standard_error
            .lines()
            .find(|line| line.contains("the CPU renders"));
        assert!(
            sentence.is_some_and(|line| line.starts_with("There is no GPU to use")),
            "{report}"
        );
    } else {
        println!("there is a GPU here: {}", report.value("backend"));
    }
}

#[test]
#[ignore = "needs a display"]
fn without_any_driver_the_cpu_shows_the_picture() {
    let session = Session::new();
    let without_driver = |arguments: &[&str], script: &str| {
        let script = session.write("script.txt", script);
        let mut command = session.command(&["view", "--size", SIZE, "--script", &script]);
        command.args(arguments);
        // The first name is the current one, the second what older loaders read.
        command.env("VK_DRIVER_FILES", "none").env("VK_ICD_FILENAMES", "none");
        let output = command.output().expect("the program starts");
        (
            output.status.code(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    };
    let script = "wait settled
        expect backend cpu
        key B
        wait settled
        expect message There is no GPU to use
        expect backend cpu";
    let (code, standard_error) = without_driver(&[], script);
    assert_eq!(code, Some(0), "{standard_error}");
    assert_eq!(standard_error.matches("the CPU renders").count(), 2, "{standard_error}");
    let (code, standard_error) = without_driver(&["--backend", "gpu"], "wait settled");
    assert_eq!(code, Some(1), "{standard_error}");
    assert!(standard_error.contains("use --backend cpu"), "{standard_error}");
}

#[test]
#[ignore = "needs a display"]
fn no_display_is_a_sentence_and_a_picture() {
    for display in [None, Some(""), Some(":4711"), Some("nowhere:0")] {
        let session = Session::new();
        let mut command = session.command(&[]);
        command.env_remove("WAYLAND_DISPLAY").env_remove("DISPLAY");
        if let Some(display) = display {
            command.env("DISPLAY", display);
        }
        let output = command.output().expect("the program starts");
        let standard_error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{display:?}: {standard_error}");
        assert!(
            standard_error.starts_with("There is no display"),
            "{display:?}: {standard_error}"
        );
        assert!(!standard_error.contains("panicked"), "{standard_error}");
        let picture = session.await_picture("oktant.png");
        assert_eq!((picture.width(), picture.height()), (1280, 968));
    }
}
