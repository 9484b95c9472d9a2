//! Files that are wrong: each is refused in one sentence that says where and why, and no damage makes a reader panic.

use super::Reader::{self, Gltf, Obj, Stl};
use super::glb::Glb;
use super::stl::{binary, text};
use serde_json::{Value, json};

#[track_caller]
fn assert_refused(reader: Reader, bytes: &[u8], words: &[&str]) {
    let sentence = reader.parse(bytes).expect_err("a broken file is read");
    for word in words {
        assert!(sentence.contains(word), "{word:?} is not in {sentence:?}");
    }
}

#[test]
fn stl_files() {
    let whole = binary("", &[[[0.0; 3]; 3]; 2]);
    let not_finite = binary("", &[[[0.0; 3]; 3], [[0.0, f32::NAN, 0.0]; 3]]);
    for (bytes, words) in [
        (b"".as_slice(), &["no STL file"][..]),
        (b"something else", &["no STL file"]),
        (&whole[..130], &["0 of the 2 facets"]),
        (&whole[..180], &["1 of the 2 facets"]),
        (&binary("", &[]), &["no facets"]),
        (&not_finite, &["facet 1 ", "at byte 134", "not finite"]),
        (b"solid a\nendsolid a\n", &["no facets"]),
        (b"solid a\nfacet normal 0 0", &["line 2", "three numbers of a normal"]),
        (
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2\nvertex",
            &["line 5", "\"vertex\" is no finite number"],
        ),
        (
            b"solid a\nfacet normal 0 0 1\nouter ring",
            &["line 3", "\"ring\" stands where loop should be"],
        ),
        (
            b"solid a\n\n\nsurface",
            &["line 4", "\"surface\" stands where facet or endsolid should be"],
        ),
        (text(["0 0 0", "1 inf 0", "0 1 0"]).as_bytes(), &["line 5", "\"inf\""]),
        (
            text(["0 0 0", "1 1 0", "0 1 0\nvertex 0 0 0"]).as_bytes(),
            &["line 7", "\"vertex\" stands where endloop"],
        ),
        (text(["1e300 0 0", "0 1 0", "0 0 1"]).as_bytes(), &["single precision"]),
    ] {
        assert_refused(Stl, bytes, words);
    }
}

#[test]
fn obj_files() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\n";
    for (statements, words) in [
        ("", &["no faces"][..]),
        ("f 1 2\n", &["no faces"]),
        ("v 1 2\n", &["line 6: v has 2 numbers and needs 3"]),
        ("vn 1 2\n", &["line 6: vn has 2 numbers"]),
        ("vt\n", &["line 6: vt has 0 numbers"]),
        ("v 1 2 1e999\n", &["line 6: \"1e999\" is no finite number"]),
        ("v 1 2 x\u{1b}[2J\n", &["line 6: \"x\\u{1b}[2J\""]),
        ("f 1 2 4\n", &["line 6: ", "vertex 4, and there are 3"]),
        ("\n\nf 1 2 -4\n", &["line 8: ", "vertex -4, and there are 3"]),
        ("f 1/2 2/1 3/1\n", &["texture coordinate 2, and there are 1"]),
        ("f 1//1 2//1 3//-2\n", &["normal -2, and there are 1"]),
        (
            "f 1 2 99999999999999999999\n",
            &["\"99999999999999999999\" is no corner"],
        ),
        ("f 1 2 9999999999\n", &["vertex 9999999999"]),
        ("f 1 2 0\n", &["\"0\" is no corner"]),
        ("f 1 2 3/1/1/1\n", &["\"3/1/1/1\" is no corner"]),
        ("f 1 2 /1\n", &["\"/1\" is no corner"]),
        ("f 1.0 2 3\n", &["\"1.0\" is no corner"]),
        (
            "v 1e300 0 0\nf 1 2 3\n",
            &["vertex 4 (counted from 1)", "single precision"],
        ),
    ] {
        assert_refused(Obj, format!("{square}{statements}").as_bytes(), words);
    }
}

/// What is said of a floor that was changed.
#[track_caller]
fn assert_floor_refused(change: impl FnOnce(&mut Value), words: &[&str]) {
    let mut glb = Glb::floor()
        .material(json!({}))
        .light(json!({"type": "point"}), json!({}));
    change(&mut glb.json);
    assert_refused(Gltf, &glb.bytes(), words);
}

