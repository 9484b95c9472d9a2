//! Mesh files on the command line and in scene files.

use super::glb::Glb;
use super::stl::{binary, text};
use glam::{Vec3, vec3};
use oktant::progress::silent;
use oktant::source::Source;
use oktant::view::View;
use oktant_tests::program::run;
use serde_json::json;
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";

/// A folder with a file of each format in it, the glTF one with a material, a light and a camera.
fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut glb = Glb::floor()
        .material(json!({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1.0], "metallicFactor": 0.0}}))
        .light(
            json!({"type": "point", "intensity": 20}),
            json!({"translation": [0, 2, 0]}),
        )
        .node(json!({"camera": 0, "translation": [0, 1, 4]}));
    glb.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}]);
    fs::write(at("floor.glb"), glb.bytes()).unwrap();
    fs::write(at("triangle.OBJ"), format!("mtllib a.mtl\n{TRIANGLE}")).unwrap();
    fs::write(at("a.mtl"), "newmtl red\nKd 1 0 0\n").unwrap();
    fs::write(at("text.stl"), text(["0 0 0", "1 0 0", "0 1 0"])).unwrap();
    fs::write(
        at("binary.stl"),
        binary("", &[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]),
    )
    .unwrap();
    folder
}

const FILES: [&str; 4] = ["floor.glb", "triangle.OBJ", "text.stl", "binary.stl"];

/// Every command that takes a mesh.
#[test]
fn commands_take_files_of_all_formats() {
    let folder = folder();
    for file in FILES {
        for arguments in [
            &["check", file][..],
            &["info", file],
            &["render", file, "--backend", "cpu", "--size", "32x24", "-o", "out.png"],
            &["trace", file, "--ray", "0.1,0.1,5,0,0,-1"],
            &[
                "bench",
                file,
                "--tables",
                "parts",
                "--size",
                "16x12",
                "--repeat",
                "1",
                "--backend",
                "cpu",
                "--traversal",
                "octants",
            ],
        ] {
            let run = run(folder.path(), arguments);
            assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.error);
        }
        let picture = image::open(folder.path().join("out.png")).unwrap().to_rgb8();
        let first = picture.get_pixel(0, 0);
        assert!(picture.pixels().any(|pixel| pixel != first), "{file} is in the picture");
    }
    let check = run(folder.path(), ["check", "floor.glb", "triangle.OBJ"]);
    assert_eq!(
        check.output,
        "floor.glb: 2 triangles, 0 planes, 1 material, 1 light, 0 textures: ok\n\
         triangle.OBJ: 1 triangle, 0 planes, 1 material, 1 light, 0 textures: ok\n"
    );
}

#[test]
fn broken_files_are_refused_with_code_1() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("broken.glb"), &fs::read(at("floor.glb")).unwrap()[..100]).unwrap();
    fs::write(at("broken.obj"), "f 1 2 3\n").unwrap();
    fs::write(at("broken.stl"), "solid\nfacet\n").unwrap();
    fs::create_dir(at("folder.gltf")).unwrap();
    fs::create_dir(at("folder")).unwrap();
    for (file, words) in [
        ("broken.glb", "cut short"),
        ("broken.obj", "line 1"),
        ("broken.stl", "line 2"),
        ("missing.obj", "no such file"),
        ("missing.gltf", "no such file"),
        ("folder.gltf", "directory"),
        (
            "a.mtl",
            "a name that ends as its format says (.ply, .obj, .stl, .glb, .gltf)",
        ),
        ("folder", "a mesh (PLY, OBJ, STL or glTF) or a scene file (.toml)"),
    ] {
        let run = run(folder.path(), ["render", file, "-o", "broken.png"]);
        assert_eq!(run.code, Some(1), "{}", run.error);
        let sentence = run.error.trim_end();
        assert!(
            sentence.starts_with(&format!("oktant: {file}: ")) && sentence.contains(words),
            "{sentence}"
        );
        assert!(!sentence.contains('\n'), "{sentence}");
        assert!(!at("broken.png").exists());
    }
    let up = run(folder.path(), ["render", "floor.glb", "-o", "up.png", "--up", "z"]);
    assert_eq!(up.code, Some(2), "{}", up.error);
}

