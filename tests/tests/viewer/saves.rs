//! Pictures that are saved while other things happen.

use super::window::{Session, agreement, run};

/// Mirrors that see each other and a floor, and very many rays.
const SLOW: &str = "
    [render]
    width = 900
    height = 700
    samples = 64
    depth = 12
    [materials.mirror]
    mirror = 0.9
    [materials.floor]
    base = \"#4080c0\"
    mirror = 0.5
    [[sphere]]
    center = [0, 1, 0]
    radius = 1
    material = \"mirror\"
    [[sphere]]
    center = [2.1, 1, 0]
    radius = 1
    material = \"mirror\"
    [[plane]]
    point = [0, 0, 0]
    material = \"floor\"
    [[light]]
    kind = \"area\"
    corner = [2, 6, 3]
    edge_u = [1, 0, 0]
    edge_v = [0, 0, 1]
    samples_per_side = 8
";

#[test]
#[ignore = "needs a display"]
fn whoever_closes_the_window_is_told_what_is_not_saved() {
    let session = Session::new();
    session.write("scene.toml", SLOW);
    let report = run(
        &session,
        &["scene.toml", "--backend", "cpu"],
        "wait frames 1
        key I
        screenshot before.png
        key Ctrl+S
        key Ctrl+S
        wait milliseconds 1500
        screenshot saving.png
        drag left 100 0
        wait frames 1
        quit",
    );
    let sentence = report.standard_error.lines().find(|line| line.starts_with("Not saved"));
    assert!(
        sentence.is_some_and(|line| line.contains("oktant-0001.png") && line.contains("a picture in")),
        "{report}"
    );
    let files = session.files();
    assert!(
        !files.iter().any(|name| name.contains("oktant-")),
        "neither picture nor temporary file: {files:?}"
    );
    let [before, saving] = ["before.png", "saving.png"].map(|name| session.await_picture(name));
    let corner = |image: &super::Image| image::imageops::crop_imm(image, 0, 0, 300, 60).to_image();
    assert!(
        agreement(&corner(&before), &corner(&saving)) < 0.9,
        "how far it is stands in the corner"
    );
}
