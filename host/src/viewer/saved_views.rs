//! Views that were saved by key, of all scenes.

use super::application::Application;
use super::session::PLACES;
use crate::mesh_source::MeshSource;
use crate::source::Source;
use crate::standpoint::Standpoint;
use serde::{Deserialize, Serialize};
use std::fs;

/// So many are remembered; the oldest are forgotten.
const MOST: usize = 500;

/// A view that was saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedView {
    /// The file of the scene, or what it is called.
    scene: String,
    /// The key, 1 to [`PLACES`].
    number: usize,
    /// Where the camera stood.
    camera: Standpoint,
}

/// All of them, the newest last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SavedViews(Vec<SavedView>);

impl SavedViews {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether a camera can stand at all of them.
    pub fn are_sound(&self) -> bool {
        self.0
            .iter()
            .all(|view| (1..=PLACES).contains(&view.number) && view.camera.is_sound())
    }

    /// Those of a scene, by their numbers less 1.
    pub fn of(&self, scene: &str) -> [Option<Standpoint>; PLACES] {
        let mut places = [None; PLACES];
        for view in self.0.iter().filter(|view| view.scene == scene) {
            places[view.number - 1] = Some(view.camera);
        }
        places
    }

    /// Saves one, in the place of another of its scene and number.
    pub fn save(&mut self, scene: String, number: usize, camera: Standpoint) {
        self.0.retain(|view| view.scene != scene || view.number != number);
        self.0.push(SavedView { scene, number, camera });
        self.0.drain(..self.0.len().saturating_sub(MOST));
    }

    /// Adds others, which take precedence.
    pub fn extend(&mut self, others: &SavedViews) {
        for view in &others.0 {
            self.save(view.scene.clone(), view.number, view.camera);
        }
    }
}

/// What a source is remembered as: one file has one name, wherever the program was started.
pub fn scene_name(source: &Source) -> String {
    let (Source::Scene(path) | Source::Mesh(MeshSource::File(path))) = source else {
        return source.to_string();
    };
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.clone());
    path.display().to_string()
}

impl Application {
    /// Remembers a view that the session has saved, at once, and says so.
    pub(super) fn keep_view(&mut self, number: usize) {
        let Some(camera) = self.session.saved(number) else {
            return;
        };
        self.saved_views.save(scene_name(&self.source), number, camera);
        self.tell(
            format!("This view is saved as {number}: the key brings it back."),
            false,
        );
        self.remember();
    }

    /// The views of what is shown that were saved now or earlier.
    pub(super) fn views_of_scene(&self) -> [Option<Standpoint>; PLACES] {
        let mut views = self.state.remembered.views.clone();
        views.extend(&self.saved_views);
        views.of(&scene_name(&self.source))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::standpoint::Origin;
    use crate::view::View;

    fn camera(azimuth: f32) -> Standpoint {
        let mut view = View::default();
        view.camera.azimuth = azimuth;
        Standpoint::of(&view, &Origin::default())
    }

    #[test]
    fn each_scene_has_its_own() {
        let mut views = SavedViews::default();
        views.save("a".into(), 1, camera(1.0));
        views.save("b".into(), 1, camera(2.0));
        views.save("a".into(), 9, camera(3.0));
        views.save("a".into(), 1, camera(4.0));
        let of = |scene| views.of(scene).map(|camera| camera.map(|camera| camera.azimuth));
        assert_eq!((of("a")[0], of("a")[8], of("b")[0]), (Some(4.0), Some(3.0), Some(2.0)));
        assert_eq!(of("c"), [None; PLACES]);
        let mut others = SavedViews::default();
        others.save("b".into(), 1, camera(5.0));
        views.extend(&others);
        assert_eq!(views.of("b")[0], Some(camera(5.0)));
        assert_eq!(views.0.len(), 3);
    }

    #[test]
    fn the_oldest_are_forgotten() {
        let mut views = SavedViews::default();
        for i in 0..=MOST {
            views.save(format!("scene {i}"), 1, camera(0.0));
        }
        assert_eq!(views.of("scene 0"), [None; PLACES]);
        assert!(views.of("scene 1")[0].is_some());
        assert!(views.are_sound());
        views.save("scene".into(), 10, camera(0.0));
        assert!(!views.are_sound(), "there is no such key");
    }

    #[test]
    fn a_file_has_one_name() {
        let here = Source::from_path("Cargo.toml".into());
        assert_eq!(scene_name(&here), scene_name(&Source::from_path("./Cargo.toml".into())));
        assert!(scene_name(&here).len() > "Cargo.toml".len());
        assert_eq!(scene_name(&Source::default()), "bunny");
    }
}
