//! What a person prefers: a file and the environment, which complete the command line.
//!
//! Everything is derived from the definition of the command line: a setting is the long name of an option, and its value is
//! read by the option's own parser.

use super::Failure;
use super::arguments::{Arguments, Command, LookArguments, Size};
use clap::error::{ContextKind, ContextValue};
use clap::{Arg, CommandFactory, FromArgMatches};
use directories::ProjectDirs;
use oktant::preferences::Preferences;
use oktant::settings_file::{self, Unfit};
use oktant::view::View;
use std::collections::BTreeMap;
use std::error::Error;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The options that are the same from day to day; those about one scene or one picture are not.
const PREFERENCES: [&str; 20] = [
    "samples",
    "error",
    "block",
    "pattern",
    "filter",
    "shading",
    "depth",
    "cutoff",
    "fov",
    "up",
    "exposure",
    "tone",
    "size",
    "target-ms",
    "backend",
    "spirv",
    "traversal",
    "triangle",
    "box",
    "build",
];
/// The commands that they complete: those that measure or compare do the same everywhere.
const COMMANDS: [&str; 4] = ["view", "render", "cast", "info"];
/// What names another file, or none if it is empty.
pub const FILE_VARIABLE: &str = "OKTANT_CONFIG";

/// Where a value is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    Default,
    File,
    Environment,
}

/// What is preferred.
pub struct Configuration {
    /// The file, there or not; none where nobody wants one.
    pub path: Option<PathBuf>,
    file: BTreeMap<String, String>,
    environment: BTreeMap<String, String>,
}

/// An option that can be preferred.
pub struct Preference {
    pub name: &'static str,
    argument: Arg,
}

impl Preference {
    /// All of them, as the commands define them.
    pub fn all() -> Vec<Self> {
        let command = Arguments::command();
        let of_commands = |name: &str| {
            COMMANDS.iter().find_map(|command_name| {
                let command = command.find_subcommand(command_name)?;
                let mut arguments = command.get_arguments();
                arguments.find(|argument| argument.get_long() == Some(name)).cloned()
            })
        };
        let preference = |name: &&'static str| {
            Some(Preference {
                name,
                argument: of_commands(name)?,
            })
        };
        PREFERENCES.iter().filter_map(preference).collect()
    }

    /// The variable of the environment that says it.
    pub fn variable(&self) -> String {
        format!("OKTANT_{}", self.name.to_uppercase().replace('-', "_"))
    }

    /// What is so where nobody says it, as the help has it.
    pub fn default(&self) -> String {
        let values = self.argument.get_default_values();
        if !values.is_empty() {
            let values: Vec<_> = values.iter().map(|value| value.to_string_lossy()).collect();
            return values.join(",");
        }
        let help = self.argument.get_help().map(ToString::to_string).unwrap_or_default();
        let said = help.split_once("[default: ").and_then(|(_, rest)| rest.split_once(']'));
        said.map_or(String::new(), |(default, _)| {
            default.split_whitespace().collect::<Vec<_>>().join(" ")
        })
    }

    /// Makes sure that the option takes a value.
    ///
    /// # Errors
    /// What it takes, as in "give a number".
    fn check(&self, value: &str) -> Result<(), String> {
        let command = clap::Command::new("oktant")
            .no_binary_name(true)
            .arg(self.argument.clone());
        let Err(error) = command.try_get_matches_from([format!("--{}={value}", self.name)]) else {
            return Ok(());
        };
        if let Some(ContextValue::Strings(valid)) = error.get(ContextKind::ValidValue)
            && !valid.is_empty()
        {
            return Err(format!("one of {}", valid.join(", ")));
        }
        let source = error.source().map(ToString::to_string).unwrap_or_default();
        Err(match source.strip_prefix("give ") {
            Some(expected) => expected.into(),
            None => format!("what --{} takes ({source})", self.name),
        })
    }
}

impl Configuration {
    /// Reads the file, if there is one, and the environment.
    ///
    /// # Errors
    /// A file that is named and not there, and whatever does not fit.
    pub fn read() -> Result<Self, Failure> {
        let preferences = Preference::all();
        let (path, must_be_there) = path();
        let file = match &path {
            Some(path) if must_be_there || path.exists() => read_file(path, &preferences)?,
            _ => BTreeMap::new(),
        };
        let mut environment = BTreeMap::new();
        for preference in &preferences {
            let variable = preference.variable();
            let Some(value) = std::env::var_os(&variable).filter(|value| !value.is_empty()) else {
                continue;
            };
            let value = value.to_string_lossy().into_owned();
            preference
                .check(&value)
                .map_err(|expected| Failure::usage(format!("{variable} is \"{value}\"; give {expected}.")))?;
            environment.insert(preference.name.into(), value);
        }
        Ok(Configuration {
            path,
            file,
            environment,
        })
    }

    /// The value of a setting, and where it is from.
    pub fn value(&self, preference: &Preference) -> (String, Origin) {
        let said = |values: &BTreeMap<String, String>| values.get(preference.name).cloned();
        if let Some(value) = said(&self.environment) {
            (value, Origin::Environment)
        } else if let Some(value) = said(&self.file) {
            (value, Origin::File)
        } else {
            (preference.default(), Origin::Default)
        }
    }

