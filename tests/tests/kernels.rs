//! Parts that can be exchanged, from the command line, and kernels from files.

#![cfg(test)]

use oktant_shared::bindings::BINDINGS;
use oktant_shared::parts::{BoxKind, Parts, TraversalKind, TriangleKind};
use oktant_tests::program::{Run, run};
use oktant_tests::spirv::CompiledKernel;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

#[test]
fn all_parts_and_combinations_are_listed() {
    let folder = tempdir().unwrap();
    let text = run(folder.path(), ["kernels"]);
    let json = run(folder.path(), ["kernels", "--json"]);
    assert_eq!(
        (text.code, json.code),
        (Some(0), Some(0)),
        "{}{}",
        text.error,
        json.error
    );
    let json: serde_json::Value = serde_json::from_str(&json.output).unwrap();
    let described = TraversalKind::ALL.iter().map(|kind| ("traversals", kind.description()));
    let described = described.chain(
        TriangleKind::ALL
            .iter()
            .map(|kind| ("triangle_tests", kind.description())),
    );
    let described = described.chain(BoxKind::ALL.iter().map(|kind| ("box_tests", kind.description())));
    for (list, part) in described {
        let line = text
            .output
            .lines()
            .find(|line| line.starts_with(&format!("{} ", part.name)));
        let line = line.unwrap_or_else(|| panic!("{} is not listed:\n{}", part.name, text.output));
        let watertight = if part.is_watertight { " yes " } else { " no " };
        for word in [part.paper, part.cost, watertight] {
            assert!(line.contains(word), "{word:?} is not in {line:?}");
        }
        let found = json[list]
            .as_array()
            .unwrap()
            .iter()
            .find(|of| of["name"] == part.name)
            .unwrap();
        assert_eq!(found["paper"], part.paper);
        assert_eq!(found["watertight"], part.is_watertight);
    }
    let combinations = json["combinations"].as_array().unwrap();
    assert_eq!(combinations.len(), Parts::OFFERED.len());
    for (parts, listed) in Parts::OFFERED.iter().zip(combinations) {
        assert_eq!(listed["triangle"], parts.triangle.description().name);
        assert_eq!(listed["is_default"], *parts == Parts::default());
        assert_eq!(listed["backends"], serde_json::json!(["cpu", "gpu"]), "{parts}");
        let (closest, any) = parts.entry_points().unwrap();
        assert!(text.output.contains(&format!("{closest} {any}\n")), "{parts}");
    }
}

#[test]
fn combinations_are_rendered_or_refused_with_what_would_do() {
    let folder = tempdir().unwrap();
    for traversal in TraversalKind::ALL {
        for triangle in TriangleKind::ALL {
            for box_test in BoxKind::ALL {
                let parts = Parts {
                    traversal: *traversal,
                    triangle: *triangle,
                    box_test: *box_test,
                };
                let chosen = parts.to_string();
                let arguments = ["render", "balls", "-o", "a.png", "--size=16x12", "--backend=cpu"];
                let run = run(folder.path(), arguments.into_iter().chain(chosen.split(' ')));
                if Parts::OFFERED.contains(&parts) {
                    assert_eq!(run.code, Some(0), "{parts}: {}", run.error);
                    continue;
                }
                assert_refused(&run, 2, &[&format!("--traversal {traversal}")]);
                // Whatever it says to give is offered.
                match run.error.split_once("; give ") {
                    Some((_, advice)) => {
                        for choice in advice.trim_end().trim_end_matches('.').split(", or ") {
                            let offered = Parts::OFFERED.iter().any(|parts| {
                                parts.traversal == *traversal
                                    && format!("--triangle {} --box {}", parts.triangle, parts.box_test)
                                        .starts_with(choice)
                            });
                            assert!(offered, "{choice:?} of {}", run.error);
                        }
                    }
                    None => assert!(run.error.contains("does nothing"), "{}", run.error),
                }
            }
        }
    }
}

