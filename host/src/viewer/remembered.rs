//! What the window remembers from one time to the next: a small file.

use super::panel::Layout;
use super::recent::Recent;
use super::saved_views::SavedViews;
use crate::output::TextFile;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// No state is longer, bytes.
const LONGEST: u64 = 1 << 22;

/// The panel, as it was left, the views that were saved, and what was opened.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Remembered {
    /// Whether it was open.
    pub panel: bool,
    /// What was opened last.
    #[serde(skip_serializing_if = "Recent::is_empty")]
    pub recent: Recent,
    /// How it was laid out.
    #[serde(flatten)]
    pub layout: Layout,
    /// Views that were saved.
    #[serde(rename = "view", skip_serializing_if = "SavedViews::is_empty")]
    pub views: SavedViews,
}

/// A state and its file, if there is one.
#[derive(Clone, Debug, Default)]
pub struct StateFile {
    path: Option<PathBuf>,
    /// Whether it is there and cannot be used.
    is_broken: bool,
    /// What is in it.
    pub remembered: Remembered,
}

impl StateFile {
    /// Reads a file, or none; the second is a sentence for the person where it is there and cannot be used.
    pub fn read(path: Option<PathBuf>) -> (Self, Option<String>) {
        let Some(path) = path else {
            return (StateFile::default(), None);
        };
        let (remembered, complaint) = match read(&path) {
            Ok(remembered) => (remembered, None),
            Err(reason) => {
                let sentence = format!(
                    "What the viewer remembered in {} cannot be used ({reason}); it begins anew, and replaces the file at \
                     its end.",
                    path.display()
                );
                (Remembered::default(), Some(sentence))
            }
        };
        let file = StateFile {
            path: Some(path),
            is_broken: complaint.is_some(),
            remembered,
        };
        (file, complaint)
    }

    /// The views that are in the file by now: another window may have saved some.
    pub fn views_now(&self) -> SavedViews {
        let now = self.path.as_deref().map(read).and_then(Result::ok);
        now.map_or_else(SavedViews::default, |remembered| remembered.views)
    }

    /// Writes the file anew, whole, where it is broken or the state is another one; says why that cannot be.
    pub fn write(&self, remembered: &Remembered) -> Result<(), String> {
        let is_new = self.is_broken || *remembered != self.remembered;
        let Some(path) = self.path.as_deref().filter(|_| is_new) else {
            return Ok(());
        };
        let text = toml::to_string(remembered).map_err(|error| error.to_string());
        let written = text.and_then(|text| {
            if let Some(folder) = path.parent() {
                fs::create_dir_all(folder).map_err(|error| error.to_string())?;
            }
            let file = TextFile::create(path).map_err(|error| error.to_string())?;
            file.save(&text).map_err(|error| error.to_string())
        });
        written.map_err(|reason| {
            format!(
                "The viewer's state is not remembered in {} ({}); name another file in OKTANT_STATE, or none.",
                path.display(),
                reason.trim_end_matches('.')
            )
        })
    }
}

fn read(path: &Path) -> Result<Remembered, String> {
    match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Remembered::default()),
        Ok(metadata) if metadata.len() > LONGEST => return Err("it is too long".into()),
        _ => {}
    }
    let text = fs::read_to_string(path).map_err(|error| error.to_string())?;
    let remembered: Remembered = toml::from_str(&text).map_err(|error| error.message().to_owned())?;
    if !remembered.layout.width.is_finite() {
        Err("its width is no number".into())
    } else if !remembered.views.are_sound() {
        Err("no camera can stand at one of its views".into())
    } else {
        Ok(remembered)
    }
}

#[cfg(test)]
mod tests {
    use super::super::panel::Section;
    use super::*;
    use crate::projection::Projection;
    use crate::standpoint::{Origin, Standpoint};
    use crate::view::View;

    fn remembered() -> Remembered {
        Remembered {
            panel: true,
            recent: Recent::default(),
            layout: Layout {
                width: 351.5,
                unfolded: [Section::Lights, Section::Statistics].into(),
                ..Layout::default()
            },
            ..Remembered::default()
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("of/the/user/viewer.toml");
        let (file, complaint) = StateFile::read(Some(path.clone()));
        assert_eq!((file.remembered.clone(), complaint), (Remembered::default(), None));
        assert_eq!(file.write(&Remembered::default()), Ok(()));
        assert!(!path.exists(), "there is nothing new");
        assert_eq!(file.write(&remembered()), Ok(()));
        let (file, complaint) = StateFile::read(Some(path.clone()));
        assert_eq!((file.remembered, complaint), (remembered(), None));
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(
            text,
            "panel = true\nwidth = 351.5\nunfolded = [\"lights\", \"statistics\"]\n"
        );
        let names: Vec<_> = fs::read_dir(path.parent().unwrap()).unwrap().collect();
        assert_eq!(names.len(), 1, "no temporary file is left");
    }

    #[test]
    fn views_are_read_again_also_those_of_another_window() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("viewer.toml");
        let mut with_views = remembered();
        let mut view = View {
            projection: Projection::Orthographic,
            ortho_height: Some(1.5),
            ..View::default()
        };
        for number in [2, 9] {
            let camera = Standpoint::of(&view, &Origin::default());
            with_views.views.save("a scene".into(), number, camera);
            view.ortho_height = None;
        }
        let (mine, _) = StateFile::read(Some(path.clone()));
        let (others, _) = StateFile::read(Some(path.clone()));
        assert_eq!(others.write(&with_views), Ok(()));
        assert_eq!(mine.views_now(), with_views.views);
        let (file, complaint) = StateFile::read(Some(path));
        assert_eq!((file.remembered, complaint), (with_views, None));
    }

    #[test]
    fn what_is_broken_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("viewer.toml");
        let far = "[[view]]\nscene = \"a\"\nnumber = 1\n[view.camera]\nlook_at = [0, 0, 0]\nazimuth = 0\nelevation = 91\n\
                   distance = 1\nprojection = \"perspective\"\nfov = 40\n";
        for broken in [far, "panel = maybe", "unfolded = [\"roof\"]", "width = nan", "\u{0}"] {
            fs::write(&path, broken).unwrap();
            let (file, complaint) = StateFile::read(Some(path.clone()));
            assert_eq!(file.remembered, Remembered::default());
            let complaint = complaint.unwrap();
            assert!(
                complaint.contains("cannot be used") && !complaint.contains('\n'),
                "{complaint}"
            );
            assert_eq!(file.write(&Remembered::default()), Ok(()));
            let (file, complaint) = StateFile::read(Some(path.clone()));
            assert_eq!((file.remembered, complaint), (Remembered::default(), None));
        }
        fs::write(&path, "panel = true\n").unwrap();
        let (file, complaint) = StateFile::read(Some(path.clone()));
        assert_eq!(
            (file.remembered.layout, complaint),
            (Layout::default(), None),
            "the rest is usual"
        );
    }

    #[test]
    fn without_a_file_nothing_is_remembered() {
        let (file, complaint) = StateFile::read(None);
        assert_eq!((file.write(&remembered()), complaint), (Ok(()), None));
        let folder = tempfile::tempdir().unwrap();
        let (file, complaint) = StateFile::read(Some(folder.path().to_path_buf()));
        assert!(complaint.is_some(), "a folder is no file");
        let error = file.write(&remembered()).unwrap_err();
        assert!(error.contains("OKTANT_STATE"), "{error}");
    }
}