    /// The command that arguments say, with values for what they leave out.
    fn completed(arguments: &[OsString], values: &BTreeMap<String, String>) -> Option<Command> {
        let mut command = Arguments::command();
        for name in COMMANDS {
            command = command.mut_subcommand(name, |command| {
                command.mut_args(|argument| {
                    let value = argument.get_long().and_then(|name| values.get(name)).cloned();
                    match value {
                        Some(value) => argument.default_value(value),
                        None => argument,
                    }
                })
            });
        }
        // Everything has been checked, so whatever is wrong is told as for the command line alone.
        let matches = command
            .try_get_matches_from(arguments)
            .unwrap_or_else(|error| error.exit());
        let arguments = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
        arguments.command
    }
}

/// The file, and whether it must be there.
pub fn path() -> (Option<PathBuf>, bool) {
    match std::env::var_os(FILE_VARIABLE) {
        Some(path) if path.is_empty() => (None, false),
        Some(path) => (Some(path.into()), true),
        None => {
            let folders = ProjectDirs::from("", "", "oktant");
            (folders.map(|folders| folders.config_dir().join("config.toml")), false)
        }
    }
}

fn read_file(path: &Path, preferences: &[Preference]) -> Result<BTreeMap<String, String>, Failure> {
    let settings = settings_file::read(path, |name, value| {
        match preferences.iter().find(|preference| preference.name == name) {
            Some(preference) => preference.check(value).map_err(|expected| Unfit::Value { expected }),
            None => Err(Unfit::Name {
                valid: preferences.iter().map(|preference| preference.name.into()).collect(),
            }),
        }
    })?;
    Ok(settings.into_iter().collect())
}

/// The command that the process was started with, completed by what is preferred: the command line comes before the
/// environment, a scene's own settings come next, then the file, then the defaults.
///
/// # Errors
/// Of a configuration that cannot be.
pub fn complete(said: Option<Command>) -> Result<Command, Failure> {
    let mut arguments: Vec<OsString> = std::env::args_os().collect();
    let said = match said {
        Some(command) if !is_completed(&command) => return Ok(command),
        Some(command) => command,
        None => {
            arguments.push("view".into());
            Command::View(Default::default())
        }
    };
    let configuration = Configuration::read()?;
    let Configuration { file, environment, .. } = &configuration;
    let mut both = file.clone();
    both.extend(environment.clone());
    // Which axis points up is for meshes that do not say it themselves; a scene that does is not to be turned.
    let mut before_scene = file.clone();
    before_scene.extend(
        environment
            .get_key_value("up")
            .map(|(name, value)| (name.clone(), value.clone())),
    );
    let mut after_scene = environment.clone();
    after_scene.remove("up");

    let view: [OsString; 2] = ["oktant".into(), "view".into()];
    if let Some(Command::View(preferred)) = Configuration::completed(&view, &before_scene) {
        let size = preferred.size.unwrap_or_default();
        Preferences {
            view: preferred.look.applied(View::default()),
            size: [size.width, size.height],
        }
        .establish();
    }
    let all = Configuration::completed(&arguments, &both);
    let over_scene = Configuration::completed(&arguments, &after_scene);
    Ok(match (said, over_scene, all) {
        (Command::View(said), Some(Command::View(over)), Some(Command::View(mut all))) => {
            (all.look, all.size) = layered(said.look, (over.look, over.size));
            Command::View(all)
        }
        (Command::Render(said), Some(Command::Render(over)), Some(Command::Render(mut all))) => {
            (all.look, all.size) = layered(said.look, (over.look, over.size));
            Command::Render(all)
        }
        (said, _, all) => all.unwrap_or(said),
    })
}

/// What is said on the command line, on top of the environment.
fn layered(said: LookArguments, (environment, size): (LookArguments, Option<Size>)) -> (LookArguments, Option<Size>) {
    (said.on_top_of(environment), size)
}

/// Whether preferences count for a command.
fn is_completed(command: &Command) -> bool {
    matches!(
        command,
        Command::View(_) | Command::Render(_) | Command::Cast(_) | Command::Info(_)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preference_is_an_option_with_a_default() {
        let all = Preference::all();
        assert_eq!(
            all.iter().map(|preference| preference.name).collect::<Vec<_>>(),
            PREFERENCES
        );
        for preference in &all {
            assert!(!preference.default().is_empty(), "{}", preference.name);
        }
    }

    #[test]
    fn values_are_read_by_the_options_parsers() {
        let check = |name: &str, value: &str| {
            let all = Preference::all();
            let preference = all.iter().find(|preference| preference.name == name).unwrap();
            preference.check(value)
        };
        assert_eq!(check("samples", "adaptive:16"), Ok(()));
        assert_eq!(check("size", "640x480"), Ok(()));
        assert_eq!(check("fov", "-1"), Err("a number of degrees from 1 to 170".into()));
        assert_eq!(check("tone", "film"), Err("one of none, reinhard, aces".into()));
        let range = check("target-ms", "3").unwrap_err();
        assert!(range.starts_with("what --target-ms takes (3 is not in 5..="), "{range}");
    }
}
