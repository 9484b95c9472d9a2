//! glTF files: vertices, nodes, images.

use super::Reader;
use super::glb::Glb;
use glam::{DMat4, DQuat, DVec3, Vec2, Vec3, dvec3, vec2, vec3};
use oktant::asset::Asset;
use oktant::gltf;
use oktant::progress::silent;
use serde_json::{Value, json};
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::io::Cursor;
use tempfile::tempdir;

fn parse(glb: &Glb) -> Asset {
    Reader::Gltf
        .parse(&glb.bytes())
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_floor_is_read() {
    let mesh = parse(&Glb::floor()).mesh;
    assert_eq!(mesh.positions[2], vec3(1.0, 0.0, 1.0));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.normals, [Vec3::Y; 4]);
    let mut bare = Glb::floor();
    bare.json["meshes"][0]["primitives"][0]["attributes"]
        .as_object_mut()
        .unwrap()
        .remove("NORMAL");
    assert_eq!(
        parse(&bare).mesh.normals,
        [Vec3::ZERO; 4],
        "without normals, triangles are flat"
    );
}

/// Oracle: the matrices multiplied by hand, in f64.
#[test]
fn nodes_move_what_is_below_them() {
    let mut glb = Glb::floor();
    let half = (FRAC_PI_2 / 2.0).sin();
    glb.json["nodes"] = json!([
        {"children": [1, 2], "translation": [10.0, 0.0, 0.5], "scale": [2.0, 1.0, 1.0]},
        {"mesh": 0, "rotation": [0.0, 0.0, half, half]},
        {"mesh": 0, "matrix": [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 1.0]},
    ]);
    let mesh = parse(&glb).mesh;
    let above = DMat4::from_translation(dvec3(10.0, 0.0, 0.5)) * DMat4::from_scale(dvec3(2.0, 1.0, 1.0));
    let first = above * DMat4::from_quat(DQuat::from_rotation_z(FRAC_PI_2));
    let second = above * DMat4::from_translation(dvec3(0.0, 3.0, 0.0)) * DMat4::from_scale(dvec3(-1.0, 1.0, 1.0));
    for (i, matrix) in [first, second].into_iter().enumerate() {
        for (vertex, corner) in [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]]
            .into_iter()
            .enumerate()
        {
            let exact = matrix.transform_point3(dvec3(corner[0], 0.0, corner[1])) - mesh.shift;
            let is = mesh.positions[4 * i + vertex].as_dvec3();
            assert!(is.distance(exact) < 1e-6, "{is} instead of {exact}");
        }
    }
    // Turned by 90 degrees its front looks to -x; mirrored it still looks upwards.
    for (triangle, wanted) in [(0, Vec3::NEG_X), (2, Vec3::Y)] {
        let [a, b, c] = mesh.corners(&mesh.triangles[triangle]);
        assert!((b - a).cross(c - a).normalize().distance(wanted) < 1e-6);
        assert!(mesh.normals[mesh.triangles[triangle][0] as usize].distance(wanted) < 1e-6);
    }
}

/// f32 is as coarse as 0.5 there.
#[test]
fn nodes_far_away_keep_their_place() {
    let mut glb = Glb::floor().node(json!({"mesh": 0, "translation": [500_000.123, 4_649_776.25, 0.5]}));
    glb.json["nodes"][0]["translation"] = json!([500_002.456, 4_649_776.375, 0.5]);
    let mesh = parse(&glb).mesh;
    assert!(mesh.shift != DVec3::ZERO);
    let exact = dvec3(500_002.456 - 1.0, 4_649_776.375, -0.5);
    assert!((mesh.positions[0].as_dvec3() + mesh.shift).distance(exact) < 1e-6);
    let apart = mesh.positions[0].as_dvec3() - mesh.positions[4].as_dvec3();
    assert!(apart.distance(dvec3(2.333, 0.125, 0.0)) < 1e-6, "{apart}");
}

