//! How fluid a drag is: times between pictures, and from a move of the pointer to the picture that shows it.
//!
//! However busy the computer is, a move is shown in the next picture that is begun: it waits for the one that is being rendered,
//! and for its own. `OKTANT_LIMIT=100` asks for 99 of 100 times between pictures to be below so many milliseconds, which only
//! means something where nothing else runs, and drags for longer.

use super::window::{Report, Session, start};
use oktant_tests::data::reference;
use std::path::Path;
use std::time::Duration;

/// Both last as long: ten moves, to and fro.
const DRAGS: &str = "drag left 120 30\ndrag left -120 -30\n";
/// The middle one of the times from a move to its picture is at most so many times that between two pictures.
const PICTURES: f64 = 2.2;
/// A pixel of the coarsest draft covers so many of the window's along each side.
const COARSEST: u32 = 4;
/// Together with what a slow computer needs to load a scene.
const PATIENCE: Duration = Duration::from_secs(120);

/// Median, 99th percentile, greatest and count of times, milliseconds.
fn times(report: &Report, name: &str) -> [f64; 4] {
    let value = report.value(name);
    let numbers: Vec<f64> = value.split(' ').map(|word| word.parse().expect("a number")).collect();
    numbers.try_into().expect("four of them")
}

/// The edge of the squares of pixels that the last draft rendered as one.
fn edge(report: &Report) -> u32 {
    let draft = report.value("draft");
    let edge = draft.split(' ').next().and_then(|edge| edge.parse().ok());
    edge.unwrap_or_else(|| panic!("no edge in {draft:?}"))
}

/// Drags what is named in a window of 1280 x 968 that the CPU renders.
fn a_drag_is_fluid(source: &str) {
    let limit = std::env::var("OKTANT_LIMIT").ok();
    let limit: Option<f64> = limit.map(|limit| limit.parse().expect("OKTANT_LIMIT is a number of milliseconds"));
    let session = Session::new();
    let repeats = if limit.is_some() { 100 } else { 8 };
    let script = format!("wait frames 1\n{}print", DRAGS.repeat(repeats));
    let arguments = [source, "--backend", "cpu", "--size", "1280x968"];
    let report = session.start(&arguments, &script).finish_within(PATIENCE);
    let [frame, response] = ["frame-milliseconds", "response-milliseconds"].map(|name| times(&report, name));
    println!(
        "| {} | {} | {:.0} | {:.0} | {:.0} | {:.0} | {:.0} |",
        Path::new(source).file_stem().unwrap_or_default().display(),
        report.value("draft"),
        frame[0],
        frame[1],
        frame[2],
        response[0],
        response[1]
    );
    assert!((1..=COARSEST).contains(&edge(&report)), "{report}");
    println!(
        "{source}: from a move to its picture {:.1} ms, between pictures {:.1} ms",
        response[0], frame[0]
    );
    assert!(
        response[0] <= PICTURES * frame[0],
        "{source}: a move waits for more than the next picture: {report}"
    );
    match limit {
        None => assert!(frame[3] >= 4.0, "it moved: {report}"),
        Some(limit) => {
            assert!(frame[3] >= 200.0, "too few pictures for a percentile: {report}");
            assert!(
                frame[1] < limit,
                "{source}: 99 % of the pictures come within {} ms",
                frame[1]
            );
        }
    }
}

#[test]
#[ignore = "needs a display"]
fn dragging_is_fluid() {
    let cornell = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes/cornell.toml");
    for source in ["bunny", "balls", &cornell.display().to_string()] {
        a_drag_is_fluid(source);
    }
}

#[test]
#[ignore = "needs a display and the reference data"]
fn dragging_the_dragon_is_fluid() {
    a_drag_is_fluid(&reference("meshes/dragon-202k.ply").display().to_string());
}

#[test]
#[ignore = "needs a display"]
fn drafts_are_as_coarse_as_their_time_asks_for() {
    let session = Session::new();
    let edges = ["5", "1000"].map(|target| {
        let script = format!("wait settled\n{DRAGS}print");
        let arguments = ["bunny", "--backend", "cpu", "--size", "1280x968", "--target-ms", target];
        let script = session.write("script.txt", &script);
        let mut command = session.command(&["view", "--script", &script]);
        // However many there are, two threads render no million pixels within 5 ms.
        command.args(arguments).env("RAYON_NUM_THREADS", "2");
        edge(&start(&mut command).finish_within(PATIENCE))
    });
    println!("edges of drafts within 5 ms and within 1000 ms: {edges:?}");
    assert!(edges[0] > 1 && edges[1] == 1, "{edges:?}");
}
