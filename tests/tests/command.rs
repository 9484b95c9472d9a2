//! The command line: what it does, and how it fails.

#![cfg(test)]

use oktant_tests::program::{Run, finish, oktant, run};
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::{TempDir, tempdir};

/// A folder for a run, with a PLY file of one triangle in it.
fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("triangle.ply"), ply(3, "3 0 1 2\n")).unwrap();
    folder
}

/// An ascii PLY file with the corners of a right triangle and faces as given.
fn ply(vertices: usize, faces: &str) -> String {
    let corners: String = ["0 0 0\n", "1 0 0\n", "0 1 0\n"][..vertices].concat();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n{corners}{faces}",
        faces.lines().count()
    )
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The run failed with this exit code, in one sentence with these words, and left nothing behind.
#[track_caller]
fn assert_failed(folder: &Path, before: &[String], run: &Run, words: &[&str]) {
    assert_eq!(run.code, Some(1), "{}", run.error);
    let sentence = run.error.trim_end();
    assert!(
        sentence.starts_with("oktant: ") && !sentence.contains('\n'),
        "{sentence}"
    );
    assert!(run.output.is_empty(), "{}", run.output);
    for word in words {
        assert!(sentence.contains(word), "{word:?} is not in {sentence:?}");
    }
    assert_eq!(names(folder), before);
}

#[test]
fn a_picture_is_rendered() {
    let folder = folder();
    for (mesh, extra, size) in [
        ("triangle.ply", "--up=z", (40, 30)),
        ("balls", "--samples=16", (33, 17)),
        ("bunny", "--shading=flat", (64, 48)),
    ] {
        let size_argument = format!("{}x{}", size.0, size.1);
        let arguments = [
            "render",
            mesh,
            "-o",
            "a.PNG",
            "--size",
            &size_argument,
            extra,
            "--backend=cpu",
        ];
        let run = run(folder.path(), arguments);
        assert_eq!(run.code, Some(0), "{}", run.error);
        assert_eq!(run.output, "");
        let expected = format!("a.PNG: {} x {} pixels", size.0, size.1);
        assert!(run.error.starts_with(&expected), "{}", run.error);
        assert!(
            !run.error.contains(['\x1b', '\r']),
            "no progress, no colours: {:?}",
            run.error
        );
        let picture = image::open(folder.path().join("a.PNG")).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), size);
        let colors: std::collections::HashSet<_> = picture.pixels().collect();
        assert!(colors.len() > 1, "{mesh} is in the picture");
    }
    assert_eq!(names(folder.path()), ["a.PNG", "triangle.ply"]);
}

#[test]
fn wrong_arguments_are_refused_with_code_2() {
    let folder = folder();
    for arguments in [
        &["render", "bunny"][..],
        &["render", "bunny", "-o", "a.jpg"],
        &["render", "bunny", "-o", "a"],
        &["render", "bunny", "-o", "a.png", "--size", "0x5"],
        &["render", "bunny", "-o", "a.png", "--size", "5"],
        &["render", "bunny", "-o", "a.png", "--size", "99999x99999"],
        &["render", "bunny", "-o", "a.png", "--samples", "3"],
        &["render", "bunny", "-o", "a.png", "--shading", "gouraud"],
        &["render", "bunny", "-o", "a.png", "--backend", "cuda"],
        &["render", "bunny", "-o", "a.png", "--elevation", "91"],
        &["render", "bunny", "-o", "a.png", "--azimuth", "NaN"],
        &["render", "bunny", "-o", "a.png", "--distance", "0"],
        &["render", "bunny", "-o", "a.png", "--fov", "180"],
        &["render", "bunny", "-o", "a.png", "--up", "x"],
        &["render", "bunny", "-o", "a.png", "--octree", "depth=99"],
        &["info", "balls", "--traversal", "octree", "--octree", "leaf=4,leaf=5"],
        &["info", "balls", "--traversal", "grid", "--grid", "budget=4,budget=4"],
        &["render", "bunny", "a.toml", "-o", "a.png"],
        &["draw", "bunny"],
        &["--fast"],
        &["info", "--size", "1x1"],
        &["completions", "tcsh"],
    ] {
        let run = run(folder.path(), arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.error);
        assert!(!run.error.trim().is_empty() && run.output.is_empty(), "{arguments:?}");
        assert!(!run.error.contains("panicked"), "{}", run.error);
    }
    assert_eq!(names(folder.path()), ["triangle.ply"]);
}

