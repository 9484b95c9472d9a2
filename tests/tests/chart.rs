//! `oktant chart`: fronts, limits, files that are whole and come back, and what is refused.
#![cfg(test)]

use oktant::chart::{Axis, Better, Figure, LEAKS, Origin, Panel, Record, Value, front, leak_rays};
use oktant::oracle::{Oracle, OracleRay};
use oktant_tests::program::{Run, run};
use quick_xml::Reader;
use quick_xml::events::Event;
use std::fs;
use std::path::Path;

fn chart(folder: &Path, arguments: &[&str]) -> Run {
    run(folder, [&["chart"], arguments].concat())
}

fn record(panel: &str, series: &str, x: f64, y: Value) -> Record {
    Record {
        panel: panel.into(),
        series: series.into(),
        label: format!("{series}, at \"{x}\" & <there>"),
        x,
        y,
        is_marked: x == 4.0,
    }
}

/// Two panels with commas, quotes, rates, limits and numbers.
fn figure() -> Figure {
    let panel = |name: &str, better, is_joined| Panel {
        name: name.into(),
        x: Axis::log("speed, \"fast\""),
        y: Axis::log("wrong"),
        better,
        is_joined,
    };
    let rate = |count| Value::Rate { count, of: 3_000 };
    Figure {
        stem: "a-figure_1".into(),
        title: "A title, with a comma & more".into(),
        explanation: "What is < seen.".into(),
        panels: vec![
            panel("first, of two", Some([Better::Higher, Better::Lower]), false),
            panel("second", None, true),
        ],
        records: vec![
            record("first, of two", "a", 4.0, rate(0)),
            record("first, of two", "b", 8.0, rate(5)),
            record("first, of two", "b", 2.0, rate(7)),
            record("second", "a", 1e-5, Value::Number(0.1)),
            record("second", "a", 1e6, Value::Number(std::f64::consts::PI)),
        ],
        origin: Origin {
            machine: "a machine".into(),
            commit: "0123456789".into(),
            command: "oktant chart".into(),
        },
    }
}

/// Against the definition, point by point against all others.
#[test]
fn nothing_dominates_the_front() {
    let mut random = fastrand::Rng::with_seed(1);
    for better in [
        [Better::Lower, Better::Lower],
        [Better::Higher, Better::Lower],
        [Better::Lower, Better::Higher],
        [Better::Higher, Better::Higher],
    ] {
        for count in 0..40 {
            // Few different values, so that there are points that are equal in one or both.
            let mut value = || f64::from(random.u32(..8));
            let points: Vec<[f64; 2]> = (0..count).map(|_| [value(), value()]).collect();
            let is_as_good = |a: f64, b: f64, better| if better == Better::Lower { a <= b } else { a >= b };
            let dominates = |a: &[f64; 2], b: &[f64; 2]| {
                a != b && is_as_good(a[0], b[0], better[0]) && is_as_good(a[1], b[1], better[1])
            };
            let wanted: Vec<usize> = (0..points.len())
                .filter(|&index| !points.iter().any(|other| dominates(other, &points[index])))
                .collect();
            let is = front(&points, better);
            assert!(is.windows(2).all(|pair| points[pair[0]][0] <= points[pair[1]][0]));
            let mut sorted = is;
            sorted.sort_unstable();
            assert_eq!(sorted, wanted, "{points:?} {better:?}");
        }
    }
}

#[test]
fn what_never_happened_is_drawn_at_three_in_all() {
    let rate = |count, of| Value::Rate { count, of };
    assert_eq!((rate(0, 3_000).drawn(), rate(0, 3_000).is_limit()), (1e-3, true));
    assert_eq!((rate(3, 3_000).drawn(), rate(3, 3_000).is_limit()), (1e-3, false));
    assert_eq!(
        (Value::Number(0.0).drawn(), Value::Number(0.0).is_limit()),
        (0.0, false)
    );
}

