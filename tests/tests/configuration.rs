//! What a person prefers, in a file and in the environment, and what comes before it.

#![cfg(test)]

use oktant_tests::program::{Run, finish, oktant};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::{TempDir, tempdir};

/// A folder with a mesh, a scene that says how it is rendered, and a configuration.
fn folder(configuration: &str) -> TempDir {
    let folder = tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write(
        "triangle.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0.2\n3 0 1 2\n",
    );
    write(
        "scene.toml",
        "[render]\nsamples = 16\nwidth = 24\nheight = 18\n[[sphere]]\n",
    );
    write("config.toml", configuration);
    folder
}

/// Runs the program with variables of the environment; its configuration is the file unless they say another.
fn run(folder: &Path, variables: &[(&str, &str)], arguments: &[&str]) -> Run {
    let mut command = Command::new(oktant());
    command
        .env("OKTANT_CONFIG", "config.toml")
        .envs(variables.iter().copied());
    finish(command.args(arguments).current_dir(folder))
}

#[track_caller]
fn json_of(folder: &Path, variables: &[(&str, &str)], arguments: &[&str]) -> Value {
    let run = run(folder, variables, arguments);
    assert_eq!(run.code, Some(0), "{}", run.error);
    serde_json::from_str(&run.output).unwrap()
}

/// The samples and the size with which something is rendered.
#[track_caller]
fn rendered(folder: &Path, variables: &[(&str, &str)], source: &str, more: &[&str]) -> (Value, Value) {
    let arguments = [&["render", source, "-o", "a.png", "--json"], more].concat();
    let report = json_of(folder, variables, &arguments);
    (report["samples"].clone(), report["size"].clone())
}

#[test]
fn the_command_line_comes_first_then_environment_scene_and_file() {
    let folder = folder("samples = 4\nsize = \"20x10\"\nbackend = \"cpu\"\n");
    let ask = |variables: &[_], source, more: &[_]| rendered(folder.path(), variables, source, more);
    let variables = [("OKTANT_SAMPLES", "64"), ("OKTANT_SIZE", "8x6")];
    let flags = ["--samples=1", "--size=5x4"];
    assert_eq!(ask(&[], "triangle.ply", &[]), (json!(4), json!([20, 10])));
    assert_eq!(ask(&[], "scene.toml", &[]), (json!(16), json!([24, 18])));
    for source in ["triangle.ply", "scene.toml"] {
        assert_eq!(ask(&variables, source, &[]), (json!(64), json!([8, 6])));
        assert_eq!(ask(&variables, source, &flags), (json!(1), json!([5, 4])));
    }
    // Neither is there.
    let none = [("OKTANT_CONFIG", ""), ("OKTANT_SIZE", ""), ("OKTANT_BACKEND", "cpu")];
    assert_eq!(ask(&none, "triangle.ply", &[]), (json!(1), json!([1280, 968])));
}

#[test]
fn a_preferred_picture_is_the_one_that_options_make() {
    let preferred =
        folder("backend = \"cpu\"\nup = \"z\"\nfov = 25\nshading = \"flat\"\ntone = \"aces\"\nsize = \"32x24\"\n");
    let plain = folder("");
    let picture = |folder: &Path, more: &[&str]| {
        let arguments = [&["render", "triangle.ply", "-o", "a.png"], more].concat();
        let run = run(folder, &[], &arguments);
        assert_eq!(run.code, Some(0), "{}", run.error);
        fs::read(folder.join("a.png")).unwrap()
    };
    let options = [
        "--backend=cpu",
        "--up=z",
        "--fov=25",
        "--shading=flat",
        "--tone=aces",
        "--size=32x24",
    ];
    let wanted = picture(plain.path(), &options);
    assert!(picture(preferred.path(), &[]) == wanted);
    assert!(picture(plain.path(), &["--backend=cpu", "--size=32x24"]) != wanted);
}

/// What would be refused on the command line is only a preference.
#[test]
fn a_preference_that_does_not_go_with_a_picture_is_passed_over() {
    let folder = folder("size = \"8x6\"\nerror = 0.1\nup = \"z\"\n");
    let variables = [
        ("OKTANT_BLOCK", "2"),
        ("OKTANT_UP", "z"),
        ("OKTANT_EXPOSURE", "1"),
        ("OKTANT_TRAVERSAL", "bvh2"),
    ];
    for more in [&["--backend=cpu", "-o", "a.exr"][..], &["--reference=1", "-o", "a.png"]] {
        let run = run(folder.path(), &variables, &[&["render", "scene.toml"], more].concat());
        assert_eq!(run.code, Some(0), "{}", run.error);
    }
    // A scene says itself what is up.
    let picture = |variables: &[_]| {
        let run = run(
            folder.path(),
            variables,
            &["render", "scene.toml", "--backend=cpu", "-o", "a.png", "--samples=1"],
        );
        assert_eq!(run.code, Some(0), "{}", run.error);
        fs::read(folder.path().join("a.png")).unwrap()
    };
    assert!(picture(&[("OKTANT_UP", "z")]) == picture(&[("OKTANT_CONFIG", "")]));
}