#[test]
fn a_view_file_that_is_none_is_told_before_anything_is_loaded() {
    let folder = folder();
    fs::write(folder.path().join("v.toml"), "[camera]\nfov = 200\n").unwrap();
    for (file, words) in [
        (
            "v.toml",
            "v.toml:2:7: camera.fov is 200; give a number of degrees from 1 to 170",
        ),
        ("missing.toml", "missing.toml: the view file cannot be read"),
    ] {
        for command in [&["render", "no-such.ply", "-o", "a.png"][..], &["view", "no-such.ply"]] {
            let run = run(folder.path(), [command, &["--view", file]].concat());
            assert_eq!(run.code, Some(1), "{command:?}: {}", run.error);
            assert!(run.error.contains(words), "{words:?} is not in {:?}", run.error);
        }
    }
}

#[test]
fn what_the_environment_wants_told_is_told_unless_an_option_says_how_much() {
    let folder = folder();
    let told = |variable: &str, more: &[&str]| {
        let mut command = Command::new(oktant());
        command
            .env("RUST_LOG", variable)
            .args(more)
            .args(["info", "triangle.ply"]);
        let run = finish(command.current_dir(folder.path()));
        assert_eq!(run.code, Some(0), "{}", run.error);
        run.error
    };
    let is_told = |variable: &str, more: &[&str]| told(variable, more).contains(" INFO ");
    assert!(!is_told("warn", &[]));
    assert!(is_told("oktant=info", &[]), "{}", told("oktant=info", &[]));
    assert!(!is_told("oktant=info", &["--quiet"]));
    assert!(is_told("warn", &["-v"]));
}

#[test]
fn options_that_a_scene_gives_no_meaning_are_refused_with_code_2() {
    let folder = folder();
    fs::write(folder.path().join("a.toml"), "[[sphere]]\n").unwrap();
    fs::write(folder.path().join("b.toml"), "[stereo]\n[[sphere]]\n").unwrap();
    for (source, options, words) in [
        ("a.toml", &["--up", "z"][..], "scene file"),
        ("a.toml", &["--eye-distance", "0.1"], "--stereo"),
        ("b.toml", &["--stereo", "none", "--convergence", "2"], "--stereo"),
        ("b.toml", &["--size", "9x8"], "10x8"),
        ("balls", &["--convergence", "2"], "--stereo"),
        ("b.toml", &["--projection", "orthographic"], "--stereo none"),
        (
            "balls",
            &["--projection", "orthographic", "--stereo", "rows"],
            "--projection perspective",
        ),
        ("balls", &["--ortho-height", "2"], "--projection orthographic"),
        ("balls", &["--target=1,2"], "three numbers"),
        ("balls", &["--distance", "-1"], "0.001 to 100000"),
    ] {
        let arguments = [&["render", source, "-o", "a.png", "--backend", "cpu"], options].concat();
        let run = run(folder.path(), &arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.error);
        assert!(run.error.contains(words), "{words:?} is not in {:?}", run.error);
    }
    assert_eq!(names(folder.path()), ["a.toml", "b.toml", "triangle.ply"]);
    let one_eye = [
        "render",
        "b.toml",
        "-o",
        "a.png",
        "--size",
        "9x8",
        "--stereo",
        "none",
        "--backend",
        "cpu",
    ];
    let run = run(folder.path(), one_eye);
    assert_eq!(run.code, Some(0), "{}", run.error);
}

