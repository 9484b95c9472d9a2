//! Broken scenes, and what is said about them.

use super::{project, read_in, scenes};
use oktant::progress::silent;
use oktant::scene_file;
use oktant_tests::program::run;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// The messages are in `tests/goldens/broken-scenes.txt`. After a wanted change, write them anew with
/// `OKTANT_BLESS=1 cargo test --release --workspace --test scene_file` and read the difference.
#[test]
fn broken_scenes_are_explained() {
    let folder = project().join("tests/broken-scenes");
    let golden = project().join("tests/goldens/broken-scenes.txt");
    let mut messages = String::new();
    for scene in scenes(&folder) {
        let name = scene.file_name().unwrap().to_str().unwrap();
        let error = scene_file::read(&scene, &silent).expect_err(name).to_string();
        let message = error.replace(&format!("{}/", folder.display()), "");
        assert!(message.starts_with(&format!("{name}:")), "{message}");
        assert!(!message.contains('\n'), "one sentence: {message}");
        writeln!(messages, "{message}").unwrap();
    }
    if std::env::var_os("OKTANT_BLESS").is_some() {
        fs::create_dir_all(golden.parent().unwrap()).unwrap();
        fs::write(&golden, &messages).unwrap();
    }
    let wanted = fs::read_to_string(&golden).unwrap_or_default();
    assert_eq!(
        messages,
        wanted,
        "what is said about broken scenes is not what {} says",
        golden.display()
    );
}

/// A scene without a file has no files beside it, and no more triangles than are allowed.
#[test]
fn scenes_in_memory_touch_no_files() {
    let parse = |text: &str, most| scene_file::parse(text, Path::new("memory"), most, &silent);
    let setting = parse("[[sphere]]\n", 1 << 20).unwrap();
    assert!(setting.files.is_empty() && setting.model.mesh.triangles.len() > 1000);
    assert!(parse("[[mesh]]\nname = \"balls\"\n", 1 << 20).is_ok());
    let beside = "names a file, but a scene that is in memory has no files beside it";
    for (text, field) in [
        ("[[mesh]]\nfile = \"bunny.ply\"\n", "memory:2:8: mesh.file"),
        (
            "[[sphere]]\n[environment]\nimage = \"sky.hdr\"\n",
            "memory:3:9: environment.image",
        ),
        (
            "[[sphere]]\n[textures.wood]\nfile = \"wood.png\"\n",
            "memory:3:8: textures.wood.file",
        ),
    ] {
        let message = parse(text, 1 << 20).unwrap_err().to_string();
        assert!(message.starts_with(&format!("{field} {beside}")), "{message}");
    }
    let message = parse("[[sphere]]\n[[sphere]]\n", 2000).unwrap_err().to_string();
    assert_eq!(
        message,
        "memory:2:1: sphere makes more than 2000 triangles or vertices in all; leave something out"
    );
}

/// Whatever happens to a scene file, it is read or refused in one sentence.
#[test]
fn no_damage_to_a_scene_makes_it_panic() {
    let text = fs::read_to_string(project().join("assets/scenes/mirrors.toml")).unwrap();
    let words = [
        "-", "0", "nan", "1e300", "[", "]", "\"", "=", "{}", ".", "\n", "[[", "true", "''", "#", "é", "\0",
    ];
    let folder = tempdir().unwrap();
    let mut random = fastrand::Rng::with_seed(6);
    let mut refused = 0;
    for _ in 0..400 {
        let mut damaged = text.clone();
        for _ in 0..random.usize(1..4) {
            let at = random.usize(0..damaged.len());
            let end = at + random.usize(0..8);
            if damaged.is_char_boundary(at) && damaged.is_char_boundary(end) && end <= damaged.len() {
                damaged.replace_range(at..end, words[random.usize(0..words.len())]);
            }
        }
        if let Err(error) = read_in(&folder, &damaged) {
            refused += 1;
            let sentence = error.to_string();
            assert!(
                !sentence.contains('\n') && sentence.contains("scene.toml:"),
                "{sentence}"
            );
        }
    }
    assert!(refused > 200, "{refused}");
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = tempdir().unwrap();
    let missing = scene_file::read(&folder.path().join("missing.toml"), &silent).unwrap_err();
    assert!(missing.to_string().contains("cannot be read"), "{missing}");
    assert!(scene_file::read(folder.path(), &silent).is_err());
    let path = folder.path().join("scene.toml");
    fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
    let binary = scene_file::read(&path, &silent).unwrap_err();
    assert!(binary.to_string().contains("no text"), "{binary}");
    // The command says the same, with its exit code.
    let failed = run(folder.path(), ["check", "scene.toml"]);
    assert_eq!(failed.code, Some(1));
    assert_eq!(
        failed.error,
        "oktant: scene.toml: this is no text in UTF-8; give a scene file\n"
    );
    assert_eq!(run(folder.path(), ["check"]).code, Some(2), "a usage error");
}