#[test]
fn materials_that_are_not_described_are_warned_of_once() {
    let folder = folder();
    let check = || run(folder.path(), ["check", "triangle.OBJ"]);
    let told = check();
    assert_eq!((told.code, told.error.as_str()), (Some(0), ""));
    let faces = ["blue", "red", "green", "blue"].map(|name| format!("usemtl {name}\nf 1 2 3\n"));
    let text = format!("mtllib a.mtl\n{TRIANGLE}{}", faces.concat());
    fs::write(folder.path().join("triangle.OBJ"), text).unwrap();
    let warned = check();
    assert_eq!(
        (warned.code, warned.error.lines().count()),
        (Some(0), 1),
        "{}",
        warned.error
    );
    let words = "triangle.OBJ: no MTL file describes the material \"blue\", so its faces are of clay";
    assert!(warned.error.contains(words), "{}", warned.error);
    // Of a file that is not there, that alone is said.
    fs::remove_file(folder.path().join("a.mtl")).unwrap();
    let warned = check();
    assert_eq!(warned.error.lines().count(), 1, "{}", warned.error);
    assert!(
        warned.error.contains("a.mtl: there is no such file"),
        "{}",
        warned.error
    );
}

#[test]
fn a_format_is_told_by_content_first() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::rename(at("floor.glb"), at("floor.obj")).unwrap();
    let setting = Source::from_path(at("floor.obj")).load(&silent).unwrap();
    assert_eq!(setting.model.mesh.triangles.len(), 2);
}

#[test]
fn a_whole_gltf_file_is_a_scene() {
    let folder = folder();
    let setting = Source::from_path(folder.path().join("floor.glb"))
        .load(&silent)
        .unwrap();
    let model = &setting.model;
    assert_eq!(model.materials[0].base, vec3(0.5, 0.25, 0.125));
    assert_eq!((model.lights.len(), model.lights[0].position), (1, vec3(0.0, 2.0, 0.0)));
    let focus = model.focus.unwrap();
    assert!((setting.view.field_of_view - 0.7_f32.to_degrees()).abs() < 1e-4);
    assert!(
        focus.center.distance(vec3(0.0, 1.0, 0.0)) < 1e-6,
        "as far ahead as the middle of all"
    );
    assert_eq!(setting.files, [folder.path().join("floor.glb")]);
    // Without a camera it is seen as any mesh is.
    fs::write(folder.path().join("bare.glb"), Glb::floor().bytes()).unwrap();
    let bare = Source::from_path(folder.path().join("bare.glb")).load(&silent).unwrap();
    assert_eq!((bare.view, bare.model.focus), (View::default(), None));
    assert_eq!(bare.model.lights, [oktant::model::white_light()]);
}

/// A scene file with these meshes.
fn scene(folder: &Path, text: &str) -> oktant::source::Setting {
    let path = folder.join("scene.toml");
    fs::write(&path, text).unwrap();
    Source::from_path(path)
        .load(&silent)
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn scene_files_take_meshes_with_their_materials() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    image::RgbImage::from_pixel(1, 1, image::Rgb([9, 9, 9]))
        .save(at("grey.png"))
        .unwrap();
    fs::write(at("a.mtl"), "newmtl red\nKd 1 0 0\nmap_Kd grey.png\n").unwrap();
    let setting = scene(
        folder.path(),
        "[textures.board]\nkind = \"checkerboard\"\n[materials.blue]\nbase = [0, 0, 1]\n\
         [materials.tiles]\ntexture = \"board\"\n[[quad]]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\nmaterial = \"tiles\"\n\
         [[mesh]]\nfile = \"floor.glb\"\ntranslate = [5, 0, 0]\n[[mesh]]\nfile = \"triangle.OBJ\"\n\
         [[mesh]]\nfile = \"triangle.OBJ\"\ntranslate = [0, 0, 1]\n[[mesh]]\nfile = \"text.stl\"\nmaterial = \"blue\"\n\
         [[mesh]]\nfile = \"floor.glb\"\nmaterial = \"blue\"\n",
    );
    let model = &setting.model;
    let bases: Vec<Vec3> = model
        .material_ids
        .iter()
        .map(|id| model.materials[*id as usize].base)
        .collect();
    let (floor, red, blue) = (vec3(0.5, 0.25, 0.125), Vec3::X, Vec3::Z);
    assert_eq!(bases, [floor, floor, red, red, blue, blue, blue, Vec3::ONE, Vec3::ONE]);
    assert_eq!(model.materials.len(), 4, "two copies have the same material");
    let textures: Vec<_> = model.materials.iter().map(|material| material.texture).collect();
    assert_eq!(model.textures.len(), 2);
    assert!(textures.contains(&0) && textures.contains(&1), "{textures:?}");
    assert_eq!(model.lights.len(), 1, "a scene file says itself what shines");
    for file in [
        "floor.glb",
        "triangle.OBJ",
        "a.mtl",
        "grey.png",
        "text.stl",
        "scene.toml",
    ] {
        assert!(setting.files.contains(&at(file)), "{file} is followed");
    }
    oktant::scene::Scene::of_model(setting.model, &oktant::structure::StructureOptions::default(), &silent).unwrap();
}