#[test]
fn gltf_files() {
    let whole = Glb::floor().bytes();
    for length in [5, 11, 15, 19] {
        assert_refused(Gltf, &whole[..length], &["cut short"]);
    }
    assert_refused(Gltf, &whole[..200], &["cut short or damaged", "it has 200"]);
    assert_refused(Gltf, &whole[..whole.len() - 4], &["cut short or damaged"]);
    let mut other = whole.clone();
    other[4] = 1;
    assert_refused(Gltf, &other, &["version 1 of glTF"]);
    other = whole.clone();
    other[16] = b'X';
    assert_refused(Gltf, &other, &["no JSON"]);
    for (text, words) in [
        ("", &["JSON of the file", "line 1, column 0"][..]),
        ("{}", &["asset.version"]),
        (r#"{"asset":{"version":"1.0"}}"#, &["version 1.0"]),
        (
            "{\"asset\":\n{\"version\":\"2.0\"},\n\"nodes\":[3]}",
            &["line 3", "invalid type: integer `3`"],
        ),
        (r#"{"asset":{"version":"2.0"}}"#, &["no triangles"]),
        (
            r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"a.bin","byteLength":4}]}"#,
            &["buffers[0] is a file beside"],
        ),
        (
            r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"data:;base64,_","byteLength":4}]}"#,
            &["buffers[0] is neither"],
        ),
        (
            r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"data:;base64,AA","byteLength":4}]}"#,
            &["buffers[0] has 1 bytes and claims 4"],
        ),
        (
            r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]}"#,
            &["buffers[0] has 0 bytes"],
        ),
    ] {
        assert_refused(Gltf, text.as_bytes(), words);
    }
}

#[test]
fn references_in_gltf_files() {
    assert_floor_refused(
        |json| json["scene"] = 1.into(),
        &["scenes[1] is mentioned, and there are 1"],
    );
    assert_floor_refused(|json| json["nodes"][0]["mesh"] = 7.into(), &["meshes[7]"]);
    assert_floor_refused(
        |json| json["nodes"][0]["camera"] = 0.into(),
        &["cameras[0]", "there are 0"],
    );
    assert_floor_refused(|json| json["nodes"][0]["children"] = json!([5]), &["nodes[5]"]);
    assert_floor_refused(
        |json| json["nodes"][0]["children"] = json!([0]),
        &["nodes[0] is reached twice"],
    );
    assert_floor_refused(
        |json| json["scenes"][0]["nodes"] = json!([0, 0]),
        &["nodes[0] is reached twice"],
    );
    assert_floor_refused(
        |json| json["extensions"] = json!({}),
        &["KHR_lights_punctual.lights[0]"],
    );
    assert_floor_refused(
        |json| json["accessors"][0]["bufferView"] = 9.into(),
        &["bufferViews[9]"],
    );
    assert_floor_refused(|json| json["bufferViews"][0]["buffer"] = 1.into(), &["buffers[1]"]);
    let primitive =
        |name: &'static str, value: Value| move |json: &mut Value| json["meshes"][0]["primitives"][0][name] = value;
    assert_floor_refused(primitive("material", 1.into()), &["materials[1]"]);
    // Where the crate gltf panics.
    assert_floor_refused(primitive("attributes", json!({"POSITION": 99})), &["accessors[99]"]);
    assert_floor_refused(
        primitive("attributes", json!({})),
        &["meshes[0].primitives[0] has no POSITION"],
    );
    assert_floor_refused(
        |json| json["materials"][0] = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}),
        &["textures[2]"],
    );
    assert_floor_refused(
        |json| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        &["KHR_draco_mesh_compression"],
    );
}

