//! What the window says of its settings, for `oktant render`.

use crate::window::{Image, Session};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Values by the names that `set` has for them.
pub struct Settings(BTreeMap<String, String>);

/// What is no option of the command line, by the first word of its name.
const IN_THE_SCENE: [&str; 3] = ["light", "material", "environment"];
/// Options that only pictures have whose pixels get as many samples as they need.
const ADAPTIVE: [&str; 2] = ["error", "block"];

impl Settings {
    /// The settings among what was printed, the last ones, with the camera as it was copied last.
    pub fn read(text: &str) -> Self {
        let settings = text
            .lines()
            .filter_map(|line| line.strip_prefix("set ")?.rsplit_once(' '));
        let camera = text.lines().rfind(|line| line.starts_with("--azimuth="));
        let copied = camera.expect("it was copied").split(' ');
        let copied = copied.filter_map(|option| option.strip_prefix("--")?.split_once('='));
        let all = settings.chain(copied);
        Settings(all.map(|(name, value)| (name.into(), value.into())).collect())
    }

    /// What `oktant render` makes of a scene file that has no materials, lights and surroundings yet, in that size; in files of that name.
    pub fn rendered(&self, session: &Session, scene: &str, size: &str, name: &str) -> Image {
        let [scene_file, picture] = ["toml", "png"].map(|kind| format!("wanted-{name}.{kind}"));
        session.write(&scene_file, &(self.ambient() + scene + &self.staging()));
        let size = size.replace(' ', "x");
        let mut arguments: Vec<String> = ["render", &scene_file, "--size", &size, "-o", &picture]
            .map(String::from)
            .into();
        let is_adaptive = self
            .value("samples")
            .is_some_and(|samples| samples.starts_with("adaptive"));
        for (name, value) in &self.0 {
            let is_in_the_scene = IN_THE_SCENE.contains(&name.split(' ').next().unwrap_or_default());
            if !is_in_the_scene && (is_adaptive || !ADAPTIVE.contains(&name.as_str())) {
                arguments.push(format!("--{name}={value}"));
            }
        }
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        println!("oktant {}", arguments.join(" "));
        session.start_with(&arguments).finish();
        session.await_picture(&picture)
    }

    fn value(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(String::as_str)
    }

    /// All that begin with so many words, and what follows these in their names.
    fn of<'a>(&'a self, prefix: &'a str) -> impl Iterator<Item = (&'a str, &'a str)> {
        let all = self.0.iter();
        all.filter_map(move |(name, value)| Some((name.strip_prefix(prefix)?.strip_prefix(' ')?, value.as_str())))
    }

    fn ambient(&self) -> String {
        let ambient = self.value("environment ambient").expect("it was printed");
        let lights = if self.of("light 0").next().is_none() {
            "light = []\n"
        } else {
            ""
        };
        format!("ambient = [{ambient}]\n{lights}")
    }

    fn staging(&self) -> String {
        let mut text = String::new();
        let mut line = |line: String| writeln!(text, "{line}").expect("there is memory");
        for index in 0.. {
            let material = format!("material {index}");
            if self.of(&material).next().is_none() {
                break;
            }
            line(format!("[materials.m{index}]"));
            for (name, value) in self.of(&material) {
                line(format!("{name} = {}", toml(value)));
            }
        }
        for index in 0.. {
            let light = format!("light {index}");
            if self.of(&light).next().is_none() {
                break;
            }
            line("[[light]]".into());
            // Where the first one stands is said on the command line.
            if self.value(&format!("{light} position")).is_none() {
                line("position = [1, 1, 1]".into());
            }
            for (name, value) in self.of(&light) {
                if (name, value) != ("range", "0") {
                    line(format!("{name} = {}", toml(value)));
                }
            }
        }
        line("[environment]".into());
        for (name, value) in self.of("environment").filter(|(name, _)| *name != "ambient") {
            line(format!("{name} = {}", toml(value)));
        }
        text
    }
}

/// A value as scene files have it.
fn toml(value: &str) -> String {
    match value {
        "on" => "true".into(),
        "off" => "false".into(),
        _ if value.contains(',') => format!("[{value}]"),
        _ if value.starts_with(|first: char| first.is_ascii_alphabetic()) => format!("\"{value}\""),
        _ => value.into(),
    }
}
