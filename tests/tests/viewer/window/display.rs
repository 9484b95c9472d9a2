//! The display server: its pointer, its keyboard and what it shows. Needs xdotool and ImageMagick.

use super::{Image, PATIENCE, agreement};
use std::io::Write;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

/// Moves that a drag is made of.
const MOVES: i32 = 10;

/// A display with a window on it.
pub struct Display {
    window: std::cell::RefCell<String>,
}

impl Display {
    pub fn new() -> Self {
        Display {
            window: std::cell::RefCell::default(),
        }
    }

    /// Waits for the program's window and gives it the keyboard.
    pub fn find_window(&self, name: &str) {
        *self.window.borrow_mut() = find(name);
        self.do_to_window("windowfocus");
        thread::sleep(Duration::from_millis(200));
    }

    /// Calls an xdotool command that takes a window.
    pub fn do_to_window(&self, command: &str) {
        xdotool(&[command, "--sync", &self.window.borrow()]);
    }

    pub fn resize(&self, size: [u32; 2]) {
        let window = self.window.borrow();
        xdotool(&["windowsize", &window, &size[0].to_string(), &size[1].to_string()]);
    }

    /// Presses a key and lets it go.
    pub fn key(&self, key: &str) {
        xdotool(&["key", key]);
    }

    /// Calls many xdotool commands, each on a line, without a pause between them.
    pub fn hurries(&self, commands: &str) {
        let mut file = tempfile::NamedTempFile::new().expect("a temporary file");
        file.write_all(commands.as_bytes()).expect("it is written");
        xdotool(&[&file.path().display().to_string()]);
    }

    /// Presses a key, or lets it go.
    pub fn presses(&self, key: &str, is_down: bool) {
        xdotool(&[if is_down { "keydown" } else { "keyup" }, key]);
    }

    /// The display's number of the window.
    pub fn id(&self) -> u32 {
        self.window.borrow().parse().expect("xdotool prints numbers")
    }

    /// Waits until the window's title has some words.
    pub fn has_title(&self, words: &str) {
        let start = Instant::now();
        loop {
            let title = xdotool(&["getwindowname", &self.window.borrow()]);
            if title.contains(words) {
                return;
            }
            assert!(start.elapsed() < PATIENCE, "{words:?} is not in {title:?}");
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// Holds a key down for so many milliseconds.
    pub fn hold(&self, key: &str, milliseconds: u64) {
        self.presses(key, true);
        thread::sleep(Duration::from_millis(milliseconds));
        self.presses(key, false);
    }

    /// Presses a button and lets it go; 4 is the wheel turned away from the person.
    pub fn click(&self, button: u32) {
        xdotool(&["click", &button.to_string()]);
    }

    /// Drags with a button from a place in the window.
    pub fn drag(&self, button: u32, by: [i32; 2]) {
        let window = self.window.borrow();
        let button = button.to_string();
        let go_to = |part: i32| {
            let at = by.map(|by| (200 + by * part / MOVES).to_string());
            xdotool(&["mousemove", "--window", &window, &at[0], &at[1]]);
        };
        go_to(0);
        xdotool(&["mousedown", &button]);
        for part in 1..=MOVES {
            go_to(part);
        }
        xdotool(&["mouseup", &button]);
        // The next press is no second click of this one.
        thread::sleep(Duration::from_millis(450));
    }

    /// Waits until the window shows a picture.
    pub fn shows(&self, what: &str, wanted: &Image) {
        let start = Instant::now();
        let mut best = 0.0;
        while start.elapsed() < PATIENCE / 4 {
            best = agreement(&capture(&self.window.borrow()), wanted);
            if best >= super::super::AGREE {
                println!("{what}: {:.3} % of the pixels agree", best * 100.0);
                return;
            }
            thread::sleep(Duration::from_millis(100));
        }
        panic!("{what}: only {best} of the pixels agree");
    }
}

/// What the display shows of the window with that name.
pub fn screen_of(name: &str) -> Image {
    capture(&find(name))
}

fn find(name: &str) -> String {
    let found = xdotool(&["search", "--sync", "--onlyvisible", "--name", name]);
    found.lines().next().expect("the window is there").into()
}

fn capture(window: &str) -> Image {
    let output = Command::new("import")
        .args(["-window", window, "png:-"])
        .output()
        .expect("ImageMagick is installed");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    image::load_from_memory(&output.stdout)
        .expect("ImageMagick writes PNG")
        .to_rgb8()
}

fn xdotool(arguments: &[&str]) -> String {
    let output = Command::new("xdotool")
        .args(arguments)
        .output()
        .expect("xdotool is installed");
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8_lossy(&output.stdout).into_owned()
}
