//! Files that a scene file may mean, also where it cannot be used.

use crate::mesh_source::MeshSource;
use crate::source::Source;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// Nobody writes a longer scene file, bytes.
const LARGEST: u64 = 16 << 20;

/// What a source is read from, as far as can be told without reading all of it: the file, and whatever a scene file may
/// mean by one of its texts, there or not.
pub fn mentioned(source: &Source) -> Vec<PathBuf> {
    let (Source::Scene(path) | Source::Mesh(MeshSource::File(path))) = source else {
        return Vec::new();
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
    files
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
    fn a_mesh_is_one_file_or_none() {
        let path = PathBuf::from("a.ply");
        assert_eq!(mentioned(&Source::from_path(path.clone())), [path]);
        assert_eq!(mentioned(&Source::Mesh(MeshSource::Bunny)), Vec::<PathBuf>::new());
    }
}
