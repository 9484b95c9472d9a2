//! `oktant trace`: the way of a ray through every structure, held against the mesh and the oracle; its files; what the lab
//! prints is what it takes.
#![cfg(test)]

use oktant::mesh::Mesh;
use oktant::ply;
use oktant::progress::silent;
use oktant_tests::program::{Run, run};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const RAY: &str = "0.1,0.05,-0.2,-0.3,0.7,0.2";

fn trace(folder: &Path, arguments: &[&str]) -> Run {
    run(folder, [&["trace"], arguments].concat())
}

fn json(arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let run = trace(folder.path(), &[arguments, &["--json"]].concat());
    assert_eq!(run.code, Some(0), "{}", run.error);
    serde_json::from_str(&run.output).expect("JSON")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn point(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|axis| number(&value[axis]))
}

/// Whether a ray is somewhere inside of a box that is a little wider.
fn meets(origin: [f64; 3], direction: [f64; 3], low: [f64; 3], high: [f64; 3]) -> bool {
    let (mut enter, mut exit) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let [a, b] = [low[axis] - 1e-4, high[axis] + 1e-4].map(|plane| (plane - origin[axis]) / direction[axis]);
        enter = enter.max(a.min(b));
        exit = exit.min(a.max(b));
    }
    enter <= exit
}

/// A ray through a closed ball enters it where one the other way from its inside leaves it, and leaves it again behind that.
#[test]
fn what_lies_behind_the_hit_is_told() {
    let inside = json(&["lab:edges", "--ray", RAY]);
    assert!(list(&inside["beyond"]).is_empty());
    let through = ["lab:edges", "--ray", "-2.9,7.05,1.8,0.3,-0.7,-0.2"];
    let trace_through = json(&through);
    assert_eq!(trace_through["right"]["triangle"], inside["right"]["triangle"]);
    let [there] = list(&trace_through["beyond"]) else {
        panic!("{}", trace_through["beyond"]);
    };
    assert!(number(&there["t"]) > 10.0, "{there}");
    let folder = tempfile::tempdir().unwrap();
    let told = trace(folder.path(), &through).output;
    let start = format!("beyond    triangle {}, t = ", there["triangle"]);
    let t = told.lines().find_map(|line| line.strip_prefix(&start));
    let t: f64 = t.expect("it is in the table").parse().unwrap();
    assert!((t - number(&there["t"])).abs() < 1e-12, "{told}");
}

/// Whatever the structure, the ray meets what it visits, down to leaves that hold the triangle that it hits; what is tested
/// is in what was visited; and every test says what the oracle says.
#[test]
fn the_path_leads_to_the_hit() {
    let mut hits = BTreeSet::new();
    for (traversal, kinds, deepest) in [
        ("octants", ["node", "leaf"], 3),
        ("octree", ["leaf", "leaf"], 3),
        ("bvh2", ["node", "leaf"], 6),
        ("grid", ["cell", "cell"], 0),
        ("brute", ["leaf", "leaf"], 0),
    ] {
        let trace = json(&["lab:edges", "--ray", RAY, "--traversal", traversal]);
        assert_eq!(trace["parts"]["traversal"], traversal);
        assert_eq!(trace["verdict"], "agrees with f64", "{traversal}");
        let (hit, right) = (&trace["hit"], &trace["right"]);
        assert_eq!(hit["triangle"], right["triangle"]);
        assert!((number(&hit["t"]) / number(&right["t"]) - 1.0).abs() < 1e-6);
        hits.insert(number(&hit["t"]).to_bits());

        let (origin, direction) = (point(&trace["ray"]["origin"]), point(&trace["ray"]["direction"]));
        let visits = list(&trace["visits"]);
        for kind in kinds {
            assert!(
                visits.iter().any(|visit| visit["kind"] == kind),
                "{traversal} visits no {kind}"
            );
        }
        for visit in visits {
            let (low, high) = (point(&visit["low"]), point(&visit["high"]));
            // The box of an inner node of a BVH is met before it is visited; so are all others.
            assert!(meets(origin, direction, low, high), "{traversal}: {visit}");
        }
        let depth = visits.iter().map(|visit| number(&visit["depth"]) as u32).max();
        assert!(depth >= Some(deepest), "{traversal}: {depth:?}");
        let leaves = visits.iter().filter(|visit| visit["kind"] != "node");
        let in_leaves: f64 = leaves.map(|visit| number(&visit["triangles"])).sum();
        let tests = list(&trace["tests"]);
        assert_eq!(in_leaves as usize, tests.len(), "{traversal}");

        let hit_is_tested = tests.iter().any(|tested| tested["triangle"] == hit["triangle"]);
        assert!(hit_is_tested, "{traversal}");
        for tested in tests {
            let crosses = !tested["exact"].is_null();
            // Of the ray, not of its line.
            let is_met = crosses && number(&tested["exact"]["t"]) >= 0.0;
            assert_eq!(tested["contact"], if is_met { "inside" } else { "apart" }, "{tested}");
            assert_eq!(list(&tested["answers"]).len(), 4);
            for answer in list(&tested["answers"]) {
                assert_eq!(answer["crosses"], crosses, "{traversal}: {answer}");
                if crosses {
                    let (t, right) = (number(&answer["t"]), number(&tested["exact"]["t"]));
                    assert!((t - right).abs() < 1e-5, "{traversal}: {answer}");
                }
            }
        }
    }
    assert_eq!(hits.len(), 1, "all traversals find the same, bit for bit");
}