#[test]
fn files_are_whole_and_data_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let figure = figure();
    let paths = figure.save(folder.path()).unwrap();
    assert_eq!(paths.len(), 3);
    assert_eq!(Figure::read(&folder.path().join("a-figure_1.csv")).unwrap(), figure);

    let svg = fs::read_to_string(folder.path().join("a-figure_1.svg")).unwrap();
    let texts = texts(&svg);
    for text in [
        "A title, with a comma & more",
        "What is < seen.",
        "first, of two",
        "second",
        "speed, \"fast\"",
        "a",
        "b",
        "0 (< 10⁻³)",
        "a, at \"4\" & <there>",
        "a machine · commit 0123456789 · oktant chart",
    ] {
        assert!(texts.iter().any(|is| is == text), "{text} is missing in {texts:?}");
    }

    let png = image::open(folder.path().join("a-figure_1.png")).unwrap().to_rgb8();
    assert!(png.width() >= 1_200 && png.height() >= 600, "{:?}", png.dimensions());
    let ink = png.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
    let part = ink as f64 / f64::from(png.width() * png.height());
    assert!((0.005..0.2).contains(&part), "{part} of the picture is drawn on");
}

/// The texts of an SVG file that is well-formed.
fn texts(svg: &str) -> Vec<String> {
    let mut reader = Reader::from_str(svg);
    let mut depth = 0;
    let mut texts = vec![String::new()];
    loop {
        match reader.read_event().expect("well-formed") {
            Event::Start(_) => {
                depth += 1;
                texts.push(String::new());
            }
            Event::End(_) => {
                depth -= 1;
                texts.push(String::new());
            }
            Event::Text(text) => texts.last_mut().unwrap().push_str(&text.decode().unwrap()),
            Event::GeneralRef(name) => {
                let name = name.decode().unwrap();
                let entity = quick_xml::escape::resolve_predefined_entity(&name).expect("a known entity");
                texts.last_mut().unwrap().push_str(entity);
            }
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0);
    texts.into_iter().map(|text| text.trim().to_owned()).collect()
}

/// All rays must hit, by the oracle.
#[test]
fn no_ray_leaves_the_ball_by_right() {
    let (mesh, rays) = leak_rays(3_000);
    let oracle = Oracle::new(&mesh);
    for ray in &rays {
        let ray = OracleRay::new(ray.origin, ray.direction, ray.t_min, ray.t_max);
        assert!(oracle.closest(&ray).is_some(), "{ray:?}");
    }
}

/// Measured small, all charts, then drawn again from what was written, with other people's tracers.
#[test]
fn charts_are_measured_and_drawn_again() {
    let folder = tempfile::tempdir().unwrap();
    let small = [
        "--backend",
        "cpu",
        "--rays",
        "3000",
        "--size",
        "64x48",
        "--repeat",
        "1",
        "--largest",
        "4000",
        "--pictures",
        "16x12",
    ];
    let made = chart(
        folder.path(),
        &[&["-o", "deep/charts", "balls"], small.as_slice()].concat(),
    );
    assert_eq!(made.code, Some(0), "{}", made.error);
    let stems = [
        "accuracy",
        "range-tests",
        "range-traversals",
        "octree-balls",
        "memory",
        "growth",
        "image-error-rmse",
        "image-error-flip",
        "depth-error",
        "samples-flip",
        "samples-rmse",
    ];
    assert_eq!(made.output.lines().count(), 3 * stems.len(), "{}", made.output);
    let read = |stem: &str| Figure::read(&folder.path().join(format!("deep/charts/{stem}.csv"))).unwrap();
    for stem in stems {
        let figure = read(stem);
        assert!(
            figure.origin.command.starts_with("oktant chart -o deep/charts balls"),
            "{stem}"
        );
        for panel in &figure.panels {
            assert!(
                figure.records.iter().any(|record| record.panel == panel.name),
                "{stem}: {}",
                panel.name
            );
        }
        texts(&fs::read_to_string(folder.path().join(format!("deep/charts/{stem}.svg"))).unwrap());
    }

    // The default leaks nowhere; who is known to leak does.
    let accuracy = read("accuracy");
    let leaks = |label: &str| {
        let mut own = accuracy
            .records
            .iter()
            .filter(|record| record.panel == LEAKS && record.label == label);
        let record = own.next().unwrap_or_else(|| panic!("{label} is missing"));
        match record.y {
            Value::Rate { count, of } => (count, of, record.is_marked),
            Value::Number(_) => panic!("{label} has no rate"),
        }
    };
    assert_eq!(leaks("watertight"), (0, 3_000, true));
    assert_eq!(leaks("watertight, contracted"), (0, 3_000, false));
    for label in ["moller-trumbore", "baldwin-weber", "havel-herout"] {
        assert!(leaks(label).0 > 30, "{label}: {:?}", leaks(label));
    }

    // No test or traversal that is offered depends on scale; an absolute epsilon does.
    let wrong = |figure: &Figure, series: &str| -> u64 {
        let own = figure.records.iter().filter(|record| record.series == series);
        let counts = own.map(|record| match record.y {
            Value::Rate { count, .. } => count,
            Value::Number(_) => panic!("{series} has no rate"),
        });
        counts.sum()
    };
    let tests = read("range-tests");
    assert_eq!(wrong(&tests, "watertight"), 0);
    assert!(wrong(&tests, "moller-trumbore, epsilon 1e-6") > wrong(&tests, "moller-trumbore"));
    assert!(wrong(&tests, "moller-trumbore") > 0 && wrong(&tests, "baldwin-weber") > 0);
    let walks = read("range-traversals");
    for series in ["octants", "octree", "bvh2", "grid"] {
        assert_eq!(wrong(&walks, series), 0, "{series}");
    }
    assert!(wrong(&walks, "revelles, as published") > 1_000);

    // Counted work grows about as the logarithm.
    let growth = read("growth");
    let last = |series: &str| {
        let mut own = growth
            .records
            .iter()
            .filter(|record| record.panel == "growth of the work" && record.series == series);
        own.next_back().expect("a record").y.drawn()
    };
    assert!(
        (1.0..1.6).contains(&last("R1, primary rays")),
        "{}",
        last("R1, primary rays")
    );
    assert!((1.1..1.3).contains(&last("the logarithm of the triangles")));

    // As it was, from files, and with peers.
    fs::write(
        folder.path().join("peers.json"),
        r#"{"machine": "another machine", "commit": "abc", "size": [64, 48], "repeats": 1, "meshes": [{"name": "balls",
        "triangles": 4032, "conditions": ["1 thread", "2 threads"], "contestants": [{"name": "somebody", "is_ours": false,
        "sets": [{"set": "R1", "rays": 3000, "mrays_per_second":
        [{"median": 2, "least": 1, "greatest": 4}, {"median": 2, "least": 1, "greatest": 4}],
        "judgement": {"rays": 3000, "missed": 1, "false": 2, "wrong_t": 3, "excused": 4, "disagreements": []}}]}]}]}"#,
    )
    .unwrap();
    let again = chart(
        folder.path(),
        &[
            "--from",
            "deep/charts/accuracy.csv",
            "--peers",
            "peers.json",
            "-o",
            "again",
        ],
    );
    assert_eq!(again.code, Some(0), "{}", again.error);
    assert_eq!(again.output.lines().count(), 3, "{}", again.output);
    let merged = Figure::read(&folder.path().join("again/accuracy.csv")).unwrap();
    assert_eq!(merged.panels, accuracy.panels);
    let (own, others) = merged.records.split_at(accuracy.records.len());
    assert_eq!(own, accuracy.records);
    assert_eq!(others.len(), 1);
    assert_eq!(
        (others[0].label.as_str(), others[0].series.as_str()),
        ("somebody", "peers, CPU")
    );
    assert_eq!((others[0].x, others[0].y), (4.0, Value::Rate { count: 6, of: 3_000 }));
    assert!(
        merged
            .origin
            .command
            .ends_with(" + oktant-bench-peers --json peers.json"),
        "{}",
        merged.origin.command
    );
    assert!(
        merged.origin.machine.ends_with("; another machine"),
        "{}",
        merged.origin.machine
    );
}