#[test]
fn strips_and_fans() {
    for (mode, triangles) in [
        (4, vec![[0, 1, 2]]),
        (5, vec![[0, 1, 2], [1, 3, 2]]),
        (6, vec![[1, 2, 0], [2, 3, 0]]),
    ] {
        let mut glb = Glb::floor();
        let primitive = &mut glb.json["meshes"][0]["primitives"][0];
        primitive["mode"] = mode.into();
        primitive.as_object_mut().unwrap().remove("indices");
        assert_eq!(parse(&glb).mesh.triangles, triangles);
    }
}

/// Components as integers, interleaved and sparse, are the same numbers.
#[test]
fn numbers_in_every_form() {
    let plain = parse(&Glb::floor()).mesh.positions;
    // KHR_mesh_quantization: normalised bytes, padded to four.
    let mut glb = Glb::floor();
    let bytes = [
        [-127_i8, 0, -127, 0],
        [-127, 0, 127, 0],
        [127, 0, 127, 0],
        [127, 0, -127, 0],
    ];
    let bytes: Vec<u8> = bytes.as_flattened().iter().map(|byte| *byte as u8).collect();
    let id = glb.accessor(
        &bytes,
        json!({"componentType": 5120, "normalized": true, "count": 4, "type": "VEC3"}),
    );
    let view = glb.json["accessors"][id]["bufferView"].as_u64().unwrap() as usize;
    glb.json["bufferViews"][view]["byteStride"] = 4.into();
    glb.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = id.into();
    glb.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert_eq!(parse(&glb).mesh.positions, plain);
    // Zeros, but for all four.
    let mut glb = Glb::floor();
    let numbers: Vec<u8> = plain
        .iter()
        .flat_map(|at| at.to_array())
        .flat_map(f32::to_le_bytes)
        .collect();
    let (indices, values) = (glb.view(&[0, 1, 2, 3]), glb.view(&numbers));
    glb.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    glb.json["accessors"][0]["sparse"] = json!({
        "count": 4, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values},
    });
    assert_eq!(parse(&glb).mesh.positions, plain);
}

#[test]
fn colours_are_linear_and_textures_have_their_origin_above() {
    let mut glb = Glb::floor().material(json!({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
    }));
    glb.attribute("COLOR_0", "VEC3", &[[0.215_860_5, 1.0, 0.0]; 4].concat());
    glb.attribute("TEXCOORD_0", "VEC2", &[0.0, 0.0, 0.25, 0.0, 1.0, 1.0, 0.0, 0.75]);
    with_image(&mut glb);
    let asset = parse(&glb);
    assert_eq!(asset.mesh.colors, [[128, 255, 0, 255]; 4]);
    assert_eq!(
        asset.mesh.coordinates,
        [vec2(0.0, 1.0), vec2(0.25, 1.0), vec2(1.0, 0.0), vec2(0.0, 0.25)]
    );
    let texture = asset.textures[asset.materials[0].texture as usize];
    assert_eq!((texture.width, texture.height, asset.texels[0]), (2, 1, 0x00_00_ff));

    // KHR_texture_transform: its rotation is counter-clockwise where v points down.
    glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = json!({
        "KHR_texture_transform": {"offset": [0.5, 0.25], "scale": [2.0, 4.0], "rotation": FRAC_PI_2},
    });
    let at = parse(&glb).mesh.coordinates;
    // (0.25, 0) is scaled to (0.5, 0), turned to (0, -0.5), and moved to (0.5, -0.25).
    assert!(at[1].distance(vec2(0.5, 1.25)) < 1e-6, "{}", at[1]);
    // (0, 0.75) to (0, 3), (3, 0) and (3.5, 0.25).
    assert!(at[3].distance(vec2(3.5, 0.75)) < 1e-6, "{}", at[3]);
}

/// Gives a file an image of a red and a black texel, as a texture.
fn with_image(glb: &mut Glb) {
    let view = glb.view(&png());
    glb.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    glb.json["textures"] = json!([{"source": 0}]);
}

