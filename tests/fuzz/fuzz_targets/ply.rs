//! PLY files: any bytes are a mesh or an error, and a mesh keeps its rules.
#![no_main]

use libfuzzer_sys::fuzz_target;
use oktant::ply;
use oktant::progress::silent;

fuzz_target!(|bytes: &[u8]| {
    let Ok(mesh) = ply::parse(bytes, "fuzz", &silent) else {
        return;
    };
    let mesh = mesh.with_normals();
    let vertices = mesh.positions.len();
    assert!(!mesh.triangles.is_empty());
    assert!(
        mesh.triangles
            .as_flattened()
            .iter()
            .all(|corner| (*corner as usize) < vertices)
    );
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    assert!(mesh.normals.len() == vertices && mesh.normals.iter().all(|normal| normal.is_finite()));
    assert!(mesh.colors.is_empty() || mesh.colors.len() == vertices);
    assert!(mesh.coordinates.is_empty() || mesh.coordinates.len() == vertices);
});