/// What begins as a comment does, quotes and commas come back from a file too.
#[test]
fn names_may_begin_like_comments() {
    let folder = tempfile::tempdir().unwrap();
    let mut figure = figure();
    figure.panels[0].name = "# one".into();
    for record in figure.records.iter_mut().filter(|record| record.panel != "second") {
        record.panel = figure.panels[0].name.clone();
    }
    let path = folder.path().join("a.csv");
    fs::write(&path, figure.to_csv()).unwrap();
    assert_eq!(Figure::read(&path).unwrap(), figure);
}

/// Numbers that no axis could hold are refused, with their line; the ones at the limits can be drawn.
#[test]
fn numbers_have_limits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    let figure = figure();
    let read = |number: &str| {
        fs::write(&path, figure.to_csv().replace("1000000", number)).unwrap();
        Figure::read(&path)
    };
    for number in ["1e308", "-1e308", "1e-308", "1.1e100", "0.9e-100"] {
        let error = read(number).unwrap_err().to_string();
        let told = "line 14 has a number that is neither 0 nor of a size from 1e-100 to 1e100";
        assert!(error.contains(told), "{number}: {error}");
    }
    for number in ["inf", "NaN", "many"] {
        let error = read(number).unwrap_err().to_string();
        assert!(error.contains("line 14 has a number that is none"), "{number}: {error}");
    }
    for number in ["1e100", "1e-100", "0", "-1e100"] {
        let figure = read(number).unwrap();
        assert_eq!(figure.save(folder.path()).unwrap().len(), 3, "{number}");
    }
}

