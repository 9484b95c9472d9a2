//! Files that the window is given.

use super::window::{Session, agreement, run};
use super::{SIZE, assert_same};
use oktant::view::View;
use oktant_shared::orbit::Up;
use oktant_tests::spirv::CompiledKernel;

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

/// A scene file with a mesh, a plane and a light; `more` stands at its end.
fn scene(more: &str) -> String {
    format!(
        "[camera]
        position = [0.5, 1.2, 4]
        look_at = [0.5, 0.5, 0]
        [render]
        width = 400
        height = 300
        samples = 4
        depth = 3
        [materials.shiny]
        base = \"#4080c0\"
        mirror = 0.3
        [[mesh]]
        file = \"mesh.ply\"
        material = \"shiny\"
        [[light]]
        position = [3, 5, 4]
        {more}"
    )
}

#[test]
#[ignore = "needs a display"]
fn a_scene_comes_with_its_view_and_its_size() {
    let session = Session::new();
    session.write("mesh.ply", &mesh(2));
    session.write("scene.toml", &scene(""));
    let report = run(
        &session,
        &["scene.toml", "--backend", "cpu", "--depth", "4"],
        "wait settled
        key I
        wait settled
        screenshot first.png
        print
        open bunny.toml
        wait settled
        expect message bunny.toml
        expect triangles 2
        open mesh.ply
        wait settled
        open scene.toml
        wait settled
        screenshot dropped.png",
    );
    assert_eq!(report.value("size"), "400 300", "{report}");
    assert_eq!(report.value("samples"), "4 of 4", "{report}");
    assert_eq!(report.value("depth"), "4", "the command line counts: {report}");
    let arguments = [
        "render",
        "scene.toml",
        "--backend",
        "cpu",
        "--depth",
        "4",
        "-o",
        "wanted.png",
    ];
    session.start_with(&arguments).finish();
    let wanted = session.await_picture("wanted.png");
    assert_same("the scene", &session.await_picture("first.png"), &wanted);
    assert_same("the dropped scene", &session.await_picture("dropped.png"), &wanted);
    let report = run(
        &session,
        &["scene.toml", "--backend", "cpu", "--size", "320x200"],
        "wait settled\nprint",
    );
    assert_eq!(report.value("size"), "320 200", "{report}");
}

#[test]
#[ignore = "needs a display"]
fn a_scene_that_is_saved_is_read_again() {
    let session = Session::new();
    session.write("mesh.ply", &mesh(1));
    session.write("scene.toml", &scene(""));
    let mut window = session.start(
        &["scene.toml", "--backend", "cpu"],
        "wait settled
        key I
        drag left 50 10
        wait settled
        screenshot turned.png
        wait reloaded
        wait settled
        expect triangles 2
        screenshot meshed.png
        wait reloaded
        wait settled
        screenshot planed.png
        print
        wait reloaded
        expect message scene.toml
        screenshot refused.png
        wait reloaded
        wait settled
        screenshot aimed.png",
    );
    let turned = session.await_picture("turned.png");
    session.replace("mesh.ply", &mesh(2));
    let meshed = session.await_picture("meshed.png");
    assert!(agreement(&turned, &meshed) < 0.99, "the scene's mesh was saved");
    let plane = "[[plane]]\npoint = [0, -0.1, 0]\n";
    session.replace("scene.toml", &scene(plane));
    let planed = session.await_picture("planed.png");
    assert!(agreement(&planed, &meshed) < 0.8, "the scene was saved");
    session.write("scene.toml", &scene("[[plain]]"));
    session.await_picture("refused.png");
    let elsewhere = scene(plane).replace("position = [0.5, 1.2, 4]", "position = [-2, 1.5, 3]");
    session.write("scene.toml", &elsewhere);
    let aimed = session.await_picture("aimed.png");
    let report = window.finish();
    let azimuth = report.view().camera.azimuth;
    assert!(
        (azimuth + 15.0).abs() < 1e-3,
        "it stayed where the person turned it: {azimuth}"
    );
    assert!(report.standard_error.contains("did you mean \"plane\""), "{report}");
    let arguments = ["render", "scene.toml", "--backend", "cpu", "-o", "wanted.png"];
    session.start_with(&arguments).finish();
    assert_same(
        "the scene's own camera has moved",
        &aimed,
        &session.await_picture("wanted.png"),
    );
}

