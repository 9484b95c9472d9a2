//! STL files, text and binary.

use super::Reader;
use glam::{DVec3, Vec3, dvec3};
use oktant::mesh::Mesh;

/// A binary file of these facets, which begins with these words.
pub fn binary(comment: &str, facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut file = comment.as_bytes().to_vec();
    file.resize(80, b' ');
    file.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        file.extend([0; 12]);
        file.extend(facet.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
        file.extend([7, 7]);
    }
    file
}

/// A text file of one facet with these corners.
pub fn text(corners: [&str; 3]) -> String {
    let vertices = corners.map(|corner| format!("vertex {corner}\n")).concat();
    format!("solid a name\nfacet normal 0 nan 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid a name\n")
}

fn parse(bytes: &[u8]) -> Mesh {
    Reader::Stl.parse(bytes).unwrap_or_else(|error| panic!("{error}")).mesh
}

const HALVES: [[[f32; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
    [[-0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
];

#[test]
fn corners_at_the_same_place_are_one_vertex() {
    // A binary file may begin with the word that text begins with.
    for comment in ["exported", "solid exported"] {
        let mesh = parse(&binary(comment, &HALVES));
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y]);
        assert_eq!(mesh.normals, [Vec3::ZERO; 4], "facets are flat");
    }
}

#[test]
fn text_is_the_same() {
    let half = |corners: [&str; 3]| text(corners);
    let file = half(["0 0 0", "1 0 0", "1 1 0"]) + &half(["-0 0 0", "1e0 1 0", "0 +1. 0"]).to_uppercase();
    for file in [file.clone(), file.replace('\n', "\r\n"), file.replace('\n', " \t\n\n")] {
        assert_eq!(parse(file.as_bytes()), parse(&binary("", &HALVES)));
    }
}

#[test]
fn what_lies_far_away_keeps_its_form() {
    let file = text([
        "500000.001 4649776.25 30",
        "500000.003 4649776.25 30",
        "500000.001 4649776.254 30",
    ]);
    let mesh = parse(file.as_bytes());
    let exact = [
        dvec3(500_000.001, 4_649_776.25, 30.0),
        dvec3(500_000.003, 4_649_776.25, 30.0),
        dvec3(500_000.001, 4_649_776.254, 30.0),
    ];
    assert!(mesh.shift != DVec3::ZERO);
    for (position, exact) in mesh.positions.iter().zip(exact) {
        assert!((position.as_dvec3() + mesh.shift).distance(exact) < 1e-9);
    }
}
