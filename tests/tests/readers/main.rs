//! The readers of glTF, OBJ and STL: what good files become, and what is said of broken ones.

#![cfg(test)]

mod broken;
mod costs;
mod files;
mod glb;
mod gltf;
mod mapping;
mod obj;
mod stl;

use oktant::asset::Asset;
use oktant::progress::silent;
use oktant_tests::cost::Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Which reader is meant.
#[derive(Clone, Copy, Debug)]
enum Reader {
    Gltf,
    Obj,
    Stl,
}

impl Reader {
    /// Reads a file in memory, and checks what holds for every asset or every error.
    fn parse(self, bytes: &[u8]) -> Result<Asset, String> {
        let result = match self {
            Reader::Gltf => oktant::gltf::parse(bytes, "some.file", &silent).map_err(|error| error.to_string()),
            Reader::Obj => oktant::obj::parse(bytes, "some.file", &silent).map_err(|error| error.to_string()),
            Reader::Stl => oktant::stl::parse(bytes, "some.file", &silent)
                .map(|mesh| Asset {
                    mesh,
                    ..Asset::default()
                })
                .map_err(|error| error.to_string()),
        };
        match &result {
            Ok(asset) => check(asset),
            Err(sentence) => check_sentence(sentence),
        }
        result
    }
}

fn check(asset: &Asset) {
    let mesh = &asset.mesh;
    let count = mesh.positions.len();
    assert!(!mesh.triangles.is_empty());
    assert!(
        mesh.triangles
            .as_flattened()
            .iter()
            .all(|corner| (*corner as usize) < count)
    );
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    assert!(mesh.shift.is_finite());
    assert_eq!(mesh.normals.len(), count);
    for normal in &mesh.normals {
        let length = normal.length();
        assert!(length == 0.0 || (length - 1.0).abs() < 1e-5, "{normal}");
    }
    assert!(mesh.colors.is_empty() || mesh.colors.len() == count);
    assert!(mesh.coordinates.is_empty() || mesh.coordinates.len() == count);
    assert!(mesh.coordinates.iter().all(|coordinate| coordinate.is_finite()));
    if asset.materials.is_empty() {
        assert!(asset.material_ids.is_empty());
    } else {
        assert_eq!(asset.material_ids.len(), mesh.triangles.len());
        assert!(
            asset
                .material_ids
                .iter()
                .all(|id| (*id as usize) < asset.materials.len())
        );
    }
    for material in &asset.materials {
        let leaves = material.base * material.diffuse + material.mirror + material.transmission;
        assert!(
            leaves.min_element() >= 0.0 && leaves.max_element() <= 1.0 + 1e-5,
            "{material:?}"
        );
    }
}

fn check_sentence(sentence: &str) {
    assert!(sentence.starts_with("some.file: "), "{sentence}");
    assert!(!sentence.contains(char::is_control), "{sentence:?}");
    assert!(sentence.len() < 500, "{sentence}");
    // What is wrong; what to do.
    assert!(sentence.contains("; ") || sentence.contains(", "), "{sentence}");
    assert!(!sentence.ends_with(['.', ' ', ';']), "{sentence}");
}