#[test]
fn numbers_in_gltf_files() {
    let accessor =
        |id: usize, name: &'static str, value: Value| move |json: &mut Value| json["accessors"][id][name] = value;
    assert_floor_refused(
        accessor(0, "count", 5.into()),
        &["accessors[0] reaches beyond", "60 of 48 bytes"],
    );
    assert_floor_refused(accessor(0, "count", u64::MAX.into()), &["accessors[0] reaches beyond"]);
    assert_floor_refused(
        accessor(0, "byteOffset", u64::MAX.into()),
        &["accessors[0] reaches beyond"],
    );
    assert_floor_refused(
        accessor(0, "count", 3.into()),
        &["NORMAL has 4 elements for 3 vertices"],
    );
    assert_floor_refused(
        accessor(0, "type", "VEC2".into()),
        &["accessors[0] is VEC2 of components 5126; give VEC3"],
    );
    assert_floor_refused(accessor(0, "componentType", 5127.into()), &["components 5127"]);
    assert_floor_refused(
        accessor(1, "componentType", 5122.into()),
        &["accessors[1]", "unsigned integers"],
    );
    let view = |name: &'static str, value: Value| move |json: &mut Value| json["bufferViews"][0][name] = value;
    assert_floor_refused(view("byteLength", 5000.into()), &["bufferViews[0] reaches beyond"]);
    assert_floor_refused(view("byteOffset", u64::MAX.into()), &["bufferViews[0] reaches beyond"]);
    assert_floor_refused(
        view("byteStride", 8.into()),
        &["bufferViews[0] has a stride of 8 bytes for elements of 12"],
    );
    assert_floor_refused(view("byteStride", 0.into()), &["stride of 0"]);
    for (ior, text) in [(-1.0, "-1"), (0.5, "0.5")] {
        assert_floor_refused(
            |json| json["materials"][0] = json!({"extensions": {"KHR_materials_ior": {"ior": ior}}}),
            &["materials[0].extensions.KHR_materials_ior.ior", text],
        );
    }
    assert_floor_refused(
        |json| {
            json["materials"][0] = json!({"extensions": {
                "KHR_materials_volume": {"thicknessFactor": 1.0, "attenuationDistance": 0.0}}});
        },
        &["attenuationDistance is 0"],
    );
    assert_floor_refused(
        |json| json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = (-1).into(),
        &["KHR_lights_punctual.lights[0].intensity is -1"],
    );
    assert_floor_refused(
        |json| json["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = 0.into(),
        &["KHR_lights_punctual.lights[0].range is 0", "above 0"],
    );
    assert_floor_refused(
        |json| {
            json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.0, "znear": 1.0}}]);
            json["nodes"][0]["camera"] = 0.into();
        },
        &["cameras[0].perspective.yfov is 0"],
    );
    assert_floor_refused(
        |json| {
            json["cameras"] = json!([{"type": "orthographic", "orthographic": {"xmag": 1.0, "ymag": 0.0}}]);
            json["nodes"][0]["camera"] = 0.into();
        },
        &["cameras[0].orthographic.ymag is 0", "above 0"],
    );
    assert_floor_refused(
        |json| json["nodes"][0]["scale"] = json!([1e300, 1, 1]),
        &["single precision"],
    );
    assert_floor_refused(
        |json| {
            json["nodes"][0] = json!({"children": [2], "scale": [1e300, 1, 1]});
            json["nodes"]
                .as_array_mut()
                .unwrap()
                .push(json!({"mesh": 0, "scale": [1e300, 1, 1]}));
        },
        &["single precision"],
    );

    let mut glb = Glb::floor();
    glb.binary[4..8].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_refused(
        Gltf,
        &glb.bytes(),
        &["meshes[0].primitives[0] has a vertex 0", "not finite"],
    );
    let mut glb = Glb::floor();
    glb.binary[48 + 4] = 4;
    assert_refused(Gltf, &glb.bytes(), &["the corner 4, and there are 4 vertices"]);
}

/// Files that between them have everything that the readers know.
fn originals() -> Vec<(Reader, Vec<u8>)> {
    let mut glb = Glb::floor()
        .material(json!({
            "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1], "roughnessFactor": 0.25},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5}, "KHR_materials_ior": {"ior": 1.25}},
        }))
        .light(json!({"type": "spot", "intensity": 5}), json!({"translation": [0, 2, 0]}))
        .node(json!({"camera": 0, "rotation": [0, 0, 0, 1], "translation": [0, 0, 5]}));
    glb.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}]);
    let (indices, values) = (glb.view(&[0, 2]), glb.view(&[0; 24]));
    glb.json["accessors"][0]["sparse"] = json!({
        "count": 2, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values},
    });
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0.5 1\nv 3 -1 \\\n0\nvt 0 0\nvt .5 1e0\nvn 0 0 1\n\
               g a\nusemtl b\ns 2\nf 1 2 3\nf 1/1 2/2 3/-1 4/1\ns off\nf 1//1 2//1 5//-1\nf 5 4 3 2 1\n";
    vec![
        (Gltf, glb.bytes()),
        (Obj, obj.into()),
        (Stl, binary("", &[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]; 2])),
        (Stl, text(["0 0 0", "1 0 0", "0 1 0"]).repeat(2).into()),
    ]
}

#[test]
fn originals_are_read() {
    for (reader, file) in originals() {
        reader.parse(&file).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Every sentence is checked by the reader's helper.
#[test]
fn no_damage_makes_a_reader_panic() {
    let mut random = fastrand::Rng::with_seed(8);
    for (reader, file) in originals() {
        for length in 0..file.len() {
            let _ = reader.parse(&file[..length]);
        }
        for at in 0..file.len() {
            for replacement in [
                file[at] ^ 1,
                file[at] ^ 0x80,
                0,
                0xFF,
                b'9',
                b'-',
                b'\n',
                b' ',
                b'/',
                random.u8(..),
            ] {
                let mut broken = file.clone();
                broken[at] = replacement;
                let _ = reader.parse(&broken);
            }
            let mut broken = file.clone();
            broken.remove(at);
            let _ = reader.parse(&broken);
        }
        for _ in 0..3000 {
            let mut broken = file.clone();
            for _ in 0..random.usize(1..8) {
                let at = random.usize(..broken.len());
                broken[at] = random.u8(..);
            }
            let _ = reader.parse(&broken);
        }
    }
}