#[test]
fn limits_of_a_structure_that_is_not_built_are_refused_with_code_2() {
    let folder = folder();
    for command in [
        &["info"][..],
        &["render", "-o", "a.png", "--backend", "cpu"],
        &["trace", "--ray", "0,0,5,0,0,-1"],
    ] {
        for (options, words) in [
            (&["--octree", "leaf=4"][..], "add --traversal octree"),
            (
                &["--traversal", "grid", "--octree", "depth=3"],
                "add --traversal octree",
            ),
            (&["--grid", "density=2"], "add --traversal grid"),
            (&["--traversal", "octree", "--grid", "budget=3"], "add --traversal grid"),
        ] {
            let arguments = [command, &["balls"], options].concat();
            let refused = run(folder.path(), &arguments);
            assert_eq!(refused.code, Some(2), "{arguments:?}: {}", refused.error);
            assert!(refused.error.contains(words), "{words:?} is not in {:?}", refused.error);
        }
    }
    assert_eq!(names(folder.path()), ["triangle.ply"]);
    for (traversal, limits) in [("octree", "--octree=leaf=4"), ("grid", "--grid=density=2")] {
        let told = run(folder.path(), ["info", "balls", "--traversal", traversal, limits]);
        assert_eq!(told.code, Some(0), "{}", told.error);
        // Also where it is preferred.
        let mut command = Command::new(oktant());
        command
            .env("OKTANT_TRAVERSAL", traversal)
            .args(["info", "balls", limits]);
        let told = finish(command.current_dir(folder.path()));
        assert_eq!(told.code, Some(0), "{}", told.error);
    }
}

#[test]
fn variants_that_do_not_suffice_are_refused_with_what_would_do() {
    let folder = folder();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes");
    for (scene, options, words) in [
        ("glass.toml", &["--variant", "opaque"][..], "or give everything.\n"),
        (
            "bumps.toml",
            &["--variant", "opaque"],
            "or give mirrors or a greater one.\n",
        ),
        (
            "glass.toml",
            &["--variant", "everything", "--traversal", "compact"],
            "--variant is for the default parts: leave it out",
        ),
    ] {
        let file = scenes.join(scene);
        let start = [
            "render",
            file.to_str().unwrap(),
            "-o",
            "a.png",
            "--size",
            "8x6",
            "--backend",
            "cpu",
        ];
        let refused = run(folder.path(), [&start[..], options].concat());
        assert_eq!(refused.code, Some(2), "{scene}: {}", refused.error);
        assert!(refused.error.contains(words), "{words:?} is not in {:?}", refused.error);
    }
}

#[test]
fn all_files_are_checked() {
    let folder = folder();
    fs::write(folder.path().join("a.ply"), "").unwrap();
    let checked = run(folder.path(), ["check", "a.ply", "triangle.ply", "b.toml"]);
    assert_eq!(checked.code, Some(1), "{}", checked.error);
    assert!(
        checked.output.starts_with("triangle.ply: 1 triangle, "),
        "{}",
        checked.output
    );
    assert_eq!(checked.output.lines().count(), 1, "{}", checked.output);
    let sentences: Vec<_> = checked.error.lines().collect();
    let [first, second] = sentences[..] else {
        panic!("{}", checked.error);
    };
    assert!(first.starts_with("oktant: a.ply: the file is empty"), "{first}");
    assert!(second.starts_with("oktant: b.toml"), "{second}");
    assert_eq!(run(folder.path(), ["check"]).code, Some(2));
}

#[test]
fn a_scene_without_areas_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("points.ply"), ply(3, "3 0 0 0\n")).unwrap();
    fs::write(folder.path().join("a.toml"), "[[mesh]]\nfile = 'points.ply'\n").unwrap();
    let before = names(folder.path());
    for arguments in [&["render", "a.toml", "-o", "a.png"][..], &["check", "a.toml"]] {
        let failed = run(folder.path(), arguments);
        assert_failed(folder.path(), &before, &failed, &["a.toml", "no triangle of the scene"]);
    }
}

