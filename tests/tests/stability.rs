//! `oktant stability`: every row shows something, and the default is right in all of them.
#![cfg(test)]

use oktant_tests::program::{Run, run};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn stability(folder: &Path, arguments: &[&str]) -> Run {
    run(folder, [&["stability", "--rays", "2000"], arguments].concat())
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).expect("JSON")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

fn wrong(method: &Value) -> u64 {
    ["missed", "false", "farther", "not_finite", "excess"]
        .into_iter()
        .map(|kind| method["counts"][kind].as_u64().expect("a count"))
        .sum()
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a text")
}

/// The default never fails, wherever it runs; what must fail does.
fn judge(report: &Value) {
    for row in list(&report["rows"]) {
        let methods = list(&row["methods"]);
        let id = text(&row["id"]);
        assert!(!list(&row["must_fail"]).is_empty(), "{id} shows nothing");
        for name in list(&row["must_fail"]).iter().map(text) {
            let fails = |method: &&Value| {
                let is = text(&method["name"]);
                is.strip_prefix("octants, ").unwrap_or(is) == name && wrong(method) > 0
            };
            let failing = methods.iter().find(fails);
            let failing = failing.unwrap_or_else(|| panic!("{id}: {name} did not fail"));
            let failures = list(&failing["failures"]);
            assert!(!failures.is_empty(), "{id}: {name}");
            for failure in failures.iter().filter(|failure| !failure["ray"].is_null()) {
                let numbers = text(&failure["ray"])
                    .split(',')
                    .map(|number| number.parse::<f32>().unwrap());
                assert!([6, 8].contains(&numbers.count()), "{failure}");
            }
        }
        assert_eq!(methods[0]["role"], "default", "{id}");
        for method in methods
            .iter()
            .filter(|method| ["default", "twin"].contains(&text(&method["role"])))
        {
            assert_eq!(wrong(method), 0, "{id}: {method}");
        }
        // Only what is not watertight may lose anything at all.
        for method in methods.iter().filter(|method| method["role"] == "offered") {
            let name = text(&method["name"]);
            let is_watertight = name.contains("watertight") || id.starts_with("box-");
            assert!(!is_watertight || wrong(method) == 0, "{id}: {method}");
        }
    }
}

#[test]
fn the_default_is_right_where_others_fail() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["--backend", "cpu", "--json", "s.json", "--html", "s.html"];
    let run = stability(folder.path(), &files);
    assert_eq!(run.code, Some(0), "{}", run.error);
    let report = json(&folder.path().join("s.json"));
    assert!(list(&report["rows"]).len() >= 50);
    assert_eq!(list(&report["devices"]).len(), 1);
    judge(&report);
    assert!(run.output.contains("the default is wrong 0 times"), "{}", run.output);
    assert!(!run.output.contains("did not fail"), "{}", run.output);
    let page = fs::read_to_string(folder.path().join("s.html")).unwrap();
    for row in list(&report["rows"]) {
        let heading = format!("<h2 id=\"{}\">", text(&row["id"]));
        assert!(
            run.output.contains(text(&row["title"])) && page.contains(&heading),
            "{heading}"
        );
    }
    // It needs no other file, and has rays to replay.
    assert!(!page.contains("http") && !page.contains("src="));
    assert!(page.contains("<code>oktant trace lab:edges --ray "));
    assert!(page.contains("<code>oktant trace box:"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
#[ignore = "needs a Vulkan driver"]
fn the_default_is_right_on_the_gpu_too() {
    let folder = tempfile::tempdir().unwrap();
    let run = stability(folder.path(), &["--backend", "gpu", "--json", "s.json"]);
    assert_eq!(run.code, Some(0), "{}", run.error);
    let report = json(&folder.path().join("s.json"));
    let devices = list(&report["devices"]);
    assert_eq!(devices.len(), 2);
    let arithmetic = text(&report["arithmetic"][0]);
    assert!(
        arithmetic.contains("a fused multiply-add rounds") && run.output.contains(arithmetic),
        "{arithmetic}"
    );
    judge(&report);
    let traced = |row: &&Value| {
        list(&row["methods"])
            .iter()
            .any(|method| method["device"] == devices[1])
    };
    assert!(list(&report["rows"]).iter().filter(traced).count() >= 30);
}

#[test]
fn rows_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let run = stability(folder.path(), &["--backend", "cpu", "--rows", "tiny,box-flat"]);
    assert_eq!(run.code, Some(0), "{}", run.error);
    assert!(run.output.contains("2 rows on CPU"), "{}", run.output);
    let run = stability(folder.path(), &["--backend", "cpu", "--rows", "tinny"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.error.contains("tiny"),
        "it says which one may be meant: {}",
        run.error
    );
}
