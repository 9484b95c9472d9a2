//! The six tasks of `docs/tasks.md`: its commands do what the page says, and its pictures are theirs.

use super::window::{Image, Report, Session, agreement};
use oktant::view::View;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A slow computer renders a scene of mirrors in a large window.
const PATIENCE: Duration = Duration::from_secs(180);

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/tasks.md")).expect("the page is there")
}

/// Copies the files of a folder of the project into the session's, under the same names.
fn copy(session: &Session, folder: &str) {
    let to = session.folder().join(folder);
    std::fs::create_dir_all(&to).expect("a folder can be made");
    for entry in std::fs::read_dir(root().join(folder)).expect("the folder is there") {
        let from = entry.expect("it can be read to its end").path();
        if from
            .extension()
            .is_some_and(|extension| extension == "txt" || extension == "toml")
        {
            std::fs::copy(&from, to.join(from.file_name().expect("it has a name"))).expect("it can be copied");
        }
    }
}

/// Runs the command of a task, in a folder with the scenes and scripts of the project.
fn play(task: &str) -> (Session, Report) {
    let session = Session::new();
    copy(&session, "docs/tasks");
    copy(&session, "assets/scenes");
    let page = page();
    let script = format!("docs/tasks/{task}.txt");
    let command = page
        .lines()
        .find(|line| line.starts_with("oktant view ") && line.ends_with(&script));
    let command = command.unwrap_or_else(|| panic!("no command plays {script}"));
    let arguments: Vec<&str> = command.split_whitespace().skip(1).collect();
    let report = session.start_with(&arguments).finish_within(PATIENCE);
    (session, report)
}

/// The picture of a task that was just made, and the one that the page shows; figures of speed in them differ.
fn pictures(session: &Session, name: &str) -> [Image; 2] {
    let path = format!("docs/tasks/{name}.png");
    assert!(page().contains(&format!("(tasks/{name}.png)")), "the page shows {name}");
    let shown =
        image::open(root().join(&path)).unwrap_or_else(|error| panic!("{path}: {error}; run docs/make-pictures"));
    [session.await_picture(&path), shown.to_rgb8()]
}

fn assert_shown(session: &Session, name: &str) -> Image {
    let [made, shown] = pictures(session, name);
    let same = agreement(&made, &shown);
    println!("{name}: {:.1} % of the pixels are those of the page", same * 100.0);
    assert!(
        same > 0.95,
        "{name} is not what the page shows ({same}); run docs/make-pictures"
    );
    made
}

#[test]
#[ignore = "needs a display"]
fn open_a_file() {
    let (session, report) = play("open");
    assert_ne!(report.value("triangles"), "69451", "the bunny is gone: {report}");
    let [keys, opened] = ["keys", "open"].map(|name| assert_shown(&session, name));
    assert!(agreement(&keys, &opened) < 0.5);
}

#[test]
#[ignore = "needs a display"]
fn turn_it() {
    let (session, report) = play("turn");
    let (view, first) = (report.view(), View::default());
    assert!(
        (view.camera.azimuth - (first.camera.azimuth - 45.0)).abs() < 1e-3,
        "{report}"
    );
    assert!(view.camera.distance < first.camera.distance, "{report}");
    assert_ne!(view.target, first.target, "{report}");
    assert_shown(&session, "turn");
}

#[test]
#[ignore = "needs a display"]
fn light_it() {
    let (session, report) = play("light");
    let (view, first) = (report.view(), View::default());
    assert_ne!(view.light, first.light, "{report}");
    assert!(view.tone.exposure > 0.5, "{report}");
    assert_eq!(view.camera, first.camera, "{report}");
    assert_shown(&session, "light");
}

#[test]
#[ignore = "needs a display"]
fn change_a_material() {
    let (session, report) = play("material");
    let value = |name: &str| -> f32 {
        let value = report.value(&format!("set material 3 {name}"));
        value
            .split(',')
            .next()
            .and_then(|red| red.parse().ok())
            .expect("a number")
    };
    assert!(value("mirror") > 0.5, "it mirrored a tenth: {report}");
    assert!(value("base") > 0.5, "it is the red one: {report}");
    let [picked, changed] = ["picked", "material"].map(|name| assert_shown(&session, name));
    assert!(agreement(&picked, &changed) < 0.97, "it is seen");
}

#[test]
#[ignore = "needs a display"]
fn see_why_a_region_is_slow() {
    let (session, report) = play("slow");
    assert_eq!(report.value("show"), "steps", "{report}");
    let figures = |name: &str| -> Vec<f64> {
        let value = report.value(name);
        value.split(' ').map(|word| word.parse().expect("a number")).collect()
    };
    let mean = figures("show-figures")[2];
    let steps = figures("pin")[2];
    assert!(
        steps > 5.0 * mean,
        "{steps} nodes, where rays visit {mean} in the mean: {report}"
    );
    assert_shown(&session, "slow");
}

#[test]
#[ignore = "needs a display"]
fn save_the_picture() {
    let (session, report) = play("save");
    let saved = session.await_picture("oktant-0001.png");
    let view = report.view();
    let wanted = super::window::offline(&view, saved.dimensions().into());
    super::assert_same("what was saved", &saved, &wanted);
    assert_shown(&session, "save");
}

/// The steps of a script that a person does.
fn inputs(script: &str) -> Vec<&str> {
    let steps = script.lines().map(str::trim);
    let steps = steps.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let is_input = |step: &&str| {
        let word = step.split(' ').next().unwrap_or_default();
        !["wait", "screenshot", "print", "expect"].contains(&word)
    };
    steps.filter(is_input).collect()
}

#[test]
fn each_task_takes_at_most_six_inputs() {
    // The window's first lines name these two; H lists the others.
    let is_named = |input: &str| ["key H", "key Tab"].contains(&input);
    let mut tasks = 0;
    for entry in std::fs::read_dir(root().join("docs/tasks")).expect("the folder is there") {
        let path = entry.expect("it can be read to its end").path();
        if path.extension().is_none_or(|extension| extension != "txt") {
            continue;
        }
        tasks += 1;
        let name = path.display();
        let script = std::fs::read_to_string(&path).expect("scripts are text");
        let inputs = inputs(&script);
        println!("{name}: {}", inputs.join(", "));
        assert!((1..=6).contains(&inputs.len()), "{name}: {} inputs", inputs.len());
        let mut keys = inputs.iter().filter(|input| input.starts_with("key "));
        if keys.any(|key| !is_named(key)) {
            assert_eq!(inputs[0], "key H", "{name}: nobody has told of its keys");
        }
    }
    assert_eq!(tasks, 6);
}

#[test]
fn every_picture_of_the_page_is_there() {
    let page = page();
    let links = page.split("](tasks/").skip(1).filter_map(|rest| rest.split(')').next());
    let shown: Vec<&str> = links.filter(|name| name.ends_with(".png")).collect();
    assert!(shown.len() >= 6, "{shown:?}");
    for name in shown {
        assert!(
            root().join("docs/tasks").join(name).is_file(),
            "{name} is missing; run docs/make-pictures"
        );
    }
}
