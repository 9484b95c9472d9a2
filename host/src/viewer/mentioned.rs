//! Files that a scene file may mean, also where it cannot be used.

use crate::gltf;
use crate::mesh_format::MeshFormat;
use crate::mesh_source::MeshSource;
use crate::obj;
use crate::source::Source;
use crate::whole_file;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// Nobody writes a longer scene file, bytes.
const LARGEST: u64 = 16 << 20;

/// Nor are files of meshes searched for others that are longer than this, bytes.
const LARGEST_MESH: u64 = 256 << 20;

/// What a source is read from, as far as can be told without building it: the file, whatever a scene file may mean by one of
/// its texts, and what meshes among all these mention, there or not.
pub fn mentioned(source: &Source) -> Vec<PathBuf> {
    let path = match source {
        Source::Scene(path) | Source::Mesh(MeshSource::File(path)) => path,
        Source::Mesh(_) => return Vec::new(),
        Source::Several(meshes) => {
            let each = meshes.iter().map(|mesh| mentioned(&Source::Mesh(mesh.clone())));
            return each.flatten().collect();
        }
    };
    let mut files = vec![path.clone()];
    if let Source::Scene(path) = source {
        let mut text = String::new();
        let read = File::open(path).and_then(|file| file.take(LARGEST).read_to_string(&mut text));
        if let (Ok(_), Ok(table)) = (read, DeTable::parse(&text)) {
            let folder = path.parent().unwrap_or(Path::new(""));
            for value in table.get_ref().values() {
                collect(value.get_ref(), folder, &mut files);
            }
        }
    }
    let of_meshes: Vec<PathBuf> = files.iter().flat_map(|file| of_mesh(file)).collect();
    files.extend(of_meshes);
    files
}

/// The files that a mesh file mentions.
fn of_mesh(path: &Path) -> Vec<PathBuf> {
    let mentions = match MeshFormat::of(path) {
        MeshFormat::Obj => obj::mentions,
        MeshFormat::Gltf => gltf::mentions,
        MeshFormat::Ply | MeshFormat::Binary | MeshFormat::Stl => return Vec::new(),
    };
    let bytes = whole_file::read(path, LARGEST_MESH).unwrap_or_default();
    mentions(&bytes, path.parent().unwrap_or(Path::new("")))
}

fn collect(value: &DeValue<'_>, folder: &Path, files: &mut Vec<PathBuf>) {
    match value {
        DeValue::String(text) if !text.is_empty() => files.push(folder.join(text.as_ref())),
        DeValue::Array(values) => values.iter().for_each(|value| collect(value.get_ref(), folder, files)),
        DeValue::Table(table) => table.values().for_each(|value| collect(value.get_ref(), folder, files)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn every_text_may_be_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("scene.toml");
        let of = |text: &str| {
            fs::write(&scene, text).unwrap();
            mentioned(&Source::Scene(scene.clone()))
        };
        let found = of("[[mesh]]\nfile = \"meshes/a.ply\"\nwrong = 3\n[environment]\nimages = [\"/b.hdr\", \"\"]\n");
        let wanted = [
            scene.clone(),
            folder.path().join("meshes/a.ply"),
            PathBuf::from("/b.hdr"),
        ];
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(wanted.iter().all(|path| found.contains(path)), "{found:?}");
        assert_eq!(of("[[mesh").len(), 1, "the scene file itself");
        fs::remove_file(&scene).unwrap();
        assert_eq!(mentioned(&Source::Scene(scene.clone())), [scene]);
    }

    #[test]
    fn what_meshes_mention_is_mentioned() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        // Both are broken, and say all the same what they were made of.
        fs::write(at("a.obj"), "mtllib a.mtl b.mtl\nf 1 2 x\n").unwrap();
        fs::write(at("a.mtl"), "newmtl red\nmap_Kd -s 2 2 2 red wood.png\nKd red\n").unwrap();
        let json = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"b%20c.bin","byteLength":9}],
            "images":[{"uri":"wood.png"},{"uri":"data:,x"},{"uri":"https://example.org/a.png"}],"scene":7}"#;
        fs::write(at("b.gltf"), json).unwrap();
        fs::write(at("scene.toml"), "[[mesh]]\nfile = \"a.obj\"\n").unwrap();
        for (source, wanted) in [
            ("a.obj", &["a.obj", "red wood.png", "a.mtl", "b.mtl"][..]),
            ("b.gltf", &["b.gltf", "b c.bin", "wood.png"]),
            ("scene.toml", &["scene.toml", "a.obj", "red wood.png", "a.mtl", "b.mtl"]),
        ] {
            let wanted: Vec<_> = wanted.iter().map(|name| at(name)).collect();
            assert_eq!(mentioned(&Source::from_path(at(source))), wanted);
        }
    }

    #[test]
    fn a_mesh_is_one_file_or_none() {
        let path = PathBuf::from("a.ply");
        assert_eq!(mentioned(&Source::from_path(path.clone())), [path]);
        assert_eq!(mentioned(&Source::Mesh(MeshSource::Bunny)), Vec::<PathBuf>::new());
        let several = Source::from_arguments(&["a.ply", "balls", "b.stl"].map(PathBuf::from)).unwrap();
        assert_eq!(mentioned(&several), ["a.ply", "b.stl"].map(PathBuf::from));
    }
}
