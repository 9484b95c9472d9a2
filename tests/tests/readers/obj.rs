//! OBJ and MTL files.

use super::Reader;
use glam::{DVec3, Vec2, Vec3, dvec3, vec2, vec3};
use oktant::asset::Asset;
use oktant::obj;
use oktant::progress::silent;
use oktant_shared::material::FRESNEL;
use std::fs;
use tempfile::tempdir;

fn parse(text: &str) -> Asset {
    Reader::Obj
        .parse(text.as_bytes())
        .unwrap_or_else(|error| panic!("{error}"))
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Twice the area of each triangle, with its sign as seen from +z.
fn areas(asset: &Asset) -> Vec<f32> {
    let mesh = &asset.mesh;
    let triangles = mesh.triangles.iter().map(|triangle| mesh.corners(triangle));
    triangles.map(|[a, b, c]| (b - a).cross(c - a).z).collect()
}

#[test]
fn every_way_to_write_a_corner() {
    let rest = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\n";
    for face in [
        "f 1 2 3",
        "f -4 -3 -2",
        "f 1/1 2/2 3/3",
        "f 1//1 2//1 3//1",
        "f 1/1/1 \\\n2/2/-1 3/3/1 # end",
        "fo 1/ 2/ 3/",
    ] {
        let asset = parse(&format!("\u{feff}# comment\no thing\n{SQUARE}{rest}{face}\r\nl 1 2\n"));
        let mesh = &asset.mesh;
        assert_eq!(
            mesh.corners(&mesh.triangles[0]),
            [Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0)],
            "{face}"
        );
        assert_eq!(mesh.normals[mesh.triangles[0][1] as usize], Vec3::Z, "{face}");
        if face.contains("/1 2/2") {
            let at = mesh.triangles[0].map(|corner| mesh.coordinates[corner as usize]);
            assert_eq!(at, [Vec2::ZERO, Vec2::X, vec2(1.0, 1.0)]);
        }
        assert!(asset.materials.is_empty() && asset.material_ids.is_empty());
    }
}

/// Oracle: the area of the polygon by hand; a fan from the first corner would have a triangle outside.
#[test]
fn concave_polygons_are_cut() {
    let arrow = parse("v 0 0 0\nv 4 -2 0\nv 1 0 0\nv 4 2 0\nf 2 3 4 1\n");
    assert_eq!(areas(&arrow).len(), 2);
    assert!(areas(&arrow).iter().all(|area| *area > 0.0), "{:?}", areas(&arrow));
    let l = parse("v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 3 4 5 6 1 2\n");
    assert_eq!(areas(&l).len(), 4);
    assert!(areas(&l).iter().all(|area| *area > 0.0) && (areas(&l).iter().sum::<f32>() - 10.0).abs() < 1e-5);
}

/// A roof: two squares that meet at a right angle.
const ROOF: &str = "v 0 0 0\nv 0 0 1\nv 1 1 0\nv 1 1 1\nv 2 0 0\nv 2 0 1\n";
const LEFT: &str = "f 1 2 4 3\n";
const RIGHT: &str = "f 3 4 6 5\n";

/// The normals of both sides at their common edge.
fn at_the_ridge(asset: &Asset) -> [Vec3; 2] {
    let mesh = &asset.mesh;
    [0, 2].map(|triangle| {
        let corners = mesh.triangles[triangle..triangle + 2].as_flattened();
        let corner = corners
            .iter()
            .find(|corner| mesh.positions[**corner as usize] == vec3(1.0, 1.0, 0.0));
        mesh.normals[*corner.unwrap() as usize]
    })
}

#[test]
fn smoothing_groups() {
    let smooth = [Vec3::Y; 2];
    for (text, wanted) in [
        (format!("{ROOF}{LEFT}{RIGHT}"), smooth),
        (format!("{ROOF}s 4\n{LEFT}{RIGHT}"), smooth),
        (format!("{ROOF}s off\n{LEFT}{RIGHT}"), [Vec3::ZERO; 2]),
        (
            format!("{ROOF}s 0\n{LEFT}s 1\n{RIGHT}"),
            [Vec3::ZERO, vec3(1.0, 1.0, 0.0).normalize()],
        ),
        (
            format!("{ROOF}s 1\n{LEFT}s 2\n{RIGHT}"),
            [vec3(-1.0, 1.0, 0.0).normalize(), vec3(1.0, 1.0, 0.0).normalize()],
        ),
        // Neither an object, nor a material, nor texture coordinates are an edge.
        (
            format!("{ROOF}vt 0 0\nvt 1 1\ng a\nf 1/1 2/1 4/1 3/1\nusemtl b\nf 3/2 4/2 6/2 5/2\n"),
            smooth,
        ),
    ] {
        let is = at_the_ridge(&parse(&text));
        for (is, wanted) in is.into_iter().zip(wanted) {
            assert!(is.distance(wanted) < 1e-6, "{is} instead of {wanted}:\n{text}");
        }
    }
}

