//! Where measurements come from: machine, commit and command.

use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;
use sysinfo::{CpuRefreshKind, RefreshKind, System};

/// Where measurements come from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// What it was measured on: processor with number of threads, adapters.
    pub machine: String,
    /// Of the source that was measured, see [`commit`].
    pub commit: String,
    /// What makes it again.
    pub command: String,
}

impl Origin {
    /// This program on this machine: its processor with the threads that are used, and these adapters.
    pub fn here(adapters: &[String], command: impl Into<String>) -> Self {
        let mut machine = format!("{}, {} threads", processor(), rayon::current_num_threads());
        for adapter in adapters {
            machine.push_str("; ");
            machine.push_str(adapter);
        }
        Origin {
            machine,
            commit: commit(),
            command: command.into(),
        }
    }

    /// Names another one beside it, where it is another.
    pub(super) fn merge(&mut self, other: &Origin) {
        let fields = [
            (&mut self.machine, &other.machine, "; "),
            (&mut self.commit, &other.commit, " + "),
            (&mut self.command, &other.command, " + "),
        ];
        for (own, other, between) in fields {
            for part in other.split(between).filter(|part| !part.is_empty()) {
                if !own.split(between).any(|one| one == part) {
                    if !own.is_empty() {
                        own.push_str(between);
                    }
                    own.push_str(part);
                }
            }
        }
    }
}

/// What this process was started with, as a person would type it into a shell, with this name of the program.
pub fn command_line(program: &str) -> String {
    let mut text = program.to_owned();
    for argument in std::env::args_os().skip(1) {
        text.push(' ');
        text.push_str(&quoted(&argument.to_string_lossy()));
    }
    text
}

/// In quotes where a shell would make something else of it.
fn quoted(argument: &str) -> String {
    let is_plain = |one: char| one.is_alphanumeric() || "-_./,:=+@%".contains(one);
    if !argument.is_empty() && argument.chars().all(is_plain) {
        argument.into()
    } else {
        format!("'{}'", argument.replace('\'', "'\\''"))
    }
}

/// The processor's name.
pub fn processor() -> String {
    let system = System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
    let name = system
        .ok()
        .and_then(|system| system.cpus().first().map(|cpu| cpu.brand().trim().to_owned()));
    match name {
        Some(name) if !name.is_empty() => name,
        _ => format!("{} processor", std::env::consts::ARCH),
    }
}

/// The commit of the source: as git tells it where the program is in a folder of its repository, with a `+` where files have
/// been changed since; else the one in `OKTANT_COMMIT` when it was compiled; else that it is unknown, with the version.
///
/// It is asked for while it runs, so that no commit compiles anything anew; and once, so that files which it has written
/// since do not count.
pub fn commit() -> String {
    static COMMIT: LazyLock<String> = LazyLock::new(current_commit);
    COMMIT.clone()
}

fn current_commit() -> String {
    let beside = std::env::current_exe().ok();
    let of_repository = beside.as_deref().and_then(|program| {
        let mut folders = program.ancestors().skip(1);
        // A folder `target` within the sources.
        let sources = folders.find(|folder| folder.join("shared/src/whitted.rs").is_file())?;
        described(sources)
    });
    of_repository
        .or_else(|| option_env!("OKTANT_COMMIT").map(String::from))
        .unwrap_or_else(|| format!("unknown, version {}", env!("CARGO_PKG_VERSION")))
}

fn described(folder: &Path) -> Option<String> {
    let mut git = Command::new("git");
    git.arg("-C").arg(folder);
    git.args(["describe", "--always", "--abbrev=10", "--dirty=+"]);
    let output = git.output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let text = text.trim();
    (output.status.success() && !text.is_empty()).then(|| text.into())
}

#[cfg(test)]
mod tests {
    use super::{Origin, quoted};

    #[test]
    fn arguments_are_quoted_where_a_shell_needs_it() {
        for plain in ["--size", "64x48", "a/b.toml", "größer", "x=1,2"] {
            assert_eq!(quoted(plain), plain);
        }
        for special in ["", "a b", "\"", "$HOME", "#1", "\\", "a;b", "*"] {
            assert_eq!(quoted(special), format!("'{special}'"));
        }
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }

    #[test]
    fn what_is_empty_leaves_no_separators() {
        let origin = |text: &str| Origin {
            machine: text.into(),
            commit: text.into(),
            command: text.into(),
        };
        let mut own = origin("a");
        own.merge(&Origin::default());
        assert_eq!(own, origin("a"));
        let mut own = Origin::default();
        own.merge(&origin("a"));
        own.merge(&origin("a"));
        assert_eq!(own, origin("a"));
        own.merge(&origin("b"));
        assert_eq!((own.machine.as_str(), own.command.as_str()), ("a; b", "a + b"));
    }
}