#[test]
fn limits_and_tests_are_those_that_are_asked_for() {
    let before = json(&["lab:edges", "--ray", RAY, "--tmax", "1"]);
    assert!(before["hit"].is_null() && before["right"].is_null());
    assert_eq!(before["verdict"], "agrees with f64");
    let behind = json(&[
        "lab:edges",
        "--ray",
        RAY,
        "--tmin",
        "1",
        "--tmax",
        "2",
        "--triangle",
        "plucker",
    ]);
    assert!(!behind["hit"].is_null());
    assert_eq!(behind["parts"]["triangle"], "plucker");
    let limits = json(&["lab:edges", "--ray", &format!("{RAY},0,1")]);
    assert!(limits["hit"].is_null());
    // From far away, the origin is advanced, and t counts from where it was.
    let far = json(&["lab:edges", "--ray", "0,0,-1000,0,0,1"]);
    assert!((number(&far["advanced"]) - 999.0).abs() < 0.1, "{}", far["advanced"]);
    assert!((number(&far["hit"]["t"]) - 999.0).abs() < 0.01);
    let nothing = json(&["lab:none", "--ray", "NaN,0,0,0,0,1"]);
    assert_eq!(nothing["ray"]["valid"], false);
    assert!(nothing["hit"].is_null() && list(&nothing["visits"]).is_empty());
}

/// A box and what box tests say of it.
#[test]
fn boxes_are_traced() {
    let on_a_face = json(&["box:0,0,0,1,1,1", "--ray", "0,0.5,-1,-0.0,0,1"]);
    for answer in list(&on_a_face["boxes"]) {
        assert_eq!(answer["meets"], true, "{answer}");
    }
    let beside = json(&["box:0,0,0,1,1,1", "--ray", "-0.1,0.5,-1,0,0,1"]);
    assert!(list(&beside["boxes"]).iter().all(|answer| answer["meets"] == false));
    assert!(beside["hit"].is_null());
}

/// The faces of an OBJ file, from 1, and its vertices.
fn counts_of_obj(text: &str) -> (usize, usize) {
    let of = |key: &str| text.lines().filter(|line| line.starts_with(key)).count();
    let (vertices, faces) = (of("v "), of("f "));
    let indices = text.lines().filter(|line| line.starts_with("f "));
    for index in indices.flat_map(|line| line.split(' ').skip(1)) {
        assert!((1..=vertices).contains(&index.parse().unwrap()), "{index}");
    }
    (vertices, faces)
}