#[test]
#[ignore = "needs a display"]
fn a_mesh_that_was_missing_is_noticed() {
    let session = Session::new();
    session.write("mesh.ply", &mesh(1));
    session.write("scene.toml", &scene(""));
    let mut window = session.start(
        &["scene.toml", "--backend", "cpu", "--size", SIZE],
        "wait settled
        screenshot first.png
        wait reloaded
        expect message other.ply
        screenshot refused.png
        wait reloaded
        wait settled
        expect triangles 2
        screenshot other.png",
    );
    session.await_picture("first.png");
    session.replace("scene.toml", &scene("").replace("mesh.ply", "other.ply"));
    session.await_picture("refused.png");
    session.replace("other.ply", &mesh(2));
    session.await_picture("other.png");
    window.finish();
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn a_kernel_that_is_saved_is_read_again() {
    let session = Session::new();
    let good = CompiledKernel::committed();
    good.write(session.folder());
    let mut window = session.start(
        &[
            "balls",
            "--backend",
            "gpu",
            "--spirv",
            "naga",
            "--kernel",
            "oktant.spv",
            "--size",
            SIZE,
        ],
        "wait settled
        key I
        wait settled
        screenshot first.png
        wait reloaded
        expect message was read again
        wait settled
        screenshot exchanged.png
        wait reloaded
        expect message InvalidId
        expect backend gpu
        drag left 30 0
        drag left -30 0
        wait settled
        expect backend gpu
        screenshot refused.png
        wait reloaded
        expect message no entry point `hits`
        screenshot missing.png
        wait reloaded
        expect message was read again
        wait settled
        expect backend gpu
        screenshot again.png",
    );
    let first = session.await_picture("first.png");
    // Hits in the place of colours.
    let exchanged = good.exchanged("render_plain", "hits");
    exchanged.write(session.folder());
    let hits = session.await_picture("exchanged.png");
    assert!(agreement(&first, &hits) < 0.99, "another kernel runs");
    good.senseless().write(session.folder());
    let refused = session.await_picture("refused.png");
    good.renamed("hits", "hats").write(session.folder());
    session.await_picture("missing.png");
    good.write(session.folder());
    let again = session.await_picture("again.png");
    let report = window.finish();
    assert_same("the first kernel again", &again, &first);
    let below = |image: &super::Image| image::imageops::crop_imm(image, 0, 200, 640, 280).to_image();
    assert_same("the old kernel goes on", &below(&refused), &below(&hits));
    assert!(report.standard_error.contains("the old kernel goes on"), "{report}");
}

/// The GPU goes on, also where the window begins with adaptive samples.
#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn a_kernel_without_lists_goes_on_with_as_many_samples_everywhere() {
    let session = Session::new();
    CompiledKernel::committed().write(session.folder());
    let view = [
        "balls",
        "--backend",
        "gpu",
        "--kernel",
        "oktant.spv",
        "--size",
        "320x240",
    ];
    let begins = [&view[..], &["--samples", "adaptive:4"]].concat();
    let mut window = session.start(
        &begins,
        "wait settled
        expect backend gpu
        expect message no entry point `render_listed_plain`, and there is no lists
        print settings
        set samples adaptive:16
        wait settled
        expect backend gpu
        expect message goes on with samples 16
        print settings
        screenshot missing.png
        wait reloaded
        expect message was read again
        set samples adaptive:16
        wait settled
        expect backend gpu
        print settings",
    );
    session.await_picture("missing.png");
    CompiledKernel::lists().write(&session.folder().join("lists"));
    let report = window.finish();
    let samples = report
        .standard_output
        .lines()
        .filter_map(|line| line.strip_prefix("set samples "));
    assert_eq!(samples.collect::<Vec<_>>(), ["4", "16", "adaptive:16"], "{report}");
    assert_eq!(
        report.standard_error.matches("render_listed_plain").count(),
        2,
        "{report}"
    );
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn a_kernel_without_a_gpu_is_refused() {
    let session = Session::new();
    CompiledKernel::committed().write(session.folder());
    let report = session
        .start_with(&["view", "balls", "--backend", "cpu", "--kernel", "oktant.spv"])
        .wait();
    assert_eq!(report.code, Some(2), "{report}");
    // A software adapter is none that is taken without being asked for.
    let mut window = session.command(&["view", "balls", "--kernel", "oktant.spv"]);
    window.env("VK_ICD_FILENAMES", "/nowhere");
    let output = window.output().expect("the program starts");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("The kernel needs a GPU"), "{error}");
}
