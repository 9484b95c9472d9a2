//! Asking the person for files, by the platform's own dialog.

use super::application::Application;
use super::input::Input;
use super::notice::Notice;
use crate::mesh_source::MeshSource;
use crate::source::Source;
use rfd::AsyncFileDialog;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Instant;

/// How the names of files end that can be opened; those of other mesh files end as they like.
const ENDINGS: [&str; 6] = ["toml", "glb", "gltf", "obj", "ply", "stl"];

impl Application {
    /// Asks the person for files, once at a time; the mailbox gets them.
    pub(super) fn choose_files(&mut self, beside: bool) {
        if self.is_choosing {
            return;
        }
        self.is_choosing = true;
        let title = if beside {
            "Open beside what is shown"
        } else {
            "Open a scene or meshes"
        };
        let mut dialog = AsyncFileDialog::new()
            .set_title(title)
            .add_filter("Scenes and meshes", &ENDINGS)
            .add_filter("All files", &["*"]);
        if let Some(folder) = folder_of(&self.source) {
            dialog = dialog.set_directory(folder);
        }
        // Of the dialogs that are part of a window, as on a Mac, only this thread may make one.
        if let Some(window) = &self.window {
            dialog = dialog.set_parent(window);
        }
        let asked = dialog.pick_files();
        let mailbox = self.mailbox.clone();
        thread::spawn(move || {
            let files = pollster::block_on(asked);
            let paths = files.map(|files| files.iter().map(|file| file.path().to_path_buf()).collect());
            mailbox.send(Notice::Chosen { paths, beside });
        });
    }

    /// Opens what was chosen; says what to do instead where nobody was there to show a dialog.
    pub(super) fn take_chosen(&mut self, paths: Option<Vec<PathBuf>>, beside: bool, now: Instant) {
        self.is_choosing = false;
        match paths {
            Some(paths) if paths.is_empty() => {}
            Some(paths) if beside => self.take_input(Input::Add(paths), now),
            Some(paths) => self.take_input(Input::Open(paths), now),
            // Elsewhere that is how a dialog ends that was cancelled.
            None if cfg!(target_os = "linux") => self.tell(
                "There is no file dialog here: neither a desktop portal nor zenity answers; drop files on the window, or \
                 start oktant with their names."
                    .into(),
                true,
            ),
            None => {}
        }
    }
}

/// Where the files of a source lie, if it has some.
fn folder_of(source: &Source) -> Option<PathBuf> {
    let path = match source {
        Source::Scene(path) | Source::Mesh(MeshSource::File(path)) => path.as_path(),
        Source::Several(meshes) => meshes.iter().find_map(|mesh| match mesh {
            MeshSource::File(path) => Some(path.as_path()),
            _ => None,
        })?,
        Source::Mesh(_) => return None,
    };
    std::path::absolute(path).ok()?.parent().map(Path::to_path_buf)
}
