//! What a hand does with pointer, keyboard and window.

use super::files::BAD;
use super::hand::Hand;

/// The keys that only look, or change the picture.
const KEYS: [&str; 46] = [
    "F",
    "R",
    "P",
    "M",
    "T",
    "+",
    "=",
    "-",
    ".",
    ",",
    "L",
    "[",
    "]",
    "H",
    "?",
    "I",
    "O",
    "V",
    "Shift+V",
    "C",
    ">",
    "<",
    "W",
    "A",
    "S",
    "D",
    "E",
    "Q",
    "G",
    "X",
    "Y",
    "Z",
    "Shift+X",
    "Shift+Y",
    "Shift+Z",
    "Keypad1",
    "Keypad3",
    "Keypad5",
    "Keypad7",
    "Ctrl+Keypad1",
    "Shift+P",
    "J",
    "K",
    "Ctrl+C",
    "Ctrl+Shift+C",
    "0",
];
/// Where a flight may lead.
const WAYS: [&str; 6] = ["forward", "backward", "left", "right", "up", "down"];
/// Where a camera may stand.
const SIDES: [&str; 12] = [
    "front", "back", "right", "left", "top", "bottom", "+x", "-x", "+y", "-y", "+z", "-z",
];
/// Numbers of saved views: few, so that they are found again.
const VIEWS: [&str; 3] = ["1", "5", "9"];

impl Hand {
    pub(super) fn drags(&mut self) {
        let button = self.one(&["left", "right", "middle", "shift+left"]);
        let [right, down] = [(); 2].map(|()| self.random.i32(-300..=300));
        self.does(format!("drag {button} {right} {down}"));
    }

    pub(super) fn wheels(&mut self) {
        let notches = self.random.i32(-4..=4);
        self.does(format!("wheel {notches}"));
    }

    pub(super) fn keys(&mut self) {
        let key = self.one(&KEYS);
        self.does(format!("key {key}"));
    }

    /// Puts the camera elsewhere at once, or remembers where it is.
    pub(super) fn stands(&mut self) {
        let step = match self.random.u32(0..6) {
            0 => format!("fly {} {}", self.one(&WAYS), self.number(0.0, 1.5)),
            1 => format!("stand {}", self.one(&SIDES)),
            2 => format!("view save {}", self.one(&VIEWS)),
            3 => format!("key Ctrl+{}", self.one(&VIEWS)),
            // Not by a step: where nothing was saved, or two eyes look, that is refused.
            4 => format!("key {}", self.one(&VIEWS)),
            _ => format!("camera {}", self.one(&["arguments", "table"])),
        };
        self.does(step);
    }

    /// Undoes something, where there is something to be undone: else the window would close.
    pub(super) fn leaves(&mut self) {
        match self.random.u32(0..3) {
            0 => self.does("key Ctrl+R"),
            1 => self.does("fly right 0.1"),
            _ => self.does("pin 10 10"),
        }
        self.does("key Esc");
    }

    /// A file that is refused, alone or beside what is shown.
    pub(super) fn drops(&mut self) {
        let step = self.one(&["open", "add mesh"]);
        let name = self.one(&BAD);
        self.does(format!("{step} {name}"));
    }

    pub(super) fn points(&mut self) {
        let [x, y] = [(); 2].map(|()| self.random.u32(0..700));
        match self.random.u32(0..4) {
            0 => self.does(format!("pin {x} {y}")),
            1 => self.does("unpin"),
            2 => self.does("double-click"),
            _ => self.does(format!("move {x} {y}")),
        }
    }

    pub(super) fn comes_and_goes(&mut self) {
        if self.random.bool() {
            self.does("minimise");
            self.drags();
            self.does("restore");
        } else {
            let size = match self.random.u32(0..8) {
                0 => [1, 1],
                1 => [700, 8],
                2 => [8, 500],
                _ => [(); 2].map(|()| self.random.u32(30..260)),
            };
            self.does(format!("resize {} {}", size[0], size[1]));
        }
    }

    /// Takes few samples first, lest it last.
    pub(super) fn saves(&mut self) {
        if self.random.u32(0..3) == 0 {
            self.does("set samples 1");
            self.does("key Ctrl+S");
        }
    }

    pub(super) fn clicks(&mut self) {
        let [x, y] = [self.random.u32(0..520), self.random.u32(0..400)];
        match self.random.u32(0..12) {
            0 => self.does(format!("pick {x} {y}")),
            1 => self.does("key Tab"),
            2 => {
                let digit = self.random.u32(0..10);
                self.does(format!("key {digit}"));
            }
            3 => {
                self.does(format!("move {x} {y}"));
                self.wheels();
            }
            4 => {
                let key = self.one(&["Ctrl+O", "Ctrl+Shift+O", "Ctrl+R"]);
                self.does(format!("key {key}"));
            }
            _ => self.does(format!("click {x} {y}")),
        }
    }
}