#[test]
fn meshes_that_cannot_be_rendered_are_refused_with_code_1() {
    let folder = folder();
    let write = |name: &str, content: &str| fs::write(folder.path().join(name), content).unwrap();
    write("empty.ply", "");
    write("no_faces.ply", &ply(3, ""));
    write("no_vertices.ply", &ply(0, ""));
    write("points.ply", &ply(3, "3 0 0 0\n3 1 1 2\n"));
    write("outside.ply", &ply(3, "3 0 1 3\n"));
    write("text.ply", "Dear reader,\n");
    fs::create_dir(folder.path().join("folder.ply")).unwrap();
    let before = names(folder.path());
    for (mesh, words) in [
        ("missing.ply", &["missing.ply", "no such file"][..]),
        ("folder.ply", &["directory"]),
        ("triangle.ply/a.ply", &["triangle.ply/a.ply"]),
        ("empty.ply", &["empty"]),
        ("no_faces.ply", &["no faces"]),
        ("no_vertices.ply", &["no_vertices.ply"]),
        ("points.ply", &["area"]),
        ("outside.ply", &["vertex 3"]),
        ("text.ply", &["not a PLY file"]),
        ("bunyn", &["bunyn"]),
    ] {
        let rendered = run(folder.path(), ["render", mesh, "-o", "a.png", "--size", "8x8"]);
        assert_failed(folder.path(), &before, &rendered, words);
        let told = run(folder.path(), ["info", mesh]);
        assert_failed(folder.path(), &before, &told, words);
    }
}

#[test]
fn files_that_cannot_be_written_are_refused_with_code_1() {
    let folder = folder();
    fs::create_dir(folder.path().join("b.png")).unwrap();
    let before = names(folder.path());
    for (output, words) in [
        ("nowhere/a.png", &["nowhere", "does not exist"][..]),
        ("triangle.ply/a.png", &["triangle.ply"]),
        ("b.png", &["b.png is not a file"]),
        #[cfg(target_os = "linux")]
        ("/proc/a.png", &["/proc/a.png cannot be written"]),
        #[cfg(target_os = "linux")]
        ("/dev/null/a.png", &["/dev/null"]),
    ] {
        let run = run(folder.path(), ["render", "balls", "-o", output, "--size", "8x8"]);
        assert_failed(folder.path(), &before, &run, words);
    }
}

