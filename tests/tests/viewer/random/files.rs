//! What is dropped on the window.

use crate::window::Session;

/// What is looked at first, and wherever memory is looked at.
pub const FIRST: &str = "first.toml";
/// What is looked at last.
pub const LAST: &str = "last.toml";

/// A name of three words.
const WITH_BLANKS: &str = "a name with blanks \u{e4}\u{f6}\u{fc}.ply";

/// Small files that can be opened.
pub const SMALL: [&str; 5] = [FIRST, LAST, "square.ply", WITH_BLANKS, "corner.obj"];

/// Those of them that can be looked at together.
pub const MESHES: [&str; 3] = ["square.ply", WITH_BLANKS, "corner.obj"];

/// Larger ones, scenes of the project.
pub const LARGE: [&str; 7] = [
    "balls.toml",
    "bumps.toml",
    "bunny.toml",
    "cornell.toml",
    "glass.toml",
    "mirrors.toml",
    "stadium.toml",
];

/// What cannot be opened.
pub const BAD: [&str; 11] = [
    "missing.ply",
    "missing.toml",
    "cut.ply",
    "flat.ply",
    "noise.glb",
    "noise.stl",
    "nothing.obj",
    "words.toml",
    "lacking.toml",
    "folder",
    "picture.png",
];

/// Two triangles.
const SQUARE: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 2\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 2 1 3\n";

/// The scene that is looked at last, without what can be set.
pub fn last_scene() -> String {
    "[camera]\nposition = [0.0, 1.0, 5.0]\nlook_at = [0.0, 0.0, 0.0]\n\
     [[sphere]]\ncenter = [-1.0, 0.0, 0.0]\ntriangles = 200\nmaterial = \"m0\"\n\
     [[sphere]]\ncenter = [1.0, 0.0, -0.5]\ntriangles = 100\nmaterial = \"m1\"\n\
     [[plane]]\npoint = [0.0, -1.0, 0.0]\nnormal = [0.0, 1.0, 0.0]\nmaterial = \"m2\"\n"
        .into()
}

/// Writes all of them into the session's folder.
pub fn write(session: &Session) {
    session.write(FIRST, "[[sphere]]\ntriangles = 500\n[[light]]\nposition = [3, 4, 5]\n");
    let materials = "[materials.m0]\nmirror = 0.4\n[materials.m1]\ntransmission = 0.8\n[materials.m2]\nbase = 0.5\n";
    let lights = "[[light]]\nposition = [3, 4, 5]\n[[light]]\nposition = [-4, 3, 2]\ncolor = [1, 0.5, 0.25]\n";
    session.write(LAST, &(last_scene() + materials + lights));
    session.write("square.ply", SQUARE);
    session.write(WITH_BLANKS, &SQUARE.replace("0 0\n", "0 2\n"));
    session.write("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
    session.write("cut.ply", &SQUARE[..120]);
    session.write("flat.ply", &SQUARE.replace("0 1 0\n1 1 0\n", "2 0 0\n3 0 0\n"));
    session.write("noise.glb", "glTF\u{2}\0\0\0\u{7f}\0\0\0 no glTF follows");
    session.write("noise.stl", "solid no facets");
    session.write("nothing.obj", "");
    session.write("words.toml", "this is no scene");
    session.write("lacking.toml", "[[mesh]]\nfile = \"missing.ply\"\n");
    session.write("picture.png", "no picture either");
    let folder = session.folder();
    std::fs::create_dir(folder.join("folder")).expect("a folder can be made");
    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes");
    for name in LARGE {
        std::fs::copy(scenes.join(name), folder.join(name)).expect("the scene is there");
    }
}