/// A PNG file of a red and a black texel.
fn png() -> Vec<u8> {
    let mut image = image::RgbImage::new(2, 1);
    image.put_pixel(0, 0, image::Rgb([255, 0, 0]));
    let mut file = Cursor::new(Vec::new());
    image.write_to(&mut file, image::ImageFormat::Png).unwrap();
    file.into_inner()
}

#[test]
fn an_image_that_cannot_be_had_is_done_without() {
    let mut glb = Glb::floor().material(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
    with_image(&mut glb);
    for image in [
        json!({"bufferView": 0}),
        json!({"uri": "missing.png"}),
        json!({}),
        json!({"uri": "data:,x"}),
    ] {
        glb.json["images"] = json!([image]);
        let asset = parse(&glb);
        assert!(asset.textures.is_empty() && asset.mesh.coordinates.is_empty());
    }
}

/// A `.gltf` with its buffer and image beside it, and the same in one text.
#[test]
fn files_beside_and_within() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut glb = Glb::floor().material(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
    glb.json["images"] = json!([{"uri": "wood%20red.png"}]);
    glb.json["textures"] = json!([{"source": 0}]);
    glb.json["buffers"] = json!([{"uri": "my%20bytes.bin", "byteLength": glb.binary.len()}]);
    fs::write(at("my bytes.bin"), &glb.binary).unwrap();
    fs::write(at("wood red.png"), png()).unwrap();
    let path = at("floor.gltf");
    fs::write(&path, glb.json.to_string()).unwrap();
    let asset = gltf::read(&path, &silent).unwrap();
    super::check(&asset);
    assert_eq!(asset.files, [path.clone(), at("my bytes.bin"), at("wood red.png")]);
    assert_eq!((asset.textures.len(), asset.mesh.triangles.len()), (1, 2));

    glb.json["buffers"] = json!([{"uri": base64(&glb.binary), "byteLength": glb.binary.len()}]);
    glb.json["images"] = json!([{"uri": base64(&png())}]);
    let within = Reader::Gltf.parse(glb.json.to_string().as_bytes()).unwrap();
    assert_eq!((&within.mesh, &within.texels), (&asset.mesh, &asset.texels));

    fs::remove_file(at("my bytes.bin")).unwrap();
    let error = gltf::read(&path, &silent).unwrap_err().to_string();
    assert!(
        error.contains("floor.gltf: buffers[0] cannot be used: ") && error.contains("no such file"),
        "{error}"
    );
}

/// A data URI, by another implementation of base64 than the reader's (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = "data:application/octet-stream;base64,".to_owned();
    for group in bytes.chunks(3) {
        let word = group.iter().fold(0_u32, |word, byte| word << 8 | u32::from(*byte)) << (8 * (3 - group.len()));
        for i in 0..4 {
            let letter = letters[(word >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

/// What has no number of its own.
#[test]
fn what_is_not_there_has_its_default() {
    let glb = Glb::floor();
    let asset = parse(&glb);
    assert_eq!(
        (asset.materials.len(), asset.materials[0].base),
        (1, oktant::model::CLAY)
    );
    assert!(asset.lights.is_empty() && asset.camera.is_none());
    // Without a scene, all nodes are shown that are nobody's children.
    let mut glb = Glb::floor();
    glb.json.as_object_mut().unwrap().remove("scene");
    glb.json["scenes"] = json!([]);
    glb.json["nodes"] = json!([{"mesh": 0}, {"children": [0], "translation": [0, 5, 0]}]);
    assert_eq!(parse(&glb).mesh.positions[0], vec3(-1.0, 5.0, -1.0));
    let without: Value = json!({"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 1.0, 1.0]}});
    let metal = parse(&Glb::floor().material(without)).materials[0];
    assert_eq!(metal.base, vec3(0.25, 0.5, 1.0));
    assert_eq!(metal.diffuse, 0.0, "metallicFactor is 1 by default");
    assert_eq!(parse(&Glb::floor()).mesh.coordinates, Vec::<Vec2>::new());
}