/// The command of the footer makes the chart again, whatever a shell would make of its arguments; and what was read is
/// merged into what is measured.
#[test]
fn the_command_can_be_typed_again() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "growth",
        "--backend",
        "cpu",
        "--size",
        "8x6",
        "--largest",
        "1000",
        "--repeat",
        "1",
    ];
    let made = chart(folder.path(), &[arguments.as_slice(), &["-o", "it's $1"]].concat());
    assert_eq!(made.code, Some(0), "{}", made.error);
    let file = "it's $1/growth.csv";
    let made = Figure::read(&folder.path().join(file)).unwrap();
    let command = format!("oktant chart {}", arguments.join(" "));
    assert_eq!(made.origin.command, format!(r"{command} -o 'it'\''s $1'"));

    let again = chart(
        folder.path(),
        &[arguments.as_slice(), &["--from", file, "-o", "again"]].concat(),
    );
    assert_eq!(again.code, Some(0), "{}", again.error);
    assert_eq!(again.output.lines().count(), 3, "{}", again.output);
    let again = Figure::read(&folder.path().join("again/growth.csv")).unwrap();
    assert!(made.records.iter().all(|record| again.records.contains(record)));
    let of_work = |figure: &Figure| figure.records.iter().filter(|record| record.panel == "work").count();
    assert_eq!(of_work(&again), of_work(&made), "counts are the same every time");
}

#[cfg(unix)]
#[test]
fn names_need_not_be_text() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().unwrap();
    let output = OsStr::from_bytes(b"a\xff");
    let arguments = [
        "chart",
        "growth",
        "--backend",
        "cpu",
        "--size",
        "8x6",
        "--largest",
        "1000",
        "-o",
    ];
    let made = run(folder.path(), arguments.into_iter().map(OsStr::new).chain([output]));
    assert_eq!(made.code, Some(0), "{}", made.error);
    assert!(Figure::read(&folder.path().join(output).join("growth.csv")).is_ok());
}

