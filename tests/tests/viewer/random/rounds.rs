//! What a hand does one after the other.

use super::files::{LARGE, LAST, MESHES, SMALL};
use super::hand::Hand;
use oktant_shared::parts::TraversalKind;

/// Inputs of a round.
const ROUND: usize = 50;
/// Closes the list of what was opened before, if it is open; something was.
pub const CLOSES_THE_LIST: &str = "recent 1";

/// What a round is about.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// All that can be set by name.
    Settings,
    /// Clicks on the panel, and files that are opened while others are.
    Panel,
    /// The GPU and the CPU in turn.
    Devices,
}

/// The order in which they take turns.
const KINDS: [Kind; 4] = [Kind::Settings, Kind::Panel, Kind::Settings, Kind::Devices];

impl Hand {
    /// A round of each kind, and the largest scenes.
    pub fn warms_up(&mut self) {
        self.settles();
        self.meets_kernels();
        for kind in KINDS {
            self.round(kind, ROUND / 2);
        }
        for step in ["set backend cpu", "panel off", "resize 160 120"] {
            self.does(step);
        }
        for name in LARGE {
            self.opens(name);
            self.settles();
        }
    }

    /// Has the first scene rendered by each kernel: what the driver makes of one it keeps.
    fn meets_kernels(&mut self) {
        self.does("resize 160 120");
        self.does("set backend gpu");
        for need in [
            "set traversal octants",
            "add light",
            "set material 0 mirror 0.5,0.5,0.5",
            "set material 0 transmission 0.5,0.5,0.5",
            "set traversal octree",
        ] {
            self.does(need);
            for samples in ["1", "adaptive:4"] {
                self.does(format!("set samples {samples}"));
                self.settles();
            }
        }
        self.does("set backend cpu");
        self.does("set traversal octants");
    }

    /// The next round; kinds take turns.
    pub fn next_round(&mut self) {
        self.round(KINDS[self.rounds % KINDS.len()], ROUND);
        self.rounds += 1;
    }

    /// A last scene with random settings, which stay, on the CPU, with as many samples as pixels need; no flight, nothing pinned, no
    /// list on top.
    pub fn last_round(&mut self) {
        self.does(CLOSES_THE_LIST);
        self.opens(LAST);
        self.settles();
        for _ in 0..ROUND {
            match self.random.u32(0..10) {
                0 => self.drags(),
                1 => self.wheels(),
                2 => self.keys(),
                3 => self.parts(),
                4 | 5 => self.stands(),
                _ => self.sets(),
            }
        }
        // In a file both eyes stand side by side, where the window shows them in turn.
        match self.one(&["none", "anaglyph", "rows", "side-by-side", "parallel"]) {
            "none" => self.does("set stereo none"),
            "parallel" => self.sees_parallel(),
            mode => self.parts_eyes(mode),
        }
        self.does("fly up 0.125");
        self.does("key Esc");
        self.does("set traversal octants");
        let [width, height] = [(); 2].map(|()| self.random.u32(40..120) * 2);
        self.does(format!("resize {width} {height}"));
        // There is something to see, wherever the flights led.
        self.does("key F");
        let [right, down] = [(); 2].map(|()| self.random.i32(-20..=20));
        self.does(format!("drag middle {right} {down}"));
        self.does("set backend cpu");
        for (name, value) in [
            ("samples", self.one(&["adaptive:4", "adaptive:16"]).into()),
            ("error", self.number(0.001, 0.1)),
            ("block", self.one(&["1", "2", "4", "8"]).into()),
        ] {
            self.does(format!("set {name} {value}"));
        }
        self.shows_the_picture();
    }

    /// The same on a GPU, with as many samples everywhere as a software one can take in the time that a step has.
    pub fn last_round_on_the_gpu(&mut self) {
        self.does("set samples 4");
        self.does("set backend gpu");
        self.shows_the_picture();
    }

    /// Waits until nothing but the picture is to be seen, but what keys may have turned on.
    fn shows_the_picture(&mut self) {
        self.waits("show picture");
        self.settles();
        // Warnings go after eight seconds.
        self.waits("wait milliseconds 8500");
    }

    fn round(&mut self, kind: Kind, inputs: usize) {
        for step in ["panel off", "oracle off", "set samples 1", "set traversal octants"] {
            self.does(step);
        }
        self.traversal = TraversalKind::Octants;
        if kind != Kind::Devices {
            // Before the file: a software GPU takes minutes over large ones, and hundreds of MiB.
            self.does("set backend cpu");
        }
        self.does(CLOSES_THE_LIST);
        let is_large = kind == Kind::Settings && self.random.u32(0..4) == 0;
        let name = if is_large { self.one(&LARGE) } else { self.one(&SMALL) };
        self.opens(name);
        match kind {
            Kind::Settings => {}
            Kind::Devices => {
                self.does("resize 160 120");
                self.does("set backend gpu");
            }
            Kind::Panel => {
                self.does("resize 520 400");
                self.does("panel on");
            }
        }
        self.waits("wait settled");
        let end = self.inputs + inputs;
        while self.inputs < end {
            match (self.random.u32(0..24), kind) {
                (0..4, _) => self.drags(),
                (4, _) => self.wheels(),
                (5..8, _) => self.keys(),
                (8, _) => self.drops(),
                (9, _) => self.points(),
                (10, _) => self.comes_and_goes(),
                (11..14, _) => self.stands(),
                (14, Kind::Panel) => self.opens_anything(),
                (15, Kind::Settings | Kind::Panel) => self.saves(),
                (16.., Kind::Panel) => self.clicks(),
                (14, _) => self.opens_something(),
                (15 | 16, Kind::Devices) => self.does("key B"),
                (16, Kind::Settings) => self.parts(),
                (17, _) => self.leaves(),
                (18.., _) => self.sets(),
            }
        }
    }

    /// Files that can be opened, one after the other.
    fn opens_something(&mut self) {
        // What is dropped before is refused, or is what is added to.
        self.settles();
        self.does("set samples 1");
        match self.random.u32(0..4) {
            0 => self.opens_again(),
            1 => {
                let name = self.one(&SMALL);
                self.opens(name);
            }
            _ => {
                let name = self.one(&MESHES);
                self.adds(name);
            }
        }
        self.settles();
    }

    /// Files that are opened whatever else is being opened; what is shown then nobody knows.
    fn opens_anything(&mut self) {
        match self.random.u32(0..5) {
            0 => {
                let name = self.one(&SMALL);
                self.does(format!("open \"{name}\""));
            }
            1 => {
                let [one, other] = [(); 2].map(|()| self.one(&MESHES));
                self.does(format!("open \"{one}\" \"{other}\""));
            }
            2 => {
                let name = self.one(&MESHES);
                self.does(format!("add mesh \"{name}\""));
            }
            3 => self.does("recent 1"),
            _ => {
                self.does("key Ctrl+R");
                let digit = self.random.u32(0..10);
                self.does(format!("key {digit}"));
            }
        }
    }
}