#[test]
fn what_is_in_force_is_listed_with_where_it_is_from() {
    let folder = folder("samples = \"adaptive:16\"\ntarget-ms = 30\n");
    let listing = json_of(folder.path(), &[("OKTANT_TARGET_MS", "20")], &["config", "--json"]);
    assert_eq!(listing["path"], "config.toml");
    let setting = |name: &str| {
        let settings = listing["settings"].as_array().unwrap();
        settings.iter().find(|setting| setting["name"] == name).unwrap().clone()
    };
    let said = |value: &str, origin: &str, name: &str| {
        let variable = format!("OKTANT_{}", name.to_uppercase().replace('-', "_"));
        json!({"name": name, "value": value, "origin": origin, "variable": variable})
    };
    assert_eq!(setting("samples"), said("adaptive:16", "file", "samples"));
    assert_eq!(setting("target-ms"), said("20", "environment", "target-ms"));
    assert_eq!(setting("backend"), said("auto", "default", "backend"));
    assert_eq!(setting("fov"), said("as the scene says, else 40", "default", "fov"));
    let text = run(folder.path(), &[], &["config"]).output;
    assert!(text.starts_with("file: config.toml\n"), "{text}");
    assert!(text.contains("\nsamples    adaptive:16"), "{text}");
}

#[test]
fn the_file_lies_where_the_platform_has_it() {
    let folder = folder("");
    let path = |variables: &[_]| run(folder.path(), variables, &["config", "--path"]);
    assert_eq!(path(&[]).output, "config.toml\n");
    let none = path(&[("OKTANT_CONFIG", "")]);
    assert_eq!((none.code, none.output.as_str()), (Some(1), ""));
    assert!(none.error.contains("unset it"), "{}", none.error);
    if cfg!(target_os = "linux") {
        let place = folder.path().join("oktant");
        fs::create_dir(&place).unwrap();
        fs::write(place.join("config.toml"), "depth = 3\n").unwrap();
        let ask = |arguments: &[&str]| {
            let mut command = Command::new(oktant());
            command
                .env_remove("OKTANT_CONFIG")
                .env("XDG_CONFIG_HOME", folder.path());
            command.args(arguments).current_dir(folder.path()).output().unwrap()
        };
        let said = String::from_utf8(ask(&["config", "--path"]).stdout).unwrap();
        assert_eq!(said.trim_end(), place.join("config.toml").display().to_string());
        let listing: Value = serde_json::from_slice(&ask(&["config", "--json"]).stdout).unwrap();
        let settings = listing["settings"].as_array().unwrap();
        assert!(
            settings
                .iter()
                .any(|setting| setting["name"] == "depth" && setting["value"] == "3")
        );
    }
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    for (configuration, sentence) in [
        (
            "depth = 3\nsample = 4\n",
            "config.toml:2:1: the configuration has no field \"sample\"; did you mean \"samples\"?",
        ),
        (
            "azimuth = 4\n",
            "config.toml:1:1: the configuration has no field \"azimuth\"; ",
        ),
        (
            "samples = 3\n",
            "config.toml:1:11: samples is 3; give one of 1, 4, 16, 64, adaptive:1",
        ),
        (
            "size = \"5\"\n",
            "config.toml:1:8: size is \"5\"; give width and height in pixels, for example 1280x968",
        ),
        (
            "[render]\nsamples = 1\n",
            "config.toml:1:2: the configuration has no field \"render\"; ",
        ),
        ("samples\n", "config.toml:1:8: this is not TOML"),
    ] {
        let folder = folder(configuration);
        for arguments in [&["render", "triangle.ply", "-o", "a.png"][..], &["config"]] {
            let run = run(folder.path(), &[], arguments);
            assert_eq!(run.code, Some(1), "{}", run.error);
            assert!(run.error.starts_with(&format!("oktant: {sentence}")), "{}", run.error);
        }
        // What prefers nothing works.
        assert_eq!(run(folder.path(), &[], &["check", "scene.toml"]).code, Some(0));
        assert_eq!(run(folder.path(), &[], &["config", "--path"]).code, Some(0));
    }
    let folder = folder("");
    let missing = run(folder.path(), &[("OKTANT_CONFIG", "missing.toml")], &["info"]);
    assert_eq!(missing.code, Some(1));
    assert!(
        missing
            .error
            .contains("missing.toml: the configuration file cannot be read"),
        "{}",
        missing.error
    );
    let variable = run(
        folder.path(),
        &[("OKTANT_TONE", "film")],
        &["render", "balls", "-o", "a.png"],
    );
    assert_eq!(variable.code, Some(2));
    assert_eq!(
        variable.error,
        "oktant: OKTANT_TONE is \"film\"; give one of none, reinhard, aces.\n"
    );
    assert!(!folder.path().join("a.png").exists());
}
