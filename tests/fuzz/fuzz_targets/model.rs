//! glTF, OBJ and STL files: any bytes are an asset that the kernel can trust, or an error of one sentence.
#![no_main]

use libfuzzer_sys::fuzz_target;
use oktant::asset::Asset;
use oktant::progress::silent;
use oktant::scene::{Scene, SceneError};
use oktant::structure::StructureOptions;
use oktant::{gltf, obj, stl};

/// Of more triangles no structure is built, so that others get their turn.
const FEW: usize = 1 << 12;

fuzz_target!(|bytes: &[u8]| {
    // The first byte says which reader is meant.
    let Some((first, bytes)) = bytes.split_first() else {
        return;
    };
    let result = match first {
        b'g' => gltf::parse(bytes, "fuzz", &silent).map_err(|error| error.to_string()),
        b'o' => obj::parse(bytes, "fuzz", &silent).map_err(|error| error.to_string()),
        b's' => stl::parse(bytes, "fuzz", &silent)
            .map(|mesh| Asset {
                mesh,
                ..Asset::default()
            })
            .map_err(|error| error.to_string()),
        _ => return,
    };
    match result {
        Ok(asset) if asset.mesh.triangles.len() <= FEW => {
            let setting = asset.into_setting();
            match Scene::of_model(setting.model, &StructureOptions::default(), &silent) {
                Ok(_) | Err(SceneError::Build(_)) => {}
                Err(error) => panic!("{error}"),
            }
        }
        Ok(_) => {}
        Err(sentence) => assert!(
            sentence.starts_with("fuzz: ") && !sentence.contains(char::is_control),
            "{sentence:?}"
        ),
    }
});
