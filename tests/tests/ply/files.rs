//! Files on a disk.

use std::path::Path;

use oktant::ply;
use oktant::progress::silent;

use super::{CORNER, ascii, plain};

fn error(path: &Path) -> String {
    ply::read(path, &silent).unwrap_err().to_string()
}

#[test]
fn a_file_is_read_as_its_bytes_are() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("triangle.ply");
    let file = ascii(&plain(3, 1), &format!("{CORNER}3 0 1 2\n"));
    std::fs::write(&path, &file).unwrap();
    let mesh = ply::read(&path, &silent).unwrap();
    assert_eq!(mesh, ply::parse(&file, "other name", &silent).unwrap());
}

#[test]
fn paths_that_are_no_ply_file_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("none.ply");
    assert_eq!(
        error(&path),
        format!("{}: there is no such file; check the path", path.display())
    );
    let sentence = error(directory.path());
    assert!(
        sentence.contains("is a directory") && sentence.contains("PLY, OBJ, STL or glTF") && sentence.contains(".toml"),
        "{sentence}"
    );
    let below = directory.path().join("film.ply");
    std::fs::write(&below, b"RIFF....AVI ").unwrap();
    assert!(error(&below).contains("not a PLY file"));
    assert!(error(&below.join("a.ply")).contains("cannot be read"));
    std::fs::write(&below, b"").unwrap();
    assert!(error(&below).contains("empty"));
}

/// A device without end must not be read to its end.
#[cfg(target_os = "linux")]
#[test]
fn a_device_is_refused() {
    assert!(error(Path::new("/dev/zero")).contains("not a PLY file"));
    assert!(error(Path::new("/dev/null")).contains("empty"));
}

#[test]
fn progress_reaches_its_end() {
    let file = ascii(&plain(3, 1), &format!("{CORNER}3 0 1 2\n"));
    let reports = std::sync::Mutex::new(Vec::new());
    let progress = |stage: &'static str, fraction: f32| reports.lock().unwrap().push((stage, fraction));
    ply::parse(&file, "some.ply", &progress).unwrap();
    let reports = reports.into_inner().unwrap();
    assert!(
        reports
            .iter()
            .all(|(stage, fraction)| *stage == "reading" && (0.0..=1.0).contains(fraction))
    );
    assert!(reports.contains(&("reading", 1.0)));
}
