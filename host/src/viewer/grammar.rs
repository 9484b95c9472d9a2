//! The words of a script's lines. docs/viewer.md describes them.

use super::adjustment::Adjustment;
use super::event::{Button, Key};
use super::input::Input;
use super::step::{Expectation, Step};
use crate::insight::Aspect;
use crate::nearest::nearest;
use std::path::PathBuf;

const STEPS: [&str; 25] = [
    "drag",
    "click",
    "pick",
    "double-click",
    "wheel",
    "key",
    "resize",
    "minimise",
    "restore",
    "open",
    "save",
    "screenshot",
    "oracle",
    "panel",
    "show",
    "move",
    "pin",
    "unpin",
    "set",
    "add",
    "remove",
    "print",
    "wait",
    "expect",
    "quit",
];
const DRAGS: [&str; 4] = ["left", "right", "middle", "shift+left"];
const WAITS: [&str; 5] = ["settled", "frames", "samples", "reloaded", "milliseconds"];
const EXPECTATIONS: [&str; 4] = ["first-picture", "backend", "triangles", "message"];
/// The keys that mean something.
pub const KEYS: [&str; 26] = [
    "F", "R", "P", "M", "T", "+", "=", "-", ".", ",", "3", "[", "]", "B", "H", "?", "I", "O", "V", "C", ">", "<",
    "Ctrl+S", "Tab", "Esc", "Escape",
];

/// The first word of a text, and the rest of it.
pub fn split(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim())
}

/// The step that a line describes; else what is wrong with it and what to do.
pub fn step(line: &str) -> Result<Step, String> {
    let (word, rest) = split(line);
    Ok(match word {
        "drag" => drag(rest)?,
        "click" => Step::Click(place(word, rest)?),
        "pick" => Step::Ask(Input::Pick(place(word, rest)?)),
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
        "oracle" => Step::Oracle(on_or_off(rest, "state of the oracle")?),
        "panel" => Step::Panel(on_or_off(rest, "state of the panel")?),
        "show" => Step::Show(shown(rest)?),
        "move" => Step::Move(place(word, rest)?),
        "pin" => Step::Pin(place(word, rest)?),
        "set" => Step::Ask(Input::Adjust(Adjustment::parse(rest)?)),
        "add" => match rest {
            "light" => Step::Ask(Input::AddLight),
            _ => return Err(unknown(rest, "thing to add", &["light"])),
        },
        "remove" => match split(rest) {
            ("light", number) => Step::Ask(Input::RemoveLight(count("remove light", number)? as usize)),
            (what, _) => return Err(unknown(what, "thing to remove", &["light"])),
        },
        "print" => match rest {
            "" => Step::Print,
            "settings" => Step::PrintSettings,
            _ => return Err(unknown(rest, "thing to print", &["settings"])),
        },
        "wait" => wait(rest)?,
        "expect" => Step::Expect(expectation(rest)?),
        "double-click" => alone(word, rest, Step::DoubleClick)?,
        "minimise" => alone(word, rest, Step::Minimise)?,
        "restore" => alone(word, rest, Step::Restore)?,
        "unpin" => alone(word, rest, Step::Unpin)?,
        "quit" => alone(word, rest, Step::Quit)?,
        _ => return Err(unknown(word, "step", &STEPS)),
    })
}

fn on_or_off(word: &str, kind: &str) -> Result<bool, String> {
    match word {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(unknown(word, kind, &["on", "off"])),
    }
}

/// A place in the window.
fn place(step: &str, rest: &str) -> Result<[f64; 2], String> {
    match numbers::<f64>(rest)?.as_slice() {
        [x @ 0.0..=32_768.0, y @ 0.0..=32_768.0] => Ok([*x, *y]),
        _ => Err(format!(
            "give a place in pixels from the upper left corner, for example: {step} 620 40"
        )),
    }
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

/// What pixels are to tell; nothing for the picture.
fn shown(name: &str) -> Result<Option<Aspect>, String> {
    let aspect = Aspect::ALL.into_iter().find(|aspect| aspect.name() == name);
    match (aspect, name) {
        (None, "picture") => Ok(None),
        (Some(aspect), _) => Ok(Some(aspect)),
        (None, _) => {
            let names: Vec<&str> = ["picture"].into_iter().chain(Aspect::ALL.map(Aspect::name)).collect();
            Err(unknown(name, "thing to show", &names))
        }
    }
}

fn key(name: &str) -> Result<Step, String> {
    let lower = name.to_lowercase();
    let (key, control) = match lower.as_str() {
        "esc" | "escape" => (Key::Escape, false),
        "tab" => (Key::Tab, false),
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
        "reloaded" => alone("wait reloaded", rest, Step::WaitReloaded),
        "frames" => Ok(Step::WaitFrames(count("wait frames", rest)?)),
        "samples" => Ok(Step::WaitSamples(count("wait samples", rest)?)),
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

/// What is wrong with a word that is none of some, and what to give.
pub fn unknown(word: &str, kind: &str, words: &[&str]) -> String {
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
}