/// A limit to the size of files makes the system refuse to write on, as a full disk does.
#[cfg(unix)]
#[test]
fn a_picture_that_does_not_fit_leaves_the_old_one() {
    let folder = folder();
    fs::write(folder.path().join("a.png"), "the old one").unwrap();
    let before = names(folder.path());
    let script = r#"trap '' XFSZ; ulimit -f 16; exec "$0" render bunny -o a.png --backend cpu --size 640x480"#;
    let mut command = Command::new("sh");
    command.arg("-c").arg(script).arg(oktant()).current_dir(folder.path());
    let run = finish(&mut command);
    assert_failed(folder.path(), &before, &run, &["a.png cannot be written"]);
    assert_eq!(fs::read_to_string(folder.path().join("a.png")).unwrap(), "the old one");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_told() {
    let folder = folder();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = Command::new(oktant())
        .args(["completions", "bash"])
        .stdout(full)
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(
        error.starts_with("oktant: Standard output cannot be written"),
        "{error}"
    );
}

/// Oracle: the scene file that says the same.
#[test]
fn what_is_set_is_as_if_the_scene_said_it() {
    let folder = folder();
    let scene = |name: &str, mirror: &str, color: &str, around: &str| {
        let text = format!(
            "[materials.silver]\nbase = 0.5\nmirror = {mirror}\ndiffuse = 0.85\nambient = 1\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n\
             material = 'silver'\n[[light]]\nposition = [1, 2, 3]\ncolor = {color}\n[environment]\ncolor = {around}\n"
        );
        fs::write(folder.path().join(name), text).unwrap();
    };
    scene("plain.toml", "0", "1", "[0.2, 0.3, 0.4]");
    scene("changed.toml", "0.5", "[1, 0, 0]", "0.25");
    let set = [
        "material silver mirror 0.5",
        "add light",
        "light 0 color 1,0,0",
        "remove light 1",
        "environment color 0.25",
    ]
    .map(|setting| ["--set", setting]);
    for how in [&["--backend", "cpu"][..], &["--reference"]] {
        let render = |scene: &str, set: &[&str]| {
            let start = ["render", scene, "--size", "40x30", "-o", "out.png"];
            let rendered = run(folder.path(), [&start, how, set].concat());
            assert_eq!(rendered.code, Some(0), "{}", rendered.error);
            fs::read(folder.path().join("out.png")).unwrap()
        };
        let wanted = render("changed.toml", &[]);
        assert!(wanted != render("plain.toml", &[]));
        assert!(wanted == render("plain.toml", set.as_flattened()), "{how:?}");
    }
    for (setting, words) in [
        ("light 7 range 2", "there is no light 7"),
        ("material slver mirror 1", "did you mean \"silver\""),
        ("samples 4", "--samples 4"),
        ("lihgt 0 range 2", "did you mean \"light\""),
    ] {
        let refused = run(
            folder.path(),
            ["render", "plain.toml", "-o", "none.png", "--set", setting],
        );
        assert_eq!(refused.code, Some(2), "{}", refused.error);
        assert!(refused.error.contains(words), "{setting}: {}", refused.error);
        assert!(!folder.path().join("none.png").exists());
    }
}

#[test]
fn info_has_the_figures() {
    let folder = folder();
    let run = run(folder.path(), ["info", "bunny"]);
    assert_eq!(run.code, Some(0), "{}", run.error);
    for word in [
        "69451 (0 without area",
        "box ",
        "structure    octants, ",
        "nodes ",
        "per triangle",
        "leaves ",
        "bytes ",
        "arrays       bytes per triangle: nodes 13.7, references 0.0",
        "triangles 48.0, ids 4.0, normals 8.0, colours 0.0, coordinates 0.0",
        "ms to build",
        "entry points",
        "adapter ",
    ] {
        assert!(run.output.contains(word), "{word:?} is not in\n{}", run.output);
    }
}

#[test]
fn info_says_what_a_scene_has_and_what_renders_it() {
    let folder = folder();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes");
    let told = |arguments: &[&str]| {
        let run = run(folder.path(), [&["info"], arguments].concat());
        assert_eq!(run.code, Some(0), "{}", run.error);
        ["needs", "variant"].map(|name| {
            let mut lines = run.output.lines().filter_map(|line| line.strip_prefix(name));
            lines.next().expect("a line").trim().to_owned()
        })
    };
    let all = "of plain, opaque, mirrors and everything";
    for (scene, needs, variant) in [
        (
            "bunny.toml",
            "shadows of 1 light, 1 material, smooth normals, 4 samples a pixel",
            "plain",
        ),
        (
            "cornell.toml",
            "shadows of 2 lights (1 with an area), 4 materials, flat normals, 4 samples a pixel",
            "opaque",
        ),
        (
            "bumps.toml",
            "shadows of 1 light, 3 materials, 1 plane, textures, bumps, mirrors, smooth normals, 4 samples a pixel",
            "mirrors",
        ),
        (
            "glass.toml",
            "shadows of 2 lights, 5 materials, glass, smooth normals, 4 samples a pixel",
            "everything",
        ),
    ] {
        let file = scenes.join(scene);
        let wanted = [needs.to_owned(), format!("{variant}, {all}")];
        assert_eq!(told(&[file.to_str().unwrap()]), wanted, "{scene}");
    }
    // What is said of the same mesh does not depend on what traces rays through it.
    let general = "everything, in the general kernel that other parts than the default ones have";
    let needs = "shadows of 1 light, 1 material, flat normals, 1 sample a pixel";
    for (parts, variant) in [
        (&["--traversal", "octants"][..], format!("plain, {all}")),
        (&["--traversal", "octree"], general.into()),
        (&["--triangle", "plucker"], general.into()),
        (
            &["--traversal", "compact"],
            format!("on the CPU plain, {all}; on a GPU {general}"),
        ),
    ] {
        let told = told(&[&["triangle.ply"], parts].concat());
        assert_eq!(told, [needs.to_owned(), variant], "{parts:?}");
    }
}

#[test]
fn help_version_and_completions_are_printed() {
    let folder = folder();
    let version = run(folder.path(), ["--version"]);
    assert_eq!(version.output.trim(), concat!("oktant ", env!("CARGO_PKG_VERSION")));
    for arguments in [
        &["--help"][..],
        &["help", "render"],
        &["view", "--help"],
        &["info", "-h"],
    ] {
        let help = run(folder.path(), arguments);
        assert_eq!(help.code, Some(0));
        assert!(help.output.contains("Usage: oktant"), "{}", help.output);
    }
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let completions = run(folder.path(), ["completions", shell]);
        assert_eq!(completions.code, Some(0));
        assert!(completions.output.contains("light-azimuth"), "{shell}");
    }
}

