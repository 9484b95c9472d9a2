//! Materials by the names that files give them: what a name sets is what the number does.

use super::panel::warning_pixels;
use super::window::{Session, agreement, run};
use super::{SIZE, assert_same};

/// Two triangles side by side, in the plane z = 0.
const CORNERS: [[f32; 3]; 6] = [
    [-2.0, -1.0, 0.0],
    [0.0, -1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [2.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
];

fn write_obj(session: &Session) -> String {
    session.write(
        "two.mtl",
        "newmtl glass\nKd 0.5 0.5 0.5\nnewmtl old wood\nKd 0.4 0.4 0.4\n",
    );
    let corners = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    let faces = "usemtl glass\nf 1 2 3\nusemtl old wood\nf 4 5 6\n";
    session.write("two.obj", &format!("mtllib two.mtl\n{corners}{faces}"))
}

fn write_gltf(session: &Session) -> String {
    let bytes: Vec<u8> = CORNERS
        .iter()
        .flatten()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    std::fs::write(session.folder().join("two.bin"), bytes).unwrap();
    let text = r#"{
        "asset": { "version": "2.0" },
        "buffers": [{ "uri": "two.bin", "byteLength": 72 }],
        "bufferViews": [{ "buffer": 0, "byteLength": 72 }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-2, -1, 0], "max": [0, 1, 0] },
            { "bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, -1, 0], "max": [2, 1, 0] }
        ],
        "materials": [{ "name": "glass" }, { "name": "old wood" }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0 }, "material": 0 },
            { "attributes": { "POSITION": 1 }, "material": 1 }
        ] }],
        "nodes": [{ "mesh": 0 }],
        "scenes": [{ "nodes": [0] }],
        "scene": 0
    }"#;
    session.write("two.gltf", text)
}

fn a_name_sets_what_the_number_does(session: &Session, file: &str) {
    let arguments = [file, "--backend", "cpu", "--size", SIZE];
    let script = "key I
        wait settled
        screenshot before.png
        print settings
        set material glass base 1,0,0
        set material \"old wood\" base 0,0,1
        wait settled
        screenshot named.png";
    let named = run(session, &arguments, script);
    let settings: Vec<&str> = named.standard_output.lines().collect();
    let number = |name: &str| {
        let remark = format!(" is \"{name}\"");
        let line = settings.iter().find(|line| line.ends_with(&remark));
        let line = line.unwrap_or_else(|| panic!("{name} is not told: {named}"));
        line.strip_prefix("# material ")
            .and_then(|line| line.strip_suffix(&remark))
            .expect("a number")
            .to_string()
    };
    let script = format!(
        "key I
        wait settled
        set material {} base 1,0,0
        set material {} base 0,0,1
        wait settled
        screenshot numbered.png",
        number("glass"),
        number("old wood")
    );
    run(session, &arguments, &script);
    let [before, named, numbered] =
        ["before.png", "named.png", "numbered.png"].map(|picture| session.await_picture(picture));
    assert_same(file, &named, &numbered);
    assert!(agreement(&before, &named) < 0.95, "{file}: nothing is seen of it");
    // Which is which: the left one is red.
    let at = |x: u32| named.get_pixel(x, 240).0;
    assert!(at(220)[0] > at(220)[2], "{file}: {:?}", at(220));
    assert!(at(420)[2] > at(420)[0], "{file}: {:?}", at(420));
}

#[test]
#[ignore = "needs a display"]
fn materials_are_set_by_their_names() {
    let session = Session::new();
    for write in [write_obj, write_gltf] {
        let file = write(&session);
        a_name_sets_what_the_number_does(&session, &file);
    }
}

#[test]
#[ignore = "needs a display"]
fn a_name_that_no_material_has_is_refused() {
    let session = Session::new();
    let file = write_obj(&session);
    let start = |script: &str| {
        session
            .start(&[&file, "--backend", "cpu", "--size", SIZE], script)
            .wait()
    };
    let mistaken = start("wait settled\nset material \"old wodo\" mirror 0.5");
    assert_eq!(mistaken.code, Some(1), "{mistaken}");
    let wanted = "line 2: \"old wodo\" is no material; did you mean \"old wood\".";
    assert!(mistaken.standard_error.contains(wanted), "{mistaken}");
    let unclosed = start("wait settled\nset material \"old wood mirror 0.5");
    assert_eq!(unclosed.code, Some(2), "{unclosed}");
}

#[test]
#[ignore = "needs a display"]
fn what_is_missing_beside_a_file_is_told_in_the_window() {
    let session = Session::new();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    session.write("a.mtl", "newmtl painted\nmap_Kd gone.png\n");
    let whole = format!("mtllib a.mtl\n{corners}usemtl painted\nf 1 2 3\n");
    session.write("one.obj", &whole);
    session.write("two.obj", &format!("mtllib lost.mtl\n{whole}"));
    session.write("none.obj", &format!("{corners}f 1 2 3\n"));
    let report = run(
        &session,
        &["--backend", "cpu", "--size", SIZE],
        "key I
        wait settled
        open one.obj
        wait settled
        expect message gone.png
        screenshot one.png
        open two.obj
        wait settled
        expect message lost.mtl
        expect message ; and 1 more.
        open none.obj
        wait settled
        screenshot none.png",
    );
    let [one, none] = ["one.png", "none.png"].map(|name| warning_pixels(&session.await_picture(name)));
    assert!(one > 200, "{one} pixels of text");
    assert_eq!(none, 0, "it goes with what it is about");
    let warned = report.standard_error.matches("gone.png").count();
    assert_eq!(warned, 2, "standard error has each of them once: {report}");
}
