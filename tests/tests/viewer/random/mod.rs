//! A thousand random inputs: nothing panics, nothing leaks, and what is shown and saved at last is what `oktant render` makes
//! of all that was set, on the CPU and on a GPU.
//!
//! `OKTANT_SEED` names other inputs. The GPU renders now and then, and at last. The window has no way to close a mesh: it is closed
//! where another is opened.

mod changes;
mod files;
mod gestures;
mod hand;
mod looks;
mod rounds;
mod settings;

use super::window::{Report, Running, Session, start};
use files::FIRST;
use hand::Hand;
use looks::Look;
use rounds::CLOSES_THE_LIST;
use std::thread;
use std::time::{Duration, Instant};

/// Inputs between the two looks at the memory.
const INPUTS: usize = 1000;
/// Memory may grow by this part.
const GROWTH: f64 = 0.1;
/// The most that all of it may take.
const PATIENCE: Duration = Duration::from_secs(400);
/// So long the window waits where somebody looks at its memory.
const LOOK: Duration = Duration::from_secs(3);

/// The seed that `OKTANT_SEED` names, else one that is the same every time.
fn seed() -> u64 {
    let seed = std::env::var("OKTANT_SEED").ok();
    seed.map_or(1, |seed| seed.parse().expect("OKTANT_SEED is a whole number"))
}

/// The first scene again, in a small window with nothing else in it, and time to look at the memory.
fn rests(picture: &str) -> String {
    format!(
        "panel off
        oracle off
        show picture
        unpin
        set backend cpu
        {CLOSES_THE_LIST}
        open {FIRST}
        resize 160 120
        set samples 1
        set stereo none
        set traversal octants
        wait settled
        screenshot {picture}
        wait milliseconds {}
        ",
        LOOK.as_millis()
    )
}

/// Resident memory at the moment at which the window has rested, bytes.
fn memory(window: &mut Running, session: &Session, picture: &str) -> u64 {
    let start = Instant::now();
    while !session.folder().join(picture).exists() {
        assert!(!window.has_ended(), "{}", window.wait());
        assert!(start.elapsed() < PATIENCE, "{picture} was not written");
        thread::sleep(Duration::from_millis(20));
    }
    // What was shown before is given back by a thread of its own.
    let looks = (0..10).map(|_| {
        thread::sleep(LOOK / 20);
        window.resident_memory()
    });
    let memory = looks.min().expect("there are ten");
    println!(
        "{picture}: {:.1} MiB resident after {:.1} s",
        memory as f64 / f64::from(1 << 20),
        start.elapsed().as_secs_f64()
    );
    memory
}

#[test]
#[ignore = "needs a display and a Vulkan driver"]
fn a_thousand_random_inputs() {
    let seed = seed();
    println!("OKTANT_SEED={seed}");
    let session = Session::new();
    files::write(&session);
    let mut hand = Hand::new(seed, session.folder());
    // Everything is used once before anything is compared with it: what opens the GPU stays open.
    hand.warms_up();
    hand.script += &rests("before.png");
    let warm = hand.inputs;
    while hand.inputs < warm + INPUTS {
        hand.next_round();
    }
    hand.script += &rests("after.png");
    hand.last_round();
    hand.script += &Look::Cpu.steps();
    hand.last_round_on_the_gpu();
    hand.script += &Look::Gpu.steps();
    hand.script += "resize 320 200
        key C
        pin 20 30
        key Esc
        print settings
        key Esc
        print settings";
    session.write("script.txt", &hand.script);
    let mut command = session.command(&["view", FIRST, "--backend", "cpu", "--size", "160x120"]);
    command.args(["--script", "script.txt"]);
    // Nobody is there to close a file dialog.
    command
        .env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent")
        .env("PATH", session.folder());
    // What is freed goes back to the system at once: glibc keeps tens of MiB for each of its arenas else, which is no leak.
    command
        .env("MALLOC_ARENA_MAX", "2")
        .env("MALLOC_MMAP_THRESHOLD_", "131072")
        .env("MALLOC_TRIM_THRESHOLD_", "131072");
    let mut window = start(&mut command);
    let before = memory(&mut window, &session, "before.png");
    let after = memory(&mut window, &session, "after.png");
    let report = window.finish_within(PATIENCE);
    println!("{} inputs, {} of them before the first look", hand.inputs, warm);
    assert_nothing_went_wrong(&report);
    assert!(
        after as f64 <= before as f64 * (1.0 + GROWTH),
        "seed {seed}: {before} bytes were resident and {after} are: something is not given back"
    );
    for look in [Look::Cpu, Look::Gpu] {
        look.compare(&session, &report, seed);
    }
}

/// Refusals are sentences, and the window went on to its end.
fn assert_nothing_went_wrong(report: &Report) {
    for line in report.standard_error.lines() {
        assert!(
            !line.contains("panicked") && !line.contains("mistake in oktant"),
            "{line}\n{report}"
        );
    }
    assert_eq!(
        report.standard_output.matches("set backend ").count(),
        3,
        "the second Esc closes the window, not the first: {report}"
    );
}