#[test]
fn what_lies_far_away_keeps_its_form() {
    let asset = parse("v 500000.001 4649776.25 30\nv 500000.003 4649776.25 30\nv 500000.001 4649776.254 30\nf 1 2 3\n");
    let mesh = asset.mesh;
    assert!(mesh.shift != DVec3::ZERO);
    let exact = dvec3(500_000.003, 4_649_776.25, 30.0);
    assert!((mesh.positions[1].as_dvec3() + mesh.shift).distance(exact) < 1e-9);
    assert!(mesh.normals[0].distance(Vec3::Z) < 1e-6, "computed from what is left");
}

#[test]
fn colours_of_vertices() {
    let asset = parse("v 0 0 0 1 0.5 0\nv 1 0 0\nv 1 1 0 1.0\nv 0 1 0 1 0 0 1\nf 1 2 3 4\n");
    assert_eq!(
        asset.mesh.colors,
        [[255, 128, 0, 255], [255; 4], [255; 4], [0, 0, 255, 255]]
    );
}

#[test]
fn materials_and_images() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("maps")).unwrap();
    image::RgbImage::from_pixel(2, 2, image::Rgb([255, 0, 0]))
        .save(at("maps/red wood.png"))
        .unwrap();
    fs::write(
        at("my things.mtl"),
        "# colours\nnewmtl matt\nKd 0.2 0.4 0.6\nKs 0.5 0.5 0.5\nNs 30\nillum 1\n\
         newmtl shiny\nKd 0.6 0.6 0.6\nKs 0.5 0.25 0.5\nNs 30\nillum 3\n\
         newmtl glass\nKd 0 0 0\nTf 1 0.5 1\nNi 1.33\nd 0\nillum 7\n\
         newmtl pane\nKd 1 1 1\nd 0.25\nmap_Kd -clamp on -o 0.5 0.5 maps\\red wood.png\n\
         newmtl matt\nKd 1 1 1\n",
    )
    .unwrap();
    let faces = ["matt", "shiny", "glass", "pane", "missing", "matt"].map(|name| format!("usemtl {name}\nf 1 2 3\n"));
    let path = at("a.obj");
    fs::write(
        &path,
        format!("mtllib my things.mtl\n{SQUARE}f 1 3 4\n{}", faces.concat()),
    )
    .unwrap();
    let asset = obj::read(&path, &silent).unwrap();
    super::check(&asset);
    assert_eq!(
        asset.files,
        [path.clone(), at("my things.mtl"), at("maps/red wood.png")]
    );
    assert_eq!(asset.material_ids, [4, 0, 1, 2, 3, 4, 0]);
    let [matt, shiny, glass, pane, clay] = asset.materials[..] else {
        panic!("{:?}", asset.materials);
    };
    assert_eq!(
        (matt.base, matt.diffuse, matt.exponent),
        (vec3(0.2, 0.4, 0.6), 1.0, 0.0)
    );
    // Kd is lowered so that it and the mirror image are no more than what arrives.
    assert_eq!((shiny.mirror, shiny.exponent), (vec3(0.5, 0.25, 0.5), 30.0));
    assert!((shiny.diffuse * 0.6 - 0.5).abs() < 1e-6);
    assert_eq!((glass.transmission, glass.ior), (vec3(1.0, 0.5, 1.0), 1.33));
    assert!(glass.flags & FRESNEL != 0 && matt.flags & FRESNEL == 0);
    assert_eq!(
        (pane.transmission, pane.ior, pane.diffuse),
        (Vec3::splat(0.75), 1.0, 0.25)
    );
    assert_eq!(asset.textures[pane.texture as usize].width, 2);
    assert_eq!(asset.texels, [255; 4]);
    assert_eq!(clay.base, oktant::model::CLAY);
    assert_eq!(asset.mesh.coordinates, [Vec2::ZERO; 4], "the image needs some");

    // Done without where they cannot be had, and said where they are wrong.
    fs::remove_file(at("maps/red wood.png")).unwrap();
    assert!(obj::read(&path, &silent).unwrap().textures.is_empty());
    fs::write(at("my things.mtl"), "newmtl matt\nKd 1 x 1\n").unwrap();
    let error = obj::read(&path, &silent).unwrap_err().to_string();
    assert!(
        error.ends_with("my things.mtl, line 2: \"x\" is no finite number; correct it, or leave its line out"),
        "{error}"
    );
    fs::remove_file(at("my things.mtl")).unwrap();
    let asset = obj::read(&path, &silent).unwrap();
    assert!(
        asset.materials.is_empty() && asset.files.len() == 3,
        "{:?}",
        asset.files
    );
}
