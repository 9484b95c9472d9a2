//! `oktant bench`: that it measures what it is asked for, and that what it counts does not depend on the machine.
#![cfg(test)]

use oktant_tests::program::{Run, run};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A ball, so that brute force takes part.
const SMALL: [&str; 9] = [
    "bench",
    "--scenes",
    "ball=1000",
    "--size",
    "48x36",
    "--repeat",
    "2",
    "--backend",
    "cpu",
];

fn bench(folder: &Path, arguments: &[&str]) -> Run {
    let run = run(folder, [&SMALL, arguments].concat());
    assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.error);
    run
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).expect("JSON")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

fn is_spread(spread: &Value) {
    let [least, median, greatest] =
        ["least", "median", "greatest"].map(|name| spread[name].as_f64().expect("a number"));
    assert!(0.0 < least && least <= median && median <= greatest, "{spread}");
}

#[test]
fn all_parts_are_measured_and_right() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let files = ["--tables", "parts", "--split", "--json", "b.json", "--markdown", "b.md"];
    let told = bench(folder, &files);
    let report = json(&folder.join("b.json"));
    assert_eq!(report["size"], serde_json::json!([48, 36]));
    assert_eq!((&report["repeats"], &report["thesis"]), (&2.into(), &Value::Null));
    let meshes = list(&report["meshes"]);
    let counts: Vec<_> = meshes.iter().map(|mesh| mesh["triangles"].as_u64()).collect();
    assert_eq!(counts, [Some(968), Some(4 * 968)]);
    for mesh in meshes {
        let sets = list(&mesh["sets"]);
        let names: Vec<_> = sets.iter().map(|set| set["set"].as_str()).collect();
        assert_eq!(names, ["R1", "R2", "R3", "R4"].map(Some));
        assert_eq!(sets[0]["rays"], 48 * 36);
        assert_eq!(sets[0]["hits"], sets[1]["rays"]);
        let combinations = list(&mesh["combinations"]);
        assert_eq!(combinations.len(), oktant_shared::parts::Parts::OFFERED.len());
        for combination in combinations {
            is_spread(&combination["build_milliseconds"]);
            let bytes = combination["bytes_per_triangle"].as_f64().unwrap();
            // What the triangles take alone: three rows, or three words and half a row of a corner.
            let least = if combination["parts"]["traversal"] == "compact" {
                20.0
            } else {
                48.0
            };
            assert!((least..1_000.0).contains(&bytes), "{bytes}");
            for set in list(&combination["sets"]) {
                is_right(combination, set);
            }
        }
        let name = mesh["name"].as_str().unwrap();
        assert!(told.output.contains(name), "{name}");
    }
    let markdown = fs::read_to_string(folder.join("b.md")).unwrap();
    assert!(markdown.contains("| octants   | watertight"), "{markdown}");
    assert_eq!(fs::read_dir(folder).unwrap().count(), 2);
}

/// Something was read, traced and timed, and no watertight test misses anything.
fn is_right(combination: &Value, set: &Value) {
    let parts = &combination["parts"];
    assert!(set["triangle_tests_per_ray"].as_f64().unwrap() > 0.0, "{parts}");
    let has_nodes = set["nodes_per_ray"].as_f64().unwrap() > 0.0;
    assert_eq!(has_nodes, parts["traversal"] != "brute", "{parts}");
    let [device] = list(&set["devices"]) else {
        panic!("the CPU alone was asked for");
    };
    is_spread(&device["mrays_per_second"]);
    is_spread(&device["milliseconds"]);
    if parts["triangle"] == "watertight" {
        let judgement = &device["judgement"];
        let wrong = ["missed", "false"].map(|kind| judgement[kind].as_u64());
        assert_eq!(wrong, [Some(0), Some(0)], "{parts}: {judgement}");
    }
}

#[test]
fn what_is_counted_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let counts = |threads: &str| {
        let mut command = Command::new(oktant_tests::program::oktant());
        command.args(SMALL).args(["--tables", "parts", "--json", "b.json"]);
        let command = command.env("RAYON_NUM_THREADS", threads).current_dir(folder.path());
        assert_eq!(oktant_tests::program::finish(command).code, Some(0));
        let report = json(&folder.path().join("b.json"));
        let combinations = list(&report["meshes"][0]["combinations"]).iter();
        let of_sets = combinations.flat_map(|one| list(&one["sets"]).iter().map(|set| set["counts"].clone()));
        of_sets.collect::<Vec<Value>>()
    };
    let one = counts("1");
    assert_eq!(one.len(), 4 * oktant_shared::parts::Parts::OFFERED.len());
    assert_eq!(one, counts("3"));
}

#[test]
fn the_pictures_of_the_thesis() {
    let folder = tempfile::tempdir().unwrap();
    bench(folder.path(), &["--tables", "thesis", "--json", "b.json"]);
    let report = json(&folder.path().join("b.json"));
    assert_eq!(list(&report["meshes"]).len(), 0);
    let rows = list(&report["thesis"]["rows"]);
    assert_eq!(rows.len(), 8);
    for row in rows {
        is_spread(&row["milliseconds"]);
        let [frames, thesis, gain] = ["frames_per_second", "thesis", "gain"].map(|name| row[name].as_f64().unwrap());
        assert!((frames / thesis / gain - 1.0).abs() < 1e-9, "{row}");
    }
    assert_eq!(
        (&rows[0]["triangles"], &rows[4]["triangles"]),
        (&69_451.into(), &4_032.into())
    );
}

#[test]
fn standard_output_takes_json_or_markdown_alone() {
    let folder = tempfile::tempdir().unwrap();
    let told = |option: &str| {
        let parts = ["--tables", "parts", "--traversal", "octants", option, "-"];
        bench(folder.path(), &parts).output
    };
    let report: Value = serde_json::from_str(&told("--json")).expect("JSON and nothing else");
    assert_eq!(report["size"], serde_json::json!([48, 36]));
    let markdown = told("--markdown");
    let has_lines = markdown.contains('\u{2502}');
    assert!(
        markdown.starts_with("## ") && markdown.contains("| octants ") && !has_lines,
        "{markdown}"
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn what_cannot_be_measured_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, code, words) in [
        (
            &["--traversal", "grid", "--triangle", "plucker"][..],
            2,
            "No combination",
        ),
        (&["--scenes", "castle"], 2, "room, stadium"),
        (&["--sets", "refracted"], 2, "--sets"),
        (&["--repeat", "0"], 2, "--repeat"),
        (&["missing.ply"], 1, "missing.ply"),
        (&["--json", "nowhere/b.json"], 1, "nowhere"),
        (&["--json", "-", "--markdown", "-"], 2, "the name of a file"),
    ] {
        let tail = [
            &["bench", "--tables", "parts", "--size", "16x12", "--backend", "cpu"],
            arguments,
        ]
        .concat();
        let failed = run(folder.path(), tail);
        assert_eq!(failed.code, Some(code), "{arguments:?}: {}", failed.error);
        assert!(failed.error.contains(words), "{arguments:?}: {}", failed.error);
        assert!(!failed.error.contains("panicked") && failed.output.is_empty());
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
