//! Sessions written down: a step a line. docs/viewer.md describes the format.

use super::grammar::step;
use super::step::Step;
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

#[cfg(test)]
mod tests {
    use super::super::adjustment::{Adjustment, NamedMaterial};
    use super::super::bearing::Bearing;
    use super::super::event::{Button, Key, Modifiers};
    use super::super::input::Input;
    use super::super::step::Expectation;
    use super::super::written_camera::Form;
    use super::*;
    use crate::insight::Aspect;
    use glam::Vec3;

    fn steps(text: &str) -> Vec<Step> {
        let script = Script::parse(text, "test").unwrap();
        script.steps.into_iter().map(|(_, step)| step).collect()
    }

    fn error(text: &str) -> String {
        Script::parse(text, "test").unwrap_err().to_string()
    }

    #[test]
    fn all_steps() {
        let text = r#"
            # a comment
            drag left 100 -50
            drag shift+left 1 2.5
            click 620 40.5
            double-click
            wheel -1.5
            key F
            key Ctrl+S
            key ?
            key Esc
            key Tab
            key Ctrl+Shift+C
            key ctrl+7
            key Shift+x
            key Keypad5
            key +
            resize 800 600
            minimise
            restore
            open a.ply "my meshes/a b.ply" c.stl
            recent 2
            add mesh d.ply
            save out.png
            screenshot shot.png
            oracle on
            oracle off
            panel on
            show leaf-depth
            show picture
            move 3 4.5
            pin 320 240
            unpin
            set samples adaptive:16
            set material "old wood" mirror 0.5
            add light
            remove light 1
            pick 3 4
            lose device
            print
            camera arguments
            camera table
            stand -y
            fly left 1.5
            view save 1
            view recall 9
            print settings
            wait settled
            wait frames 3
            wait samples 20
            wait reloaded
            wait milliseconds 250
            expect first-picture 1000
            expect backend gpu
            expect triangles 69451
            expect message no such file
            quit
        "#;
        let drag = |shift, right, down| Step::Drag {
            button: Button::Left,
            shift,
            right,
            down,
        };
        let held = |shift, control| Modifiers { shift, control };
        let key = |key, control| Step::Key {
            key,
            modifiers: held(false, control),
        };
        assert_eq!(
            steps(text),
            [
                drag(false, 100.0, -50.0),
                drag(true, 1.0, 2.5),
                Step::Click([620.0, 40.5]),
                Step::DoubleClick,
                Step::Wheel(-1.5),
                key(Key::Character('f'), false),
                key(Key::Character('s'), true),
                key(Key::Character('?'), false),
                key(Key::Escape, false),
                key(Key::Tab, false),
                Step::Key {
                    key: Key::Character('c'),
                    modifiers: held(true, true),
                },
                key(Key::Character('7'), true),
                Step::Key {
                    key: Key::Character('x'),
                    modifiers: held(true, false),
                },
                key(Key::Keypad('5'), false),
                key(Key::Character('+'), false),
                Step::Resize([800, 600]),
                Step::Minimise,
                Step::Restore,
                Step::Open(["a.ply", "my meshes/a b.ply", "c.stl"].map(PathBuf::from).to_vec()),
                Step::Ask(Input::Recent(1)),
                Step::Ask(Input::Add(vec!["d.ply".into()])),
                Step::Save("out.png".into()),
                Step::Screenshot("shot.png".into()),
                Step::Oracle(true),
                Step::Oracle(false),
                Step::Panel(true),
                Step::Show(Some(Aspect::LeafDepth)),
                Step::Show(None),
                Step::Move([3.0, 4.5]),
                Step::Pin([320.0, 240.0]),
                Step::Unpin,
                Step::Ask(Input::Adjust(Adjustment::parse("samples adaptive:16").unwrap())),
                Step::SetMaterial(
                    NamedMaterial::parse("material \"old wood\" mirror 0.5")
                        .unwrap()
                        .unwrap()
                ),
                Step::Ask(Input::AddLight),
                Step::Ask(Input::RemoveLight(1)),
                Step::Ask(Input::Pick([3.0, 4.0])),
                Step::LoseDevice,
                Step::Print,
                Step::PrintCamera(Form::Arguments),
                Step::PrintCamera(Form::Table),
                Step::Ask(Input::Stand(Bearing::parse("-y").unwrap())),
                Step::Ask(Input::Fly {
                    heading: Vec3::NEG_X,
                    time: 1.5,
                    is_fast: false,
                }),
                Step::Ask(Input::SaveView(1)),
                Step::Ask(Input::RecallView(9)),
                Step::PrintSettings,
                Step::WaitSettled,
                Step::WaitFrames(3),
                Step::WaitSamples(20),
                Step::WaitReloaded,
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
    fn errors_name_the_line_and_the_word_that_was_meant() {
        assert_eq!(
            error("print\n\ndarg left 1 2"),
            "test, line 3: \"darg\" is no step; did you mean \"drag\"."
        );
        assert!(error("drag lefft 1 2").contains("did you mean \"left\""));
        assert!(error("wait setled").contains("did you mean \"settled\""));
        assert!(error("expect bakend gpu").contains("did you mean \"backend\""));
        assert!(error("key Ctrl+Sh").contains("\"Ctrl+S\""));
        assert!(error("zzzzzzz").contains("give one of drag, "));
        for bad in [
            "drag left 1",
            "drag left a b",
            "drag left 1e9 0",
            "drag",
            "wheel",
            "wheel nan",
            "click 10",
            "click -1 10",
            "click nan 10",
            "set",
            "set samples",
            "set samples 5",
            "set material 0 mirror 2",
            "set material wood mirror 2",
            "set material \"old wood mirror 0.5",
            "set light x color 1",
            "add",
            "add lights 2",
            "remove light",
            "remove 1",
            "pick 3",
            "set fov 180",
            "resize 0 10",
            "resize 10",
            "open",
            "open \"a b.ply",
            "open \"\"",
            "recent 0",
            "recent last",
            "add mesh",
            "save",
            "save a.exr",
            "screenshot a",
            "wait frames",
            "wait frames -1",
            "quit now",
            "oracle maybe",
            "panel",
            "show everything",
            "pin 3",
            "move -1 2",
            "unpin all",
            "key Ctrl+U",
            "key Shift+1",
            "key Keypad0",
            "camera",
            "stand x",
            "fly",
            "fly forward",
            "fly forward -1",
            "fly home 1",
            "view",
            "view save 0",
            "view recall 10",
            "print figures",
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
