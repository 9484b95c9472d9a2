//! What files cost: no small one more than a second and 256 MiB, whatever it claims.

use super::Reader::{self, Gltf, Obj, Stl};
use super::glb::Glb;
use super::stl::{binary, text};
use oktant::asset::Asset;
use oktant_tests::cost::Cost;
use serde_json::json;
use std::time::Duration;

fn parse(reader: Reader, bytes: &[u8]) -> Result<Asset, String> {
    Cost::SMALL_FILE.within(|| reader.parse(bytes))
}

/// What a file may cost that makes two million triangles: half a second where nobody else computes.
const MILLIONS: Cost = Cost {
    time: Duration::from_secs(5),
    ..Cost::SMALL_FILE
};

#[test]
fn counts_that_are_too_large() {
    let mut header = binary("", &[]);
    header[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(parse(Stl, &header).unwrap_err().contains("0 of the 4294967295 facets"));
    // Zeros for which there is no data.
    for count in [1 << 21, u64::MAX] {
        let mut glb = Glb::floor();
        let (indices, values) = (glb.view(&[0]), glb.view(&[0; 12]));
        glb.json["accessors"][0] = json!({
            "componentType": 5126, "count": count, "type": "VEC3", "sparse": {
                "count": 1, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values}},
        });
        assert!(parse(Gltf, &glb.bytes()).unwrap_err().contains("without data for them"));
    }
}

/// A file of less than 100 kB that shows a mesh of 1,000 triangles 4,000 times: four million of them.
#[test]
fn one_mesh_four_thousand_times() {
    let triangles: Vec<[u16; 3]> = vec![[0, 1, 2]; 1000];
    let mut glb = Glb::new(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &triangles);
    glb.json["nodes"] = json!(vec![json!({"mesh": 0}); 4_000]);
    glb.json["scenes"][0]["nodes"] = json!((0..4_000).collect::<Vec<_>>());
    let error = MILLIONS.within(|| Gltf.parse(&glb.bytes())).unwrap_err();
    assert!(
        error.contains("meshes[0].primitives[0] makes it more than 2097152 triangles"),
        "{error}"
    );
    // A quarter of that is what somebody may want.
    glb.json["scenes"][0]["nodes"] = json!((0..1000).collect::<Vec<_>>());
    assert_eq!(
        MILLIONS
            .within(|| Gltf.parse(&glb.bytes()))
            .unwrap()
            .mesh
            .triangles
            .len(),
        1_000_000
    );
}

#[test]
fn deep_and_wide_trees() {
    let mut glb = Glb::floor();
    let nodes: Vec<_> = (1..30_000)
        .map(|child| json!({"children": [child]}))
        .chain([json!({"mesh": 0})])
        .collect();
    glb.json["nodes"] = json!(nodes);
    assert_eq!(parse(Gltf, &glb.bytes()).unwrap().mesh.triangles.len(), 2);
    let nested = "[".repeat(100_000);
    assert!(parse(Gltf, nested.as_bytes()).unwrap_err().contains("JSON of the file"));
}

#[test]
fn a_hundred_thousand_triangles_are_read_quickly() {
    let side = 224;
    let mut obj = String::new();
    for i in 0..=side {
        for j in 0..=side {
            obj += &format!("v {i} {j} {}\nvt {i} {j}\n", (i * j) % 7);
        }
    }
    for i in 0..side {
        for j in 0..side {
            let corner = i * (side + 1) + j + 1;
            let corners = [corner, corner + side + 1, corner + side + 2, corner + 1];
            let corners = corners.map(|corner| format!("{corner}/{corner}")).join(" ");
            obj += &format!("f {corners}\n");
        }
    }
    assert_eq!(
        parse(Obj, obj.as_bytes()).unwrap().mesh.triangles.len(),
        2 * side * side
    );
    let facet = |i: u32| [[i as f32, 0.0, 0.0], [i as f32 + 1.0, 0.0, 0.0], [i as f32, 1.0, 0.0]];
    let facets: Vec<_> = (0..100_000).map(facet).collect();
    let mesh = parse(Stl, &binary("", &facets)).unwrap().mesh;
    assert_eq!((mesh.triangles.len(), mesh.positions.len()), (100_000, 200_001));
    let texts: String = (0..30_000)
        .map(|i| text([&format!("{i} 0 0"), &format!("{i} 1 0"), &format!("{i} 0 1")]))
        .collect();
    assert_eq!(parse(Stl, texts.as_bytes()).unwrap().mesh.triangles.len(), 30_000);
}

#[test]
fn one_line_of_a_megabyte() {
    let corners = "1 2 3 ".repeat(170_000);
    let obj = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf {corners}\n");
    // A polygon that runs round and round is no concave one of so many corners, but who knows that.
    let error = parse(Obj, obj.as_bytes()).unwrap_err();
    assert!(
        error.contains("line 4: the face is concave and has 510000 corners"),
        "{error}"
    );
    let obj = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# {corners}\nusemtl {corners}\n");
    assert_eq!(parse(Obj, obj.as_bytes()).unwrap().mesh.triangles.len(), 1);
}
