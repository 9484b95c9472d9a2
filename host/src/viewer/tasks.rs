//! The tasks of docs/tasks.md: at most six inputs each, and each one is suggested by the window itself.

use super::caption::{self, Caption};
use super::event::{Button, Key, Modifiers};
use super::input::Input;
use super::script::Script;
use super::step::Step;
use std::path::Path;

/// Whether the list of keys has it.
fn is_listed(wanted: &str) -> bool {
    caption::help().iter().any(|line| {
        let keys = line.text.split("   ").next().unwrap_or_default();
        keys.split(", ").chain(keys.split([' ', ','])).any(|key| key == wanted)
    })
}

/// Whether the window's first lines, which are there from the beginning, name a key.
fn is_in_the_first_lines(key: &str) -> bool {
    let lines = caption::figures(&Caption::default());
    lines.iter().any(|line| line.text.contains(&format!("{key}: ")))
}

/// What the list of keys has to say for an input to be suggested by it; nothing for a click on the panel, none for what is no
/// input.
fn suggestion(step: &Step) -> Option<String> {
    Some(match step {
        Step::Drag {
            button, shift: false, ..
        } => match button {
            Button::Left => "left".into(),
            Button::Right => "right".into(),
            Button::Middle => "middle".into(),
        },
        Step::Wheel(_) => "wheel".into(),
        Step::Key {
            key: Key::Character('s'),
            modifiers: Modifiers {
                control: true,
                shift: false,
            },
        } => "Ctrl+S".into(),
        Step::Key {
            key: Key::Character(character),
            modifiers: Modifiers {
                control: false,
                shift: false,
            },
        } => character.to_uppercase().collect(),
        Step::Key { key: Key::Tab, .. } => "Tab".into(),
        Step::Key { key: Key::Escape, .. } => "Esc".into(),
        Step::Open(_) => "drop files".into(),
        Step::Pin(_) => "Ctrl+click".into(),
        Step::Ask(Input::Pick(_)) => "Ctrl+Shift".into(),
        Step::Click(_) => String::new(),
        Step::WaitSettled | Step::Screenshot(_) | Step::Print | Step::PrintSettings | Step::Expect(_) => return None,
        other => panic!("{other:?} is nothing that a hand does"),
    })
}

#[test]
fn six_tasks_of_at_most_six_inputs_that_the_window_suggests() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/tasks");
    let mut tasks = 0;
    for entry in std::fs::read_dir(&folder).expect("the scripts are there") {
        let path = entry.expect("it can be read to its end").path();
        if path.extension().is_none_or(|extension| extension != "txt") {
            continue;
        }
        tasks += 1;
        let script = Script::read(&path).expect("it is a script");
        let (mut inputs, mut has_list, mut has_panel) = (0, false, false);
        for (line, step) in &script.steps {
            let Some(wanted) = suggestion(step) else { continue };
            inputs += 1;
            let place = format!("{}, line {line}", path.display());
            if wanted.is_empty() {
                assert!(has_panel, "{place}: nothing is there to click on");
            } else {
                assert!(is_listed(&wanted), "{place}: {wanted} is not in the list of keys");
                assert!(
                    has_list || is_in_the_first_lines(&wanted),
                    "{place}: nobody has seen the list of keys, which has {wanted}"
                );
            }
            has_list |= wanted == "H";
            has_panel |= ["Tab", "Ctrl+Shift"].contains(&wanted.as_str());
        }
        assert!((1..=6).contains(&inputs), "{}: {inputs} inputs", path.display());
    }
    assert_eq!(tasks, 6);
}

#[test]
fn what_is_not_in_the_list_is_not_suggested() {
    for (wanted, is_there) in [
        ("V", true),
        ("+", true),
        ("Ctrl+S", true),
        ("N", false),
        ("keys", false),
        ("lef", false),
    ] {
        assert_eq!(is_listed(wanted), is_there, "{wanted}");
    }
    for (key, is_there) in [("H", true), ("Tab", true), ("V", false)] {
        assert_eq!(is_in_the_first_lines(key), is_there, "{key}");
    }
}
