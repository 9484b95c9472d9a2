//! The scenes that come with oktant, and the page about scene files.

use super::{project, read, read_in, scenes};
use oktant::progress::silent;
use oktant::scene::Scene;
use oktant::scene_file;
use oktant::structure::StructureOptions;
use oktant_tests::program::run;
use std::collections::HashMap;
use std::fs;
use tempfile::tempdir;

#[test]
fn the_scenes_that_come_with_oktant_are_sound() {
    let folder = project().join("assets/scenes");
    let scenes = scenes(&folder);
    let mut counts = HashMap::new();
    for scene in &scenes {
        let setting = scene_file::read(scene, &silent).unwrap_or_else(|error| panic!("{error}"));
        let name = scene.file_stem().unwrap().to_str().unwrap().to_string();
        counts.insert(name, setting.model.mesh.triangles.len());
        assert!(setting.files.contains(scene));
        Scene::of_model(setting.model, &StructureOptions::default(), &silent).unwrap();
    }
    assert_eq!(counts["balls"], 4_032, "the count of the thesis");
    assert_eq!(counts["bunny"], 69_451);
    for name in ["mirrors", "cornell", "glass", "stadium"] {
        assert!(counts.contains_key(name), "{name}");
    }
    // And as a person would ask.
    let run = run(&folder, [&["check".into()][..], &scenes].concat());
    assert_eq!(run.code, Some(0), "{}", run.error);
    assert_eq!(run.output.lines().count(), scenes.len());
    for line in run.output.lines() {
        assert!(line.ends_with(": ok"), "{line}");
    }
}

#[test]
fn the_page_about_scene_files_is_complete() {
    let page = fs::read_to_string(project().join("docs/scene-files.md")).unwrap();
    let examples: Vec<_> = page.split("```toml\n").skip(1).collect();
    assert_eq!(examples.len(), 2);
    for example in examples {
        read(example.split("```").next().unwrap());
    }
    // Who asks for a field unlike all others is told which there are.
    let odd = "qqqqqqqqqqqqqqqq = 1\n";
    for table in [
        "",
        "[camera]",
        "[environment]",
        "[render]",
        "[stereo]",
        "[materials.NAME]",
        "[textures.NAME]",
        "[[mesh]]",
        "[[sphere]]",
        "[[box]]",
        "[[quad]]",
        "[[checkerboard]]",
        "[[lathe]]",
        "[[plane]]",
        "[[light]]",
    ] {
        let error = read_in(&tempdir().unwrap(), &format!("{table}\n{odd}"))
            .unwrap_err()
            .to_string();
        let (_, fields) = error.split_once("; there are ").unwrap();
        let section = &page[page
            .find(&format!("`{table}`"))
            .filter(|_| !table.is_empty())
            .unwrap_or_default()..];
        for field in fields
            .split([',', ' '])
            .filter(|word| !word.is_empty() && *word != "and")
        {
            assert!(
                section.contains(&format!("`{field}`")) || section.contains(&format!("[{field}")),
                "{field} of {table} is not on the page"
            );
        }
    }
}
