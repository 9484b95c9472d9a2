//! Sessions written down: a step a line. docs/viewer.md describes the format.

use super::event::{Button, Key};
use super::nearest::nearest;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A session for the window to play.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// The file it came from, for messages.
    pub file: String,
    /// The steps, each with its line counted from 1.
    pub steps: Vec<(usize, Step)>,
}

/// A step of a script.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Drag from the window's middle.
    Drag {
        /// The button held down.
        button: Button,
        /// Whether Shift is, too.
        shift: bool,
        /// Pixels to the right.
        right: f64,
        /// Pixels downwards.
        down: f64,
    },
    /// Double click with the left button.
    DoubleClick,
    /// Turn the wheel by so many notches.
    Wheel(f32),
    /// Press a key.
    Key {
        /// Which.
        key: Key,
        /// Whether Ctrl is held down.
        control: bool,
    },
    /// Give the window's inside a size.
    Resize([u32; 2]),
    /// Minimise the window.
    Minimise,
    /// Restore the minimised window.
    Restore,
    /// Drop a file on the window.
    Open(PathBuf),
    /// Save the picture and wait until it is written.
    Save(PathBuf),
    /// Save what the window shows, overlay and all.
    Screenshot(PathBuf),
    /// Print the figures.
    Print,
    /// Wait until nothing changes any more.
    WaitSettled,
    /// Wait until so many new pictures were shown.
    WaitFrames(u64),
    /// Wait so many milliseconds.
    WaitMilliseconds(u64),
    /// Fail if something is not so.
    Expect(Expectation),
    /// Close the window.
    Quit,
}

/// What a script can insist on.
#[derive(Clone, Debug, PartialEq)]
pub enum Expectation {
    /// The first picture was there within so many milliseconds.
    FirstPicture(u64),
    /// The shown picture was rendered by a GPU, or by the CPU.
    Gpu(bool),
    /// The mesh has so many triangles.
    Triangles(usize),
    /// The overlay's message contains this.
    Message(String),
}

/// Why a script cannot be played.
#[derive(Debug, thiserror::Error)]
pub enum ScriptError {
    /// The file cannot be read.
    #[error("The script {} cannot be read ({source}); check the path.", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A line makes no sense.
    #[error("{file}, line {line}: {reason}.")]
    Line {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it and what to do.
        reason: String,
    },
}

const STEPS: [&str; 14] = [
    "drag",
    "double-click",
    "wheel",
    "key",
    "resize",
    "minimise",
    "restore",
    "open",
    "save",
    "screenshot",
    "print",
    "wait",
    "expect",
    "quit",
];
const DRAGS: [&str; 4] = ["left", "right", "middle", "shift+left"];
const WAITS: [&str; 3] = ["settled", "frames", "milliseconds"];
const EXPECTATIONS: [&str; 4] = ["first-picture", "backend", "triangles", "message"];
const KEYS: [&str; 11] = ["F", "R", "P", "M", "B", "H", "?", "I", "Ctrl+S", "Esc", "Escape"];

impl Script {
    /// Reads a script.
    ///
    /// # Errors
    /// [`ScriptError`] where it cannot be read or a line is no step.
    pub fn read(path: &Path) -> Result<Self, ScriptError> {
        let text = fs::read_to_string(path).map_err(|source| ScriptError::Read {
            path: path.to_path_buf(),
            source,
        })?;
        Self::parse(&text, &path.display().to_string())
    }

    /// Takes a script apart; `file` is what messages call it.
    ///
    /// # Errors
    /// [`ScriptError::Line`].
    pub fn parse(text: &str, file: &str) -> Result<Self, ScriptError> {
        let mut steps = Vec::new();
        for (line, number) in text.lines().zip(1..) {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let step = step(line).map_err(|reason| ScriptError::Line {
                file: file.into(),
                line: number,
                reason,
            })?;
            steps.push((number, step));
        }
        Ok(Script {
            file: file.into(),
            steps,
        })
    }
}

/// The first word of a text, and the rest of it.
fn split(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim())
}