#[test]
fn what_was_visited_is_exported() {
    let folder = tempfile::tempdir().unwrap();
    for traversal in ["octants", "octree", "bvh2", "grid"] {
        let ray = ["bunny", "--ray", "0,0.1,1,0,0,-1", "--traversal", traversal];
        let told = json(&ray);
        let run = trace(folder.path(), &[&ray[..], &["--export", "way.ply"]].concat());
        assert_eq!(run.code, Some(0), "{}", run.error);
        assert!(run.output.contains("agrees with f64") && run.output.contains("watertight"));
        let distinct: BTreeSet<u64> = list(&told["tests"])
            .iter()
            .map(|tested| number(&tested["triangle"]) as u64)
            .collect();
        let (cells, triangles) = (list(&told["visits"]).len(), distinct.len());
        assert!(
            cells > 4 && triangles > 0,
            "{traversal}: {cells} cells, {triangles} triangles"
        );
        let mesh: Mesh = ply::parse(&fs::read(folder.path().join("way.ply")).unwrap(), "way.ply", &silent).unwrap();
        assert_eq!(mesh.triangles.len(), 12 * cells + triangles, "{traversal}");
        assert_eq!(mesh.colors.len(), mesh.positions.len());
        // The last box is where it says.
        let last = &list(&told["visits"])[cells - 1];
        let corner = mesh.positions[8 * (cells - 1) + 7].to_array();
        assert_eq!(corner, point(&last["high"]).map(|coordinate| coordinate as f32));
        let run = trace(folder.path(), &[&ray[..], &["--export", "way.obj"]].concat());
        assert_eq!(run.code, Some(0), "{}", run.error);
        let obj = fs::read_to_string(folder.path().join("way.obj")).unwrap();
        assert_eq!(counts_of_obj(&obj), (8 * cells + 3 * triangles, 6 * cells + triangles));
    }
}

/// Every line that the lab prints leads to the failure that it tells of.
#[test]
fn what_the_lab_prints_can_be_traced() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "edges,table-1,box-in-plane,leave-near,none,reflect-below,normal-away,terminator,total,inside";
    let lab = [
        "stability",
        "--backend",
        "cpu",
        "--rays",
        "2000",
        "--rows",
        rows,
        "--json",
        "s.json",
    ];
    let lab = run(folder.path(), lab);
    assert_eq!(lab.code, Some(0), "{}", lab.error);
    let lines: Vec<&str> = lab
        .output
        .lines()
        .filter_map(|line| line.split_once(": oktant "))
        .map(|it| it.1)
        .collect();
    assert!(lines.len() >= 18, "{}", lab.output);
    for line in &lines {
        let again = run(folder.path(), line.split(' '));
        assert_eq!(again.code, Some(0), "{line}: {}", again.error);
    }
    let report: Value = serde_json::from_slice(&fs::read(folder.path().join("s.json")).unwrap()).unwrap();
    for row in list(&report["rows"]) {
        for method in list(&row["methods"]) {
            assert!(
                list(&method["failures"])
                    .iter()
                    .all(|failure| failure["replay"].is_string()),
                "{row}"
            );
        }
    }
    // An offered method fails again in the same way; the default does not.
    let failing = lines
        .iter()
        .find(|line| line.contains("--traversal octants --triangle moller-trumbore"));
    let failing: Vec<&str> = failing.expect("moller-trumbore fails").split(' ').collect();
    let again = json(&failing[1..]);
    assert!(again["hit"].is_null() && !again["right"].is_null(), "{failing:?}");
    let by_default = json(&failing[1..4]);
    assert_eq!(by_default["verdict"], "agrees with f64", "{failing:?}");
}

#[test]
fn what_cannot_be_traced_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, code, what) in [
        (&["bunny"][..], 2, "--ray"),
        (&["bunny", "--ray", "1,2,3"], 2, "six numbers"),
        (&["lab:edgy", "--ray", RAY], 2, "edges-offset"),
        (&["box:1,2", "--ray", RAY], 2, "six numbers"),
        (&["bunny", "--ray", RAY, "--export", "way.stl"], 2, ".obj"),
        (
            &["bunny", "--ray", RAY, "--traversal", "grid", "--triangle", "plucker"],
            2,
            "plucker",
        ),
        (&["gone.ply", "--ray", RAY], 1, "gone.ply"),
        (&["bunny", "--ray", RAY, "--export", "gone/way.ply"], 1, "gone"),
    ] {
        let run = trace(folder.path(), arguments);
        assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.error);
        assert!(run.error.contains(what), "{arguments:?}: {}", run.error);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
