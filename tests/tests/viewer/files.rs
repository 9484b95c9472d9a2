//! Files that the window is given.

use super::window::{Session, agreement, run};
use super::{SIZE, assert_same};
use oktant::view::View;
use oktant_shared::orbit::Up;

/// A PLY file with so many triangles, at most 2, of a square.
fn mesh(triangles: usize) -> String {
    let faces = ["3 0 1 2\n", "3 2 1 3\n"][..triangles].concat();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face {triangles}\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n1 1 0\n{faces}"
    )
}

#[test]
#[ignore = "needs a display"]
fn scripts_that_fail_say_where() {
    let session = Session::new();
    let script = session.write("script.txt", "print\n\nwait setled\n");
    let report = session.start_with(&["view", "--script", &script]).wait();
    assert_eq!(report.code, Some(2), "{report}");
    assert!(
        report.standard_error.contains("script.txt, line 3: \"setled\"")
            && report.standard_error.contains("did you mean \"settled\""),
        "{report}"
    );
    let report = session.start_with(&["view", "--script", "missing.txt"]).wait();
    assert_eq!(report.code, Some(2), "{report}");

    let script = session.write("script.txt", "wait settled\nexpect triangles 3\n");
    let report = session
        .start_with(&["view", "balls", "--backend", "cpu", "--size", SIZE, "--script", &script])
        .wait();
    assert_eq!(report.code, Some(1), "{report}");
    assert!(
        report
            .standard_error
            .contains("script.txt, line 2: the mesh has 4032 triangles"),
        "{report}"
    );

    let report = session.start_with(&["view", "missing.ply", "--backend", "cpu"]).wait();
    assert_eq!(report.code, Some(1), "{report}");
    assert!(report.standard_error.contains("missing.ply"), "{report}");
}

#[test]
#[ignore = "needs a display"]
fn dropped_files_are_opened_or_refused() {
    let session = Session::new();
    let triangle = &mesh(1);
    session.write("triangle.ply", triangle);
    session.write("broken.ply", &triangle[..80]);
    session.write("empty.ply", &triangle.replace("0 1 0\n", "2 0 0\n"));
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "wait settled
        open missing.ply
        wait settled
        expect message missing.ply
        expect triangles 69451
        open broken.ply
        wait settled
        expect message broken.ply
        expect triangles 69451
        open empty.ply
        wait settled
        expect message empty.ply
        expect triangles 69451
        screenshot refused.png
        drag left 100 0
        open triangle.ply
        wait settled
        expect triangles 1
        key I
        wait milliseconds 8500
        wait settled
        screenshot opened.png
        print",
    );
    let view = report.view();
    assert_eq!(
        (view.camera, view.up),
        (View::default().camera, Up::Y),
        "a new mesh is seen from the first view"
    );
    assert_ne!(
        session.await_picture("opened.png"),
        session.await_picture("refused.png")
    );
}

#[test]
#[ignore = "needs a display"]
fn a_file_that_is_saved_is_read_again() {
    let session = Session::new();
    session.write("mesh.ply", &mesh(1));
    let mut window = session.start(
        &["mesh.ply", "--backend", "cpu", "--size", SIZE, "--azimuth", "20"],
        "wait settled
        expect triangles 1
        key I
        key M
        drag left 30 20
        drag right 30 20
        wait settled
        screenshot first.png
        wait reloaded
        wait settled
        expect triangles 2
        screenshot replaced.png
        wait reloaded
        expect message mesh.ply
        expect triangles 2
        screenshot refused.png
        wait reloaded
        wait settled
        expect triangles 1
        screenshot again.png
        print",
    );
    let first = session.await_picture("first.png");
    session.replace("mesh.ply", &mesh(2));
    let replaced = session.await_picture("replaced.png");
    assert!(agreement(&first, &replaced) < 0.9);
    session.write("mesh.ply", &mesh(1)[..150]);
    let refused = session.await_picture("refused.png");
    session.write("mesh.ply", &mesh(1));
    let again = session.await_picture("again.png");
    let report = window.finish();
    assert_same("the same mesh again, seen as before", &again, &first);
    let below = |image: &super::Image| image::imageops::crop_imm(image, 0, 200, 640, 280).to_image();
    assert_same(
        "the old picture stays below the message",
        &below(&refused),
        &below(&replaced),
    );
    assert_ne!(refused, replaced, "there is a message");
    let view = report.view();
    assert_eq!(view.samples.count(), 4, "{report}");
    assert!((view.camera.azimuth - 11.0).abs() < 1e-3, "{report}");
}