fn step(line: &str) -> Result<Step, String> {
    let (word, rest) = split(line);
    Ok(match word {
        "drag" => drag(rest)?,
        "wheel" => match numbers::<f32>(rest)?.as_slice() {
            [notches] if notches.is_finite() => Step::Wheel(*notches),
            _ => return Err("give the notches of the wheel, for example: wheel 2".into()),
        },
        "key" => key(rest)?,
        "resize" => match numbers::<u32>(rest)?.as_slice() {
            [width @ 1..=32_768, height @ 1..=32_768] => Step::Resize([*width, *height]),
            _ => return Err("give width and height in pixels, for example: resize 800 600".into()),
        },
        "open" => Step::Open(path(word, rest)?),
        "save" => Step::Save(path(word, rest)?),
        "screenshot" => Step::Screenshot(path(word, rest)?),
        "wait" => wait(rest)?,
        "expect" => Step::Expect(expectation(rest)?),
        "double-click" => alone(word, rest, Step::DoubleClick)?,
        "minimise" => alone(word, rest, Step::Minimise)?,
        "restore" => alone(word, rest, Step::Restore)?,
        "print" => alone(word, rest, Step::Print)?,
        "quit" => alone(word, rest, Step::Quit)?,
        _ => return Err(unknown(word, "step", &STEPS)),
    })
}

fn drag(rest: &str) -> Result<Step, String> {
    let (word, rest) = split(rest);
    let (button, shift) = match word {
        "left" => (Button::Left, false),
        "right" => (Button::Right, false),
        "middle" => (Button::Middle, false),
        "shift+left" => (Button::Left, true),
        _ => return Err(unknown(word, "button", &DRAGS)),
    };
    match numbers::<f64>(rest)?.as_slice() {
        [right, down] if right.abs().max(down.abs()) <= 1e6 => Ok(Step::Drag {
            button,
            shift,
            right: *right,
            down: *down,
        }),
        _ => Err("give the pixels to the right and downwards, for example: drag left 100 -50".into()),
    }
}

fn key(name: &str) -> Result<Step, String> {
    let lower = name.to_lowercase();
    let (key, control) = match lower.as_str() {
        "esc" | "escape" => (Key::Escape, false),
        "ctrl+s" => (Key::Character('s'), true),
        _ => {
            let mut characters = lower.chars();
            match (characters.next(), characters.next()) {
                (Some(character), None) => (Key::Character(character), false),
                _ => return Err(unknown(name, "key", &KEYS)),
            }
        }
    };
    Ok(Step::Key { key, control })
}

fn wait(rest: &str) -> Result<Step, String> {
    let (word, rest) = split(rest);
    match word {
        "settled" => alone("wait settled", rest, Step::WaitSettled),
        "frames" => Ok(Step::WaitFrames(count("wait frames", rest)?)),
        "milliseconds" => Ok(Step::WaitMilliseconds(count("wait milliseconds", rest)?)),
        _ => Err(unknown(word, "thing to wait for", &WAITS)),
    }
}

fn expectation(rest: &str) -> Result<Expectation, String> {
    let (word, rest) = split(rest);
    match word {
        "first-picture" => Ok(Expectation::FirstPicture(count("expect first-picture", rest)?)),
        "backend" => match rest {
            "gpu" => Ok(Expectation::Gpu(true)),
            "cpu" => Ok(Expectation::Gpu(false)),
            _ => Err(unknown(rest, "back end", &["cpu", "gpu"])),
        },
        "triangles" => Ok(Expectation::Triangles(count("expect triangles", rest)? as usize)),
        "message" if !rest.is_empty() => Ok(Expectation::Message(rest.into())),
        "message" => Err("give a part of the message, for example: expect message no such file".into()),
        _ => Err(unknown(word, "expectation", &EXPECTATIONS)),
    }
}

fn count(step: &str, rest: &str) -> Result<u64, String> {
    match numbers::<u64>(rest)?.as_slice() {
        [count] => Ok(*count),
        _ => Err(format!("give one number, for example: {step} 10")),
    }
}

fn path(step: &str, rest: &str) -> Result<PathBuf, String> {
    if rest.is_empty() {
        return Err(format!("give a file, for example: {step} {}", example(step)));
    }
    Ok(PathBuf::from(rest))
}

fn example(step: &str) -> &'static str {
    if step == "open" { "mesh.ply" } else { "picture.png" }
}

fn alone(word: &str, rest: &str, step: Step) -> Result<Step, String> {
    if rest.is_empty() {
        Ok(step)
    } else {
        Err(format!("remove what stands after \"{word}\""))
    }
}

