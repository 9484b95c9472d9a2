//! The words of a script's lines. docs/viewer.md describes them.

use super::adjustment::{Adjustment, NamedMaterial};
use super::bearing::Bearing;
use super::event::{Button, Key, Modifiers};
use super::input::Input;
use super::session::PLACES;
use super::step::{Expectation, Step};
use super::written_camera::Form;
use crate::insight::Aspect;
use crate::nearest::nearest;
use crate::output::Format;
use glam::Vec3;
use std::path::PathBuf;

const STEPS: [&str; 31] = [
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
    "recent",
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
    "lose",
    "print",
    "camera",
    "stand",
    "fly",
    "view",
    "wait",
    "expect",
    "quit",
];
const DRAGS: [&str; 4] = ["left", "right", "middle", "shift+left"];
const WAITS: [&str; 5] = ["settled", "frames", "samples", "reloaded", "milliseconds"];
const EXPECTATIONS: [&str; 4] = ["first-picture", "backend", "triangles", "message"];
const HEADINGS: [(&str, Vec3); 6] = [
    ("forward", Vec3::Z),
    ("backward", Vec3::NEG_Z),
    ("left", Vec3::NEG_X),
    ("right", Vec3::X),
    ("up", Vec3::Y),
    ("down", Vec3::NEG_Y),
];
/// The keys that mean something; of digits the first one and the last.
pub const KEYS: [&str; 60] = [
    "F",
    "R",
    "W",
    "A",
    "S",
    "D",
    "Q",
    "E",
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
    "Ctrl+Keypad3",
    "Ctrl+Keypad7",
    "Shift+P",
    "J",
    "K",
    "1",
    "9",
    "Ctrl+1",
    "Ctrl+9",
    "Ctrl+C",
    "Ctrl+Shift+C",
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
    "B",
    "H",
    "?",
    "I",
    "O",
    "V",
    "Shift+V",
    "C",
    ">",
    "<",
    "Ctrl+S",
    "Ctrl+O",
    "Ctrl+Shift+O",
    "Ctrl+R",
    "Tab",
    "/",
    "Esc",
    "Escape",
];

/// The first word of a text, and the rest of it.
pub fn split(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim())
}

/// The first name of a text, in quotes where it has spaces, and the rest of it.
pub fn name(text: &str) -> Result<(&str, &str), String> {
    let Some(quoted) = text.strip_prefix('"') else {
        return Ok(split(text));
    };
    let (name, rest) = quoted
        .split_once('"')
        .ok_or("a quote is missing at the end of the last name")?;
    Ok((name, rest.trim()))
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
        "open" => Step::Open(paths(word, rest)?),
        "recent" => match count(word, rest)? {
            0 => return Err("give the place in the list of recent files, from 1 on, for example: recent 1".into()),
            place => Step::Ask(Input::Recent(place as usize - 1)),
        },
        "save" => Step::Save(picture(word, rest)?),
        "screenshot" => Step::Screenshot(picture(word, rest)?),
        "oracle" => Step::Oracle(on_or_off(rest, "state of the oracle")?),
        "panel" => Step::Panel(on_or_off(rest, "state of the panel")?),
        "show" => Step::Show(shown(rest)?),
        "move" => Step::Move(place(word, rest)?),
        "pin" => Step::Pin(place(word, rest)?),
        "set" => match NamedMaterial::parse(rest)? {
            Some(material) => Step::SetMaterial(material),
            None => Step::Ask(Input::Adjust(Adjustment::parse(rest)?)),
        },
        "add" => match split(rest) {
            ("light", "") => Step::Ask(Input::AddLight),
            ("mesh", files) => Step::Ask(Input::Add(paths("add mesh", files)?)),
            (_, _) => return Err(unknown(rest, "thing to add", &["light", "mesh"])),
        },
        "remove" => match split(rest) {
            ("light", number) => Step::Ask(Input::RemoveLight(count("remove light", number)? as usize)),
            (what, _) => return Err(unknown(what, "thing to remove", &["light"])),
        },
        "lose" => match rest {
            "device" => Step::LoseDevice,
            _ => return Err(unknown(rest, "thing to lose", &["device"])),
        },
        "camera" => match rest {
            "arguments" => Step::PrintCamera(Form::Arguments),
            "table" => Step::PrintCamera(Form::Table),
            _ => return Err(unknown(rest, "form of a camera", &["arguments", "table"])),
        },
        "stand" => Step::Ask(Input::Stand(Bearing::parse(rest)?)),
        "fly" => fly(rest)?,
        "view" => view(rest)?,
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
    let mut modifiers = Modifiers::default();
    let mut rest = lower.as_str();
    loop {
        if let Some(("ctrl", key)) = rest.split_once('+') {
            (modifiers.control, rest) = (true, key);
        } else if let Some(("shift", key)) = rest.split_once('+') {
            (modifiers.shift, rest) = (true, key);
        } else {
            break;
        }
    }
    let mut characters = rest.chars();
    let key = match (rest, characters.next(), characters.next()) {
        ("esc" | "escape", ..) => Key::Escape,
        ("tab", ..) => Key::Tab,
        (_, Some(character), None) => Key::Character(character),
        _ => match rest.strip_prefix("keypad").map(str::as_bytes) {
            Some([digit @ b'1'..=b'9']) => Key::Keypad(char::from(*digit)),
            _ => return Err(unknown(name, "key", &KEYS)),
        },
    };
    // Alone any key can be pressed.
    let is_known = modifiers == Modifiers::default()
        || KEYS.iter().any(|known| known.eq_ignore_ascii_case(&lower))
        || matches!((key, modifiers.shift), (Key::Character('1'..='9'), false));
    if !is_known {
        return Err(unknown(name, "key", &KEYS));
    }
    Ok(Step::Key { key, modifiers })
}

