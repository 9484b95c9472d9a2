//! What was opened before, to be opened again.

use super::application::Application;
use super::event::{Event, Key};
use super::input::Input;
use super::overlay::{Line, Tone};
use crate::mesh_source::MeshSource;
use crate::source::Source;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// So much is remembered: as much as there are digits.
const MOST: usize = 10;
/// What has longer names is not remembered, bytes.
const LONGEST: usize = 4096;

/// What was opened with success, the last first: for each time the files, by their whole paths.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Recent(Vec<Vec<String>>);

impl Recent {
    /// Whether nothing was opened.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Takes note of what was opened. What is no file, or has names that are no text, is not remembered.
    pub fn opened(&mut self, source: &Source) {
        let Some(paths) = paths(source) else { return };
        if paths.iter().map(String::len).sum::<usize>() > LONGEST {
            return;
        }
        self.0.retain(|other| *other != paths);
        self.0.insert(0, paths);
        self.0.truncate(MOST);
    }

    /// The files that were opened last, or the time before that, and so on.
    pub fn paths(&self, index: usize) -> Option<Vec<PathBuf>> {
        Some(self.0.get(index)?.iter().map(PathBuf::from).collect())
    }

    /// Each time, the last first: short, and with all files.
    pub fn labels(&self) -> impl Iterator<Item = (String, String)> {
        self.0.iter().map(|paths| {
            let first = paths.first().map_or("", String::as_str);
            let name = Path::new(first).file_name().unwrap_or_default().to_string_lossy();
            let label = match paths.len() {
                0 | 1 => name.into_owned(),
                count => format!("{name} and {} more", count - 1),
            };
            (label, paths.join("\n"))
        })
    }
}

/// The files of a source, by their whole paths.
fn paths(source: &Source) -> Option<Vec<String>> {
    let whole = |path: &Path| Some(std::path::absolute(path).ok()?.to_str()?.to_owned());
    let of_mesh = |mesh: &MeshSource| match mesh {
        MeshSource::File(path) => whole(path),
        _ => None,
    };
    match source {
        Source::Scene(path) => Some(vec![whole(path)?]),
        Source::Mesh(mesh) => Some(vec![of_mesh(mesh)?]),
        Source::Several(meshes) => meshes.iter().map(of_mesh).collect(),
    }
}

impl Application {
    /// Opens what was opened before, or says why that cannot be.
    pub(super) fn open_recent(&mut self, index: usize) -> Result<(), String> {
        let Some(paths) = self.recent.paths(index) else {
            return Err(match self.recent.0.len() {
                0 => "nothing was opened yet; drop a file on the window".into(),
                1 => "only one thing was opened so far; it has the number 1".into(),
                count => format!("only {count} things were opened so far; give a number from 1 to {count}"),
            });
        };
        self.open_files(paths);
        Ok(())
    }

    /// What a key asks for while the list is shown: its digits, 0 for the tenth.
    pub(super) fn chosen_recent(&self, event: &Event) -> Option<Input> {
        let Event::Key(Key::Character(key)) = event else {
            return None;
        };
        let digit = key.to_digit(10).filter(|_| self.session.recent)? as usize;
        Some(Input::Recent((digit + MOST - 1) % MOST))
    }

    /// The list, if it is to be shown.
    pub(super) fn recent_lines(&self) -> Vec<Line> {
        let line = |text: String, tone| Line { text, tone };
        if !self.session.recent {
            return Vec::new();
        }
        if self.recent.is_empty() {
            return vec![line("no recent files".into(), Tone::Strong)];
        }
        let title = line("recent files: press a digit, or Esc".into(), Tone::Strong);
        let rows = (1..).zip(self.recent.labels());
        let rows = rows.map(|(number, (label, _))| line(format!("{}   {label}", number % MOST), Tone::Plain));
        std::iter::once(title).chain(rows).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn opened(recent: &mut Recent, name: &str) {
        recent.opened(&Source::from_path(name.into()));
    }

    fn labels(recent: &Recent) -> Vec<String> {
        recent.labels().map(|(label, _)| label).collect()
    }

    #[test]
    fn the_last_ten_are_kept_each_once() {
        let mut recent = Recent::default();
        for name in 0..12 {
            opened(&mut recent, &format!("{name}.ply"));
        }
        opened(&mut recent, "5.ply");
        let wanted = [
            "5.ply", "11.ply", "10.ply", "9.ply", "8.ply", "7.ply", "6.ply", "4.ply", "3.ply", "2.ply",
        ];
        assert_eq!(labels(&recent), wanted);
        let path = recent.paths(0).unwrap().remove(0);
        assert!(path.is_absolute() && path.ends_with("5.ply"), "{path:?}");
        assert_eq!(recent.paths(10), None);
    }

    #[test]
    fn several_files_are_one_entry_and_what_is_built_in_is_none() {
        let mut recent = Recent::default();
        recent.opened(&Source::default());
        recent.opened(&Source::from_arguments(&["balls", "a.ply"].map(PathBuf::from)).unwrap());
        assert!(recent.is_empty());
        let several = Source::from_paths(["a.ply", "b.stl"].map(PathBuf::from).to_vec()).unwrap();
        recent.opened(&several);
        assert_eq!(labels(&recent), ["a.ply and 1 more"]);
        assert_eq!(recent.paths(0).unwrap().len(), 2);
        opened(&mut recent, &"long".repeat(2000));
        assert_eq!(labels(&recent).len(), 1);
    }
}