/// One source by two paths counts once; scenes alone make the charts that are of scenes.
#[test]
fn scenes_alone_make_charts_of_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "[materials.clay]\nbase = [0.6, 0.5, 0.5]\n[[mesh]]\nname = \"balls\"\nmaterial = \"clay\"\n";
    fs::write(folder.path().join("a.toml"), scene).unwrap();
    let small = ["--backend", "cpu", "--repeat", "1", "--pictures", "8x6", "-o", "x"];
    let made = chart(folder.path(), &[["a.toml", "./a.toml"].as_slice(), &small].concat());
    assert_eq!(made.code, Some(0), "{}", made.error);
    assert_eq!(made.output.lines().count(), 15, "{}", made.output);
    let figure = Figure::read(&folder.path().join("x/image-error-rmse.csv")).unwrap();
    assert_eq!((figure.panels.len(), figure.panels[0].name.as_str()), (1, "a"));
    // Three patterns in four numbers of samples, and in three that are adaptive, and three sizes of blocks.
    assert_eq!(figure.records.len(), 24);
}

#[test]
fn what_is_wrong_is_told() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("other.csv"), "a,b\n1,2\n").unwrap();
    fs::write(folder.path().join("other.json"), "{}").unwrap();
    let figure = figure().to_csv();
    fs::write(folder.path().join("broken.csv"), figure.replace("1000000", "many")).unwrap();
    fs::write(
        folder.path().join("elsewhere.csv"),
        figure.replace("a-figure_1", "../a"),
    )
    .unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    for (arguments, code, told) in [
        (["growth"].as_slice(), 2, "--output"),
        (&["-o", "x", "--rays", "5"], 2, "--rays"),
        (&["-o", "x", "--repeat", "0"], 2, "--repeat"),
        (&["-o", "x", "--largest", "10"], 2, "--largest"),
        (&["-o", "x", "--size", "wide"], 2, "--size"),
        (
            &["-o", "x", "missing.ply", "octree"],
            1,
            "missing.ply: there is no such file",
        ),
        (&["-o", "x", "--from", "missing.csv"], 1, "missing.csv cannot be read"),
        (
            &["-o", "x", "--from", "other.csv"],
            1,
            "other.csv is not what `oktant chart` writes",
        ),
        (&["-o", "x", "--from", "broken.csv"], 1, "has a number that is none"),
        (&["-o", "x", "--from", "elsewhere.csv"], 1, "is no name of a chart"),
        (
            &["-o", "x", "--peers", "other.json"],
            1,
            "other.json is not what `oktant-bench-peers --json` writes",
        ),
        (&["-o", "file", "growth"], 1, "The folder file cannot be made"),
        (
            &["-o", "x", "octree", "m/a.ply", "n/a.ply"],
            2,
            "m/a.ply and n/a.ply are both called `a` in charts; rename one, or chart them apart.",
        ),
        (
            &["-o", "x", "image-error", "bunny", "scenes/bunny.toml"],
            2,
            "bunny and scenes/bunny.toml are both called `bunny` in charts",
        ),
        (
            &["-o", "x", "accuracy", "image-error", "a.toml"],
            2,
            "accuracy, octree and memory are of meshes; name one, e.g. bunny, beside the scene.",
        ),
        // Before anything is measured.
        (&["-o", "x", "growth", "balls", "other.csv"], 1, "other.csv"),
    ] {
        let arguments = [arguments, &["--backend", "cpu"]].concat();
        let run = chart(folder.path(), &arguments);
        assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.error);
        assert!(run.error.contains(told), "{arguments:?}: {}", run.error);
        assert!(!run.error.contains("panicked"), "{}", run.error);
    }
    let there = fs::read_dir(folder.path().join("x")).map_or(0, Iterator::count);
    assert_eq!(there, 0, "something is left");
}