fn fly(rest: &str) -> Result<Step, String> {
    let (word, time) = split(rest);
    let Some((_, heading)) = HEADINGS.iter().find(|(name, _)| *name == word) else {
        return Err(unknown(word, "way to fly", &HEADINGS.map(|(name, _)| name)));
    };
    match numbers::<f32>(time)?.as_slice() {
        [time @ 0.0..=1e4] => Ok(Step::Ask(Input::Fly {
            heading: *heading,
            time: *time,
            is_fast: false,
        })),
        _ => Err("give the seconds that it takes, for example: fly forward 1.5".into()),
    }
}

fn view(rest: &str) -> Result<Step, String> {
    let (word, number) = split(rest);
    let input = match word {
        "save" => Input::SaveView,
        "recall" => Input::RecallView,
        _ => return Err(unknown(word, "thing to do with a view", &["save", "recall"])),
    };
    match numbers::<usize>(number)?.as_slice() {
        [number @ 1..=PLACES] => Ok(Step::Ask(input(*number))),
        _ => Err(format!("give a number from 1 to {PLACES}, for example: view {word} 1")),
    }
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

/// The file of a picture. The window knows what a screen shows, which PNG files hold.
fn picture(step: &str, rest: &str) -> Result<PathBuf, String> {
    if rest.is_empty() {
        return Err(format!("give a file, for example: {step} picture.png"));
    }
    let path = PathBuf::from(rest);
    match Format::new(&path, None) {
        Ok(Format::Png(_)) => Ok(path),
        _ => Err(format!(
            "pictures of the window are PNG files: give {rest} a name that ends in .png"
        )),
    }
}

/// Any number of files, but one; a name with spaces stands in quotes.
fn paths(step: &str, rest: &str) -> Result<Vec<PathBuf>, String> {
    let mut paths = Vec::new();
    let mut rest = rest.trim_start();
    while !rest.is_empty() {
        let (path, others) = name(rest)?;
        if !path.is_empty() {
            paths.push(PathBuf::from(path));
        }
        rest = others;
    }
    if paths.is_empty() {
        return Err(format!("give files, for example: {step} part.ply \"other part.stl\""));
    }
    Ok(paths)
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

    #[test]
    fn pictures_of_the_window_are_png_files() {
        assert_eq!(
            step("save my folder/a.b.PNG"),
            Ok(Step::Save("my folder/a.b.PNG".into()))
        );
        assert_eq!(step("screenshot a.png"), Ok(Step::Screenshot("a.png".into())));
        for word in ["save", "screenshot"] {
            for name in ["a.exr", "a.jpg", "a", ".png", "a.png.txt"] {
                let refused = format!("pictures of the window are PNG files: give {name} a name that ends in .png");
                assert_eq!(step(&format!("{word} {name}")), Err(refused));
            }
        }
    }
}