/// The run failed with this exit code, in one sentence with these words, and wrote nothing.
#[track_caller]
fn assert_refused(run: &Run, code: i32, words: &[&str]) {
    assert_eq!(run.code, Some(code), "{}", run.error);
    let sentence = run.error.trim_end();
    assert!(
        sentence.starts_with("oktant: ") && sentence.ends_with('.') && !sentence.contains('\n'),
        "{sentence}"
    );
    for word in words {
        assert!(sentence.contains(word), "{word:?} is not in {sentence:?}");
    }
}

/// Renders with the kernel `oktant.spv` of a folder.
fn render(folder: &Path, more: &[&str]) -> Run {
    let arguments = ["render", "balls", "-o", "a.png", "--size=64x48", "--kernel=oktant.spv"];
    run(folder, arguments.iter().chain(more))
}

#[test]
fn kernels_that_do_not_fit_are_told_why() {
    let folder = tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let good = CompiledKernel::committed();
    let refused = |words: &[&str]| assert_refused(&render(folder.path(), &[]), 1, words);

    refused(&["oktant.spv", "cannot be read"]);
    fs::write(path("oktant.spv"), "#version 450\n").unwrap();
    refused(&["oktant.spv", "not a SPIR-V module"]);
    let bytes = good.bytes();
    for length in [8, bytes.len() / 2, bytes.len() - 3] {
        fs::write(path("oktant.spv"), &bytes[..length]).unwrap();
        refused(&["truncated or damaged"]);
    }
    fs::write(path("oktant.spv"), &bytes).unwrap();
    refused(&["no manifest", "oktant.toml", "manifest.toml"]);
    fs::write(path("oktant.toml"), "name = 3\n").unwrap();
    refused(&["oktant.toml", "sha256"]);
    fs::remove_file(path("oktant.toml")).unwrap();

    good.write(folder.path());
    fs::write(path("oktant.spv"), good.renamed("hits", "hats").bytes()).unwrap();
    refused(&["not the module that", "SHA-256"]);

    let mut other = good.clone();
    other.manifest.target = "spirv-unknown-opengl4.5".into();
    other.write(folder.path());
    refused(&["spirv-unknown-opengl4.5", "spirv-unknown-vulkan1.2"]);
    let mut other = good.clone();
    other.manifest.bindings = BINDINGS + 1;
    other.write(folder.path());
    let (theirs, ours) = (
        format!("has bindings {}", BINDINGS + 1),
        format!("has bindings {BINDINGS}"),
    );
    refused(&[&theirs, &ours]);
    let text = fs::read_to_string(path("manifest.toml")).unwrap();
    fs::write(
        path("manifest.toml"),
        text.replace(&format!("bindings = {}\n", BINDINGS + 1), ""),
    )
    .unwrap();
    refused(&["bindings without a number"]);

    good.renamed("hits", "hats").write(folder.path());
    refused(&["no entry point `hits`"]);
    good.renamed("present_vertex", "vertex").write(folder.path());
    refused(&["no entry point `present_vertex`"]);
    good.narrowed(8).write(folder.path());
    refused(&["4 x 16 x 1", "8 x 16 x 1"]);

    good.write(folder.path());
    assert_refused(
        &render(folder.path(), &["--backend=cpu"]),
        2,
        &["--kernel", "--backend cpu"],
    );
    assert!(!path("a.png").exists());
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn a_kernel_from_a_file_renders_the_same() {
    let folder = tempdir().unwrap();
    let picture = || fs::read(folder.path().join("a.png")).unwrap();
    let good = CompiledKernel::committed();
    for path in ["--spirv=auto", "--spirv=naga"] {
        let arguments = ["render", "balls", "-o", "a.png", "--size=64x48", "--backend=gpu", path];
        let built_in = run(folder.path(), arguments);
        assert_eq!(built_in.code, Some(0), "{}", built_in.error);
        let wanted = picture();
        good.write(folder.path());
        let same = render(folder.path(), &["--backend=gpu", path]);
        assert_eq!(same.code, Some(0), "{}", same.error);
        assert!(picture() == wanted, "{path}");
        // What shows that the file is what runs.
        good.exchanged("render_plain", "hits").write(folder.path());
        let another = render(folder.path(), &["--backend=gpu", path]);
        assert_eq!(another.code, Some(0), "{}", another.error);
        assert!(picture() != wanted, "{path}");
    }
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn what_naga_does_not_understand_is_told() {
    let folder = tempdir().unwrap();
    CompiledKernel::committed().senseless().write(folder.path());
    let run = render(folder.path(), &["--backend=gpu", "--spirv=naga"]);
    assert_refused(&run, 1, &["oktant.spv", "does not run on", "InvalidId"]);
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn what_is_cast_with_must_be_there() {
    let folder = tempdir().unwrap();
    CompiledKernel::committed().write(folder.path());
    let parts = folder.path().join("parts");
    // Two rays: origin, t_min, direction, t_max.
    let numbers = [0.0_f32, 0.0, 9.0, 0.0, 0.0, 0.0, -1.0, 100.0].repeat(2);
    let mut rays = b"PRAY".to_vec();
    for word in [1_u32, 2, 0] {
        rays.extend(word.to_le_bytes());
    }
    rays.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    fs::write(folder.path().join("rays"), rays).unwrap();
    let cast = |more: &str| {
        let arguments = [
            "cast",
            "balls",
            "rays",
            "-o",
            "hits.npz",
            "--closest",
            "--backend=gpu",
            "--kernel=oktant.spv",
        ];
        run(folder.path(), arguments.into_iter().chain([more]))
    };
    let succeeds = |more: &str| {
        let run = cast(more);
        assert_eq!(run.code, Some(0), "{}", run.error);
    };
    let missing = |words: &[&str]| assert_refused(&cast("--triangle=plucker"), 1, words);
    let name = "no entry point `closest_octants_plucker`";
    succeeds("--triangle=watertight");
    missing(&[name, "there is no parts", "copy"]);
    // What casts with the default parts belongs to the first module.
    let first = CompiledKernel::committed();
    first
        .renamed("closest_octants_watertight", "closest_octants_x")
        .write(folder.path());
    let of_first = [
        "oktant: oktant.spv: ",
        "no entry point `closest_octants_watertight`",
        "add it",
    ];
    assert_refused(&cast("--triangle=watertight"), 1, &of_first);
    first.write(folder.path());
    let good = CompiledKernel::parts();
    good.write(&parts);
    succeeds("--triangle=plucker");
    good.renamed("closest_octants_plucker", "closest_octants_x")
        .write(&parts);
    succeeds("--triangle=watertight");
    missing(&[name, "add it"]);
    fs::write(parts.join("oktant.spv"), "no module").unwrap();
    assert_refused(&cast("--triangle=watertight"), 1, &["parts", "not a SPIR-V module"]);
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn what_renders_lists_must_be_there() {
    let folder = tempdir().unwrap();
    CompiledKernel::committed().write(folder.path());
    let render = |more: &[&str]| render(folder.path(), &[&["--backend=gpu"], more].concat());
    let adaptive = || render(&["--samples=adaptive:4"]);
    let whole = render(&["--samples=4"]);
    assert_eq!(whole.code, Some(0), "{}", whole.error);
    fs::remove_file(folder.path().join("a.png")).unwrap();
    let name = "no entry point `render_listed_plain`";
    assert_refused(&adaptive(), 1, &[name, "there is no lists", "copy"]);
    assert!(!folder.path().join("a.png").exists());
    let lists = CompiledKernel::lists();
    lists.write(&folder.path().join("lists"));
    let run = adaptive();
    assert_eq!(run.code, Some(0), "{}", run.error);
    lists
        .renamed("render_listed_plain", "render_listed_plaim")
        .write(&folder.path().join("lists"));
    assert_refused(&adaptive(), 1, &["lists", name, "add it"]);
}