#[test]
fn manual_pages_are_printed_and_written() {
    let folder = folder();
    let of_program = run(folder.path(), ["man"]);
    assert_eq!(of_program.code, Some(0));
    assert!(of_program.output.contains(".TH oktant 1"), "{}", of_program.output);
    let of_render = run(folder.path(), ["man", "render"]);
    assert!(
        of_render.output.contains("\\-\\-light\\-azimuth"),
        "{}",
        of_render.output
    );
    fs::create_dir(folder.path().join("man1")).unwrap();
    let written = run(folder.path(), ["man", "-o", "man1"]);
    assert_eq!(written.code, Some(0), "{}", written.error);
    let page = |name: &str| fs::read_to_string(folder.path().join("man1").join(name)).unwrap();
    assert_eq!(page("oktant.1"), of_program.output);
    assert_eq!(page("oktant-render.1"), of_render.output);
    let names = names(&folder.path().join("man1"));
    assert_eq!(written.error, format!("man1: {} pages\n", names.len()));
    assert!(names.iter().all(|name| name.ends_with(".1")), "{names:?}");
    let unknown = run(folder.path(), ["man", "draw"]);
    assert_eq!(unknown.code, Some(2));
    assert!(unknown.error.contains("render"), "{}", unknown.error);
    let missing = run(folder.path(), ["man", "-o", "missing"]);
    assert_eq!(missing.code, Some(1));
    assert!(
        missing.error.contains("The folder missing does not exist"),
        "{}",
        missing.error
    );
}

#[test]
fn how_much_is_told_can_be_said() {
    let folder = folder();
    let render = ["render", "triangle.ply", "--backend=cpu", "--size=8x6", "-o", "a.png"];
    let told = |more: &[&str]| run(folder.path(), [&render[..], more].concat()).error;
    assert_eq!(told(&[]).lines().count(), 1, "{}", told(&[]));
    assert!(told(&["-v"]).contains("INFO read in "), "{}", told(&["-v"]));
    let surplus = ply(3, "3 0 1 2\n") + "and more\n";
    fs::write(folder.path().join("surplus.ply"), surplus).unwrap();
    let warned = |more: &[&str]| run(folder.path(), [more, &["check", "surplus.ply"]].concat()).error;
    assert!(
        warned(&[]).contains("after the last element are ignored"),
        "{}",
        warned(&[])
    );
    assert_eq!(warned(&["--quiet"]), "");
    assert_eq!(run(folder.path(), ["-q", "-v", "info", "balls"]).code, Some(2));
}
