//! Scene files: any text is a scene that the kernel can trust, or an error of one sentence.
#![no_main]

use libfuzzer_sys::fuzz_target;
use oktant::progress::silent;
use oktant::scene::{Scene, SceneError};
use oktant::scene_file;
use oktant::structure::StructureOptions;
use std::path::Path;

/// A few lines may ask for as many triangles as ids can count.
const MOST: usize = 1 << 20;

/// Of more no structure is built, so that others get their turn.
const FEW: usize = 1 << 12;

fuzz_target!(|text: &str| {
    match scene_file::parse(text, Path::new("fuzz.toml"), MOST, &silent) {
        Ok(setting) if setting.model.mesh.triangles.len() <= FEW => {
            match Scene::of_model(setting.model, &StructureOptions::default(), &silent) {
                Ok(_) | Err(SceneError::Build(_)) => {}
                Err(error) => panic!("{error}"),
            }
        }
        Ok(_) => {}
        Err(error) => {
            let sentence = error.to_string();
            assert!(
                sentence.starts_with("fuzz.toml:") && !sentence.contains('\n'),
                "{sentence:?}"
            );
        }
    }
});