fn numbers<T: std::str::FromStr>(text: &str) -> Result<Vec<T>, String> {
    text.split_whitespace()
        .map(|word| {
            word.parse()
                .map_err(|_| format!("\"{word}\" is not a number that fits here"))
        })
        .collect()
}

fn unknown(word: &str, kind: &str, words: &[&str]) -> String {
    let valid = words.join(", ");
    if word.is_empty() {
        format!("give one of {valid}")
    } else if let Some(meant) = nearest(word, words) {
        format!("\"{word}\" is no {kind}; did you mean \"{meant}\"")
    } else {
        format!("\"{word}\" is no {kind}; give one of {valid}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(text: &str) -> Vec<Step> {
        let script = Script::parse(text, "test").unwrap();
        script.steps.into_iter().map(|(_, step)| step).collect()
    }

    fn error(text: &str) -> String {
        Script::parse(text, "test").unwrap_err().to_string()
    }

    #[test]
    fn all_steps() {
        let text = "
            # a comment
            drag left 100 -50
            drag shift+left 1 2.5
            double-click
            wheel -1.5
            key F
            key Ctrl+S
            key ?
            key Esc
            resize 800 600
            minimise
            restore
            open my meshes/a b.ply
            save out.png
            screenshot shot.png
            print
            wait settled
            wait frames 3
            wait milliseconds 250
            expect first-picture 1000
            expect backend gpu
            expect triangles 69451
            expect message no such file
            quit
        ";
        let drag = |shift, right, down| Step::Drag {
            button: Button::Left,
            shift,
            right,
            down,
        };
        let key = |key, control| Step::Key { key, control };
        assert_eq!(
            steps(text),
            [
                drag(false, 100.0, -50.0),
                drag(true, 1.0, 2.5),
                Step::DoubleClick,
                Step::Wheel(-1.5),
                key(Key::Character('f'), false),
                key(Key::Character('s'), true),
                key(Key::Character('?'), false),
                key(Key::Escape, false),
                Step::Resize([800, 600]),
                Step::Minimise,
                Step::Restore,
                Step::Open("my meshes/a b.ply".into()),
                Step::Save("out.png".into()),
                Step::Screenshot("shot.png".into()),
                Step::Print,
                Step::WaitSettled,
                Step::WaitFrames(3),
                Step::WaitMilliseconds(250),
                Step::Expect(Expectation::FirstPicture(1000)),
                Step::Expect(Expectation::Gpu(true)),
                Step::Expect(Expectation::Triangles(69_451)),
                Step::Expect(Expectation::Message("no such file".into())),
                Step::Quit,
            ]
        );
        assert!(steps("").is_empty());
    }

    #[test]
    fn every_word_leads_somewhere() {
        for word in STEPS {
            let error = step(word).err().unwrap_or_default();
            assert!(!error.contains("is no step"), "{word}: {error}");
        }
        for name in KEYS {
            assert!(key(name).is_ok(), "{name}");
        }
    }

    #[test]
    fn errors_name_the_line_and_the_word_that_was_meant() {
        assert_eq!(
            error("print\n\ndarg left 1 2"),
            "test, line 3: \"darg\" is no step; did you mean \"drag\"."
        );
        assert!(error("drag lefft 1 2").contains("did you mean \"left\""));
        assert!(error("wait setled").contains("did you mean \"settled\""));
        assert!(error("expect bakend gpu").contains("did you mean \"backend\""));
        assert!(error("key Ctrl+X").contains("\"Ctrl+S\""));
        assert!(error("zzzzzzz").contains("give one of drag, "));
        for bad in [
            "drag left 1",
            "drag left a b",
            "drag left 1e9 0",
            "drag",
            "wheel",
            "wheel nan",
            "resize 0 10",
            "resize 10",
            "open",
            "save",
            "wait frames",
            "wait frames -1",
            "quit now",
            "expect message",
            "expect backend tpu",
        ] {
            let error = error(bad);
            assert!(
                error.starts_with("test, line 1: ") && error.ends_with('.'),
                "{bad}: {error}"
            );
        }
    }

    #[test]
    fn a_missing_file() {
        let error = Script::read(Path::new("no/such/script")).unwrap_err().to_string();
        assert!(
            error.contains("no/such/script") && error.ends_with("check the path."),
            "{error}"
        );
    }
}
